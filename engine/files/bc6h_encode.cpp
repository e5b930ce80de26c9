// SPDX-License-Identifier: MIT
#include "engine/files/bc6h.h"
#include "engine/files/bc6h_modes.h"
#include "engine/math/packing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <glm/geometric.hpp>

namespace limn {

namespace {

using Mask = std::uint32_t; ///< bit i: texel i

constexpr Mask kAll = 0xffff;
constexpr std::size_t kPartitionsTried = 4;
/// Share of the brightest channel below which light is not weighted less.
constexpr float kFloor = 1.f / 16;

/// The middle of the interpolated numbers that are decoded to a value's half float.
float lineNumber(float value, Bc6hSign sign) {
    const float finite = std::isnan(value) ? 0 : std::clamp(value, -65504.f, 65504.f);
    if (sign == Bc6hSign::Unsigned)
        return (float(floatToHalf(std::max(finite, 0.f))) + 0.5f) * (64.f / 31);
    const std::uint16_t half = floatToHalf(std::abs(finite));
    if (half == 0)
        return 0;
    return std::copysign((float(half) + 0.5f) * (32.f / 31), finite);
}

/// A block's texels as numbers on lines.
struct Block {
    Bc6hTexels texels;
    /// What squared differences of these count for. Halfs' bits are about logarithms of light, so
    /// that a difference of them times the light is one of light.
    Bc6hTexels weights;
    std::array<float, 16> weight; ///< mean of a texel's
};

Block blockOf(const Bc6hTexels& values, Bc6hSign sign) {
    Block block;
    Bc6hTexels sizes;
    float brightest = 0;
    for (std::uint32_t i = 0; i < 16; ++i)
        for (int c = 0; c < 3; ++c) {
            block.texels[i][c] = lineNumber(values[i][c], sign);
            const float size = std::abs(values[i][c]);
            sizes[i][c] = std::isnan(size) ? 0 : std::min(size, 65504.f);
            brightest = std::max(brightest, sizes[i][c]);
        }
    for (std::uint32_t i = 0; i < 16; ++i) {
        const glm::vec3 share = brightest > 0 ? sizes[i] / brightest : glm::vec3(1);
        block.weights[i] = (share + kFloor) * (share + kFloor);
        block.weight[i] = (block.weights[i].x + block.weights[i].y + block.weights[i].z) / 3;
    }
    return block;
}

/// The ends of a line of colours.
struct Line {
    glm::vec3 a{0}, b{0};
};

/// The mean of the texels and the direction in which they vary most, by power iteration on their
/// covariance.
struct Spread {
    glm::vec3 mean{0}, axis{0};
    float rest = 0; ///< sum of squared distances to the line
};

Spread spreadOf(const Block& block, Mask mask) {
    Spread s;
    float sum = 0;
    for (std::uint32_t i = 0; i < 16; ++i)
        if (mask >> i & 1U) {
            s.mean += block.weight[i] * block.texels[i];
            sum += block.weight[i];
        }
    s.mean /= sum;
    glm::vec3 xx{0}, xy{0}; // the covariance's diagonal, and its xy, yz, zx
    for (std::uint32_t i = 0; i < 16; ++i)
        if (mask >> i & 1U) {
            const glm::vec3 d = block.texels[i] - s.mean, wd = block.weight[i] * d;
            xx += wd * d;
            xy += wd * glm::vec3(d.y, d.z, d.x);
        }
    const auto times = [&](glm::vec3 v) {
        return glm::vec3(xx.x * v.x + xy.x * v.y + xy.z * v.z, xy.x * v.x + xx.y * v.y + xy.y * v.z,
                         xy.z * v.x + xy.y * v.y + xx.z * v.z);
    };
    // The column of the largest variance is not perpendicular to the axis.
    glm::vec3 axis = xx.x >= xx.y && xx.x >= xx.z ? glm::vec3(1, 0, 0)
                     : xx.y >= xx.z               ? glm::vec3(0, 1, 0)
                                                  : glm::vec3(0, 0, 1);
    for (int k = 0; k < 6; ++k) {
        const glm::vec3 next = times(axis);
        const float length = glm::length(next);
        if (!(length > 0))
            return s;
        axis = next / length;
    }
    s.axis = axis;
    s.rest = std::max(xx.x + xx.y + xx.z - glm::dot(axis, times(axis)), 0.f);
    return s;
}

std::uint32_t nearestIndex(std::span<const std::uint32_t> weights, float t) {
    std::uint32_t best = 0;
    for (std::uint32_t k = 1; k < weights.size(); ++k)
        if (std::abs(float(weights[k]) / 64 - t) < std::abs(float(weights[best]) / 64 - t))
            best = k;
    return best;
}

/// Ends of the line whose colours at `weights` lie nearest the texels: along the axis of their
/// spread, then twice by least squares for the weights that are nearest to each.
Line fittedLine(const Block& block, Mask mask, std::span<const std::uint32_t> weights) {
    const Spread s = spreadOf(block, mask);
    float lower = 0, upper = 0;
    for (std::uint32_t i = 0; i < 16; ++i)
        if (mask >> i & 1U) {
            const float t = glm::dot(block.texels[i] - s.mean, s.axis);
            lower = std::min(lower, t);
            upper = std::max(upper, t);
        }
    Line line{s.mean + lower * s.axis, s.mean + upper * s.axis};
    for (int round = 0; round < 2; ++round) {
        const glm::vec3 way = line.b - line.a;
        const float square = glm::dot(way, way);
        if (!(square > 0))
            break;
        float aa = 0, ab = 0, bb = 0;
        glm::vec3 sumA{0}, sumB{0};
        for (std::uint32_t i = 0; i < 16; ++i)
            if (mask >> i & 1U) {
                const float t = glm::dot(block.texels[i] - line.a, way) / square;
                const float b = float(weights[nearestIndex(weights, t)]) / 64, a = 1 - b;
                const float w = block.weight[i];
                aa += w * a * a;
                ab += w * a * b;
                bb += w * b * b;
                sumA += w * a * block.texels[i];
                sumB += w * b * block.texels[i];
            }
        const float determinant = aa * bb - ab * ab;
        if (!(determinant > 1e-6f))
            break;
        line = {(bb * sumA - ab * sumB) / determinant, (aa * sumB - ab * sumA) / determinant};
    }
    return line;
}

/// The number of `bits` bits whose unquantised value is nearest.
std::int32_t quantised(float value, std::uint32_t bits, Bc6hSign sign) {
    const bool isSigned = sign == Bc6hSign::Signed;
    const std::int32_t highest = isSigned ? (1 << (bits - 1)) - 1 : (1 << bits) - 1;
    const std::int32_t lowest = isSigned ? -highest : 0;
    const auto guess = std::int32_t(std::floor(std::ldexp(value, int(bits) - 16)));
    std::int32_t best = std::clamp(guess, lowest, highest);
    const auto distance = [&](std::int32_t q) {
        return std::abs(float(bc6hUnquantised(q, bits, sign)) - value);
    };
    for (const std::int32_t q : {guess - 1, guess + 1})
        if (q >= lowest && q <= highest && distance(q) < distance(best))
            best = q;
    return best;
}

/// A block before it is written down.
struct Choice {
    const Bc6hMode* mode = nullptr;
    std::uint32_t partition = 0;
    std::array<std::array<std::int32_t, 3>, 4> ends{}; ///< quantised, not as differences
    std::array<std::uint32_t, 16> indices{};
    float error = std::numeric_limits<float>::max();
};

bool differencesFit(const Choice& choice) {
    const Bc6hMode& mode = *choice.mode;
    if (!mode.deltas)
        return true;
    for (std::uint32_t e = 1; e < mode.ends(); ++e)
        for (std::uint32_t c = 0; c < 3; ++c) {
            const std::int32_t half = 1 << (mode.delta[c] - 1);
            const std::int32_t d = choice.ends[e][c] - choice.ends[0][c];
            if (d < -half || d >= half)
                return false;
        }
    return true;
}

/// Chooses the nearest of the region's colours for each of its texels, and turns the line round
/// where the anchor's index would need its highest bit.
void chooseIndices(const Block& block, Mask mask, std::uint32_t region, Bc6hSign sign,
                   Choice& choice) {
    const Bc6hMode& mode = *choice.mode;
    const auto weights = bc6hWeights(mode.indexBits());
    std::array<glm::vec3, 16> colours;
    for (std::uint32_t k = 0; k < weights.size(); ++k)
        for (std::uint32_t c = 0; c < 3; ++c) {
            const auto end = [&](std::uint32_t e) {
                return bc6hUnquantised(choice.ends[2 * region + e][c], mode.bits, sign);
            };
            const auto w = std::int32_t(weights[k]);
            colours[k][int(c)] = float((end(0) * (64 - w) + end(1) * w + 32) >> 6);
        }
    for (std::uint32_t i = 0; i < 16; ++i)
        if (mask >> i & 1U) {
            float nearest = std::numeric_limits<float>::max();
            for (std::uint32_t k = 0; k < weights.size(); ++k) {
                const glm::vec3 d = block.texels[i] - colours[k];
                if (const float square = glm::dot(block.weights[i] * d, d); square < nearest) {
                    nearest = square;
                    choice.indices[i] = k;
                }
            }
            choice.error += nearest;
        }
    const std::uint32_t anchor = region == 0 ? 0 : kBc6hAnchors[choice.partition];
    const auto last = std::uint32_t(weights.size() - 1);
    if (choice.indices[anchor] > last / 2) {
        std::swap(choice.ends[2 * region], choice.ends[2 * region + 1]);
        for (std::uint32_t i = 0; i < 16; ++i)
            if (mask >> i & 1U)
                choice.indices[i] = last - choice.indices[i];
    }
}

/// Replaces `best` by the best of the modes with that many regions, if that is better.
void tryModes(const Block& block, std::span<const Line> lines, std::uint32_t partition,
              Bc6hSign sign, Choice& best) {
    for (const Bc6hMode& mode : bc6hModes()) {
        if (mode.regions != lines.size())
            continue;
        Choice choice{.mode = &mode, .partition = partition};
        for (std::uint32_t e = 0; e < mode.ends(); ++e)
            for (std::uint32_t c = 0; c < 3; ++c) {
                const Line& line = lines[e / 2];
                choice.ends[e][c] =
                    quantised((e % 2 == 0 ? line.a : line.b)[int(c)], mode.bits, sign);
            }
        choice.error = 0;
        const Mask second = mode.regions == 2 ? kBc6hPartitions[partition] : 0;
        chooseIndices(block, kAll & ~second, 0, sign, choice);
        if (second != 0)
            chooseIndices(block, second, 1, sign, choice);
        if (choice.error < best.error && differencesFit(choice))
            best = choice;
    }
}

/// Writes a block's bits, the lowest of the first byte first.
struct BitWriter {
    Bc6hBlock block{};
    std::uint32_t position = 0;

