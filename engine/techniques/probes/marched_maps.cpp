// SPDX-License-Identifier: MIT
#include "engine/techniques/probes/marched_maps.h"

#include "engine/math/octahedral.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

namespace limn {

std::uint32_t MarchedMaps::levelSide(std::size_t level) const {
    std::uint32_t s = side;
    for (std::size_t k = 0; k < level; ++k)
        s = (s + 1) / 2;
    return s;
}

std::size_t MarchedMaps::bytes() const {
    std::size_t sum = planes.size() * sizeof(glm::vec4) + nearest.size() * sizeof(float);
    for (const std::vector<glm::vec3>& level : radiance)
        sum += level.size() * sizeof(glm::vec3);
    return sum;
}

MarchedMaps emptyMarchedMaps(glm::uvec3 gridSize, const Bounds& gridBounds, std::uint32_t side) {
    MarchedMaps maps{.gridSize = gridSize, .gridBounds = gridBounds, .side = side};
    maps.planes.resize(maps.probes() * maps.texels(), glm::vec4(0));
    maps.nearest.resize(maps.probes() * maps.nearestSide() * maps.nearestSide());
    maps.inSolid.resize(maps.probes());
    for (std::uint32_t s = side;; s = (s + 1) / 2) {
        maps.radiance.emplace_back(maps.probes() * s * s, glm::vec3(0));
        if (s <= MARCH_COARSEST)
            break;
    }
    return maps;
}

glm::vec4 marchedPlane(glm::vec3 direction, float distance, glm::vec3 normal, float kind) {
    // A plane through the probe, seen edge on, hides nothing but that edge.
    constexpr float kMinCosine = 1e-5f;
    const float height = distance * std::max(-glm::dot(normal, direction), kMinCosine);
    return {-normal / height, kind};
}

void updateNearest(MarchedMaps& maps, std::size_t probe) {
    const glm::vec4* planes = maps.planes.data() + probe * maps.texels();
    const std::uint32_t blocks = maps.nearestSide();
    float* nearest = maps.nearest.data() + probe * blocks * blocks;
    std::fill_n(nearest, blocks * blocks, 0.f);
    // Inverse 1-norms are linear between the folds of the map, which cross a texel at these places
    // only; the largest one is at one of them.
    constexpr std::uint32_t kPlaces = 3;
    for (std::uint32_t y = 0; y < maps.side; ++y)
        for (std::uint32_t x = 0; x < maps.side; ++x) {
            const glm::vec3 G(planes[y * maps.side + x]);
            float& largest = nearest[y / MarchedMaps::kBlock * blocks + x / MarchedMaps::kBlock];
            for (std::uint32_t k = 0; k < kPlaces * kPlaces; ++k) {
                const glm::vec2 place =
                    glm::vec2(float(x), float(y)) +
                    glm::vec2(float(k % kPlaces), float(k / kPlaces)) / float(kPlaces - 1);
                largest = std::max(
                    largest, glm::dot(G, octahedralPoint(place * (2 / float(maps.side)) - 1.f)));
            }
        }
}

namespace {

/// A texel of a map of `fine` texels a side and its share of the texel's side of one of `coarse`.
struct TexelShare {
    std::uint32_t first = 0, count = 0;
    float weight[3] = {};
};

TexelShare sharesOf(std::uint32_t texel, std::uint32_t fine, std::uint32_t coarse) {
    const float ratio = float(fine) / float(coarse), from = float(texel) * ratio, to = from + ratio;
    TexelShare share{.first = std::min(std::uint32_t(from + 1e-4f), fine - 1)};
    for (std::uint32_t k = 0; k < 3 && share.first + k < fine; ++k) {
        const auto lower = float(share.first + k);
        const float covered = std::min(to, lower + 1) - std::max(from, lower);
        if (covered < 1e-4f)
            break;
        share.weight[share.count++] = covered / ratio;
    }
    return share;
}

/// A texel of a map, whose sides are each joined to themselves, folded about their middles.
glm::ivec2 wrapped(glm::ivec2 texel, int side) {
    for (int a = 0; a < 2; ++a)
        if (texel[a] < 0 || texel[a] >= side) {
            texel[a] = std::clamp(texel[a], 0, side - 1);
            texel[1 - a] = side - 1 - texel[1 - a];
        }
    return texel;
}

/// Adds the texels of a bilinear lookup, which share `weight`.
void addBilinear(const MarchedMaps& maps, std::size_t level, std::size_t probe, glm::vec2 square,
                 float weight, MarchedTaps& taps) {
    const auto side = int(maps.levelSide(level));
    const std::size_t first = probe * std::size_t(side) * std::size_t(side);
    const glm::vec2 position = (square * 0.5f + 0.5f) * float(side) - 0.5f,
                    lower = glm::floor(position);
    const glm::vec2 f = position - lower;
    for (int k = 0; k < 4; ++k) {
        const glm::ivec2 step(k & 1, k >> 1);
        const glm::ivec2 texel = wrapped(glm::ivec2(lower) + step, side);
        const glm::vec2 w = glm::mix(1.f - f, f, glm::vec2(step));
        taps.tap[taps.count++] = {std::uint32_t(level),
                                  std::uint32_t(first + std::size_t(texel.y * side + texel.x)),
                                  w.x * w.y * weight};
    }
}

} // namespace

void updateLevels(MarchedMaps& maps, std::size_t probe) {
    for (std::size_t level = 1; level < maps.radiance.size(); ++level) {
        const std::uint32_t fine = maps.levelSide(level - 1), coarse = maps.levelSide(level);
        const glm::vec3* from = maps.radiance[level - 1].data() + probe * fine * fine;
        glm::vec3* to = maps.radiance[level].data() + probe * coarse * coarse;
        for (std::uint32_t y = 0; y < coarse; ++y)
            for (std::uint32_t x = 0; x < coarse; ++x) {
                const TexelShare rows = sharesOf(y, fine, coarse),
                                 columns = sharesOf(x, fine, coarse);
                glm::vec3 sum(0);
                for (std::uint32_t j = 0; j < rows.count; ++j)
                    for (std::uint32_t i = 0; i < columns.count; ++i)
                        sum += rows.weight[j] * columns.weight[i] *
                               from[(rows.first + j) * fine + columns.first + i];
                to[y * coarse + x] = sum;
            }
    }
}

MarchedTaps probeTaps(const MarchedMaps& maps, std::size_t probe, glm::vec3 direction,
                      float spread) {
    // A bilinear lookup of texels of side 1 has a variance of 1/6 + 1/12 along each axis; half of a
    // Gaussian like that lies within 0.59. A texel of the finest level is as wide as the square of
    // the mean solid angle.
    constexpr auto kHalf = float(MARCH_HALF);
    const float texel = kHalf * 2 * std::sqrt(std::numbers::pi_v<float>) / float(maps.side);
    const auto last = float(maps.radiance.size() - 1);
    const float level = std::clamp(std::log2(std::max(spread / texel, 1.f)), 0.f, last);
    const auto lower = std::size_t(level);
    const glm::vec2 square = octahedralSquare(direction);
    const float f = level - float(lower);
    MarchedTaps taps;
    addBilinear(maps, lower, probe, square, 1 - f, taps);
    if (f > 0)
        addBilinear(maps, lower + 1, probe, square, f, taps);
    return taps;
}

glm::vec3 probeRadiance(const MarchedMaps& maps, std::size_t probe, glm::vec3 direction,
                        float spread) {
    const MarchedTaps taps = probeTaps(maps, probe, direction, spread);
    glm::vec3 sum(0);
    for (std::size_t k = 0; k < taps.count; ++k)
        sum += taps.tap[k].weight * maps.radiance[taps.tap[k].level][taps.tap[k].index];
    return sum;
}

} // namespace limn
