// SPDX-License-Identifier: MIT
#include "engine/files/bc6h.h"
#include "engine/files/bc6h_modes.h"
#include "engine/math/packing.h"

#include <algorithm>
#include <cstdlib>

namespace limn {

namespace {

/// Reads a block's bits, the lowest of the first byte first.
struct BitReader {
    const Bc6hBlock& block;
    std::uint32_t position = 0;

    std::uint32_t take(std::uint32_t count) {
        std::uint32_t bits = 0;
        for (std::uint32_t i = 0; i < count; ++i, ++position)
            bits |= (std::uint32_t(block[position / 8]) >> (position % 8) & 1U) << i;
        return bits;
    }
};

std::int32_t signExtended(std::int32_t value, std::uint32_t bits) {
    const std::int32_t half = 1 << (bits - 1);
    return ((value & (2 * half - 1)) ^ half) - half;
}

using Ends = std::array<std::array<std::int32_t, 3>, 4>;

Ends readEnds(BitReader& bits, const Bc6hMode& mode, Bc6hSign sign) {
    Ends ends{};
    const Bc6hLayout& layout = bc6hLayout(mode);
    for (std::uint32_t i = 0; i < layout.count; ++i) {
        const std::uint32_t place = layout.places[i];
        ends[place / 48][place / 16 % 3] |= std::int32_t(bits.take(1) << (place % 16));
    }
    const bool isSigned = sign == Bc6hSign::Signed;
    for (std::uint32_t c = 0; c < 3; ++c) {
        if (isSigned)
            ends[0][c] = signExtended(ends[0][c], mode.bits);
        for (std::uint32_t e = 1; e < mode.ends(); ++e) {
            std::int32_t& end = ends[e][c];
            if (mode.deltas)
                end = ends[0][c] + signExtended(end, mode.delta[c]);
            end = isSigned ? signExtended(end, mode.bits) : end & ((1 << mode.bits) - 1);
        }
    }
    for (auto& end : ends)
        for (std::int32_t& channel : end)
            channel = bc6hUnquantised(channel, mode.bits, sign);
    return ends;
}

/// The half float that an interpolated number is decoded to.
float finished(std::int32_t value, Bc6hSign sign) {
    if (sign == Bc6hSign::Unsigned)
        return halfToFloat(std::uint16_t(value * 31 >> 6));
    const std::int32_t half = std::min(std::abs(value) * 31 >> 5, 0x7bff);
    return halfToFloat(std::uint16_t(value < 0 ? half | 0x8000 : half));
}

} // namespace

Bc6hTexels decodeBc6h(const Bc6hBlock& block, Bc6hSign sign) {
    BitReader bits{block};
    std::uint32_t code = bits.take(2);
    if (code > 1)
        code |= bits.take(3) << 2;
    const auto modes = bc6hModes();
    const auto mode = std::ranges::find(modes, code, &Bc6hMode::code);
    if (mode == modes.end())
        return Bc6hTexels{};
    const Ends ends = readEnds(bits, *mode, sign);
    const std::uint32_t partition = mode->regions == 2 ? bits.take(5) : 0;
    const auto weights = bc6hWeights(mode->indexBits());
    Bc6hTexels texels{};
    for (std::uint32_t i = 0; i < texels.size(); ++i) {
        const std::uint32_t region =
            mode->regions == 2 ? std::uint32_t(kBc6hPartitions[partition]) >> i & 1U : 0;
        const bool anchor = i == (region == 0 ? 0U : kBc6hAnchors[partition]);
        const auto weight = std::int32_t(weights[bits.take(mode->indexBits() - (anchor ? 1 : 0))]);
        for (std::uint32_t c = 0; c < 3; ++c) {
            const std::int32_t a = ends[2 * region][c], b = ends[2 * region + 1][c];
            texels[i][int(c)] = finished((a * (64 - weight) + b * weight + 32) >> 6, sign);
        }
    }
    return texels;
}

} // namespace limn