    void put(std::uint32_t bits, std::uint32_t count) {
        for (std::uint32_t i = 0; i < count; ++i, ++position)
            block[position / 8] =
                std::uint8_t(block[position / 8] | (bits >> i & 1U) << (position % 8));
    }
};

Bc6hBlock written(const Choice& choice) {
    const Bc6hMode& mode = *choice.mode;
    BitWriter out;
    out.put(mode.code, mode.codeBits());
    const Bc6hLayout& layout = bc6hLayout(mode);
    for (std::uint32_t i = 0; i < layout.count; ++i) {
        const std::uint32_t place = layout.places[i], e = place / 48, c = place / 16 % 3;
        const std::int32_t base = mode.deltas && e > 0 ? choice.ends[0][c] : 0;
        out.put(std::uint32_t(choice.ends[e][c] - base) >> (place % 16), 1);
    }
    if (mode.regions == 2)
        out.put(choice.partition, 5);
    for (std::uint32_t i = 0; i < 16; ++i) {
        const bool anchor = i == 0 || (mode.regions == 2 && i == kBc6hAnchors[choice.partition]);
        out.put(choice.indices[i], mode.indexBits() - (anchor ? 1 : 0));
    }
    return out.block;
}

} // namespace

Bc6hBlock encodeBc6h(const Bc6hTexels& values, Bc6hSign sign) {
    const Block block = blockOf(values, sign);
    Choice best;
    const Line whole = fittedLine(block, kAll, bc6hWeights(4));
    tryModes(block, std::array{whole}, 0, sign, best);
    if (best.error < 1) // as exact as halfs are, about
        return written(best);
    std::array<std::pair<float, std::uint32_t>, kBc6hPartitions.size()> partitions;
    for (std::uint32_t p = 0; p < partitions.size(); ++p) {
        const Mask second = kBc6hPartitions[p];
        partitions[p] = {spreadOf(block, kAll & ~second).rest + spreadOf(block, second).rest, p};
    }
    std::ranges::partial_sort(partitions, partitions.begin() + kPartitionsTried);
    for (std::size_t k = 0; k < kPartitionsTried; ++k) {
        const std::uint32_t p = partitions[k].second;
        const Mask second = kBc6hPartitions[p];
        tryModes(block,
                 std::array{fittedLine(block, kAll & ~second, bc6hWeights(3)),
                            fittedLine(block, second, bc6hWeights(3))},
                 p, sign, best);
    }
    return written(best);
}

} // namespace limn
