// SPDX-License-Identifier: MIT
#pragma once

#include "engine/files/bc6h.h"

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace limn {

/// A mode of a block: how it keeps the ends of one or two lines of colours.
struct Bc6hMode {
    std::uint32_t code; ///< two bits where below 2, else five
    std::uint32_t regions;
    std::uint32_t bits;                 ///< of each channel of the first end
    std::array<std::uint32_t, 3> delta; ///< bits of the others, by channel
    bool deltas;                        ///< the others are differences to the first
    /// The ends' bits behind the mode's, lowest first: "r2.0-4" are bits 0 to 4 of the red of end 2
    /// (ends 0 and 1 of the first region, 2 and 3 of the second), "r0.11-10" bits 11 and 10.
    std::string_view layout;

    std::uint32_t codeBits() const { return code < 2 ? 2 : 5; }
    std::uint32_t ends() const { return 2 * regions; }
    std::uint32_t indexBits() const { return regions == 1 ? 4 : 3; }
};

std::span<const Bc6hMode, 14> bc6hModes();

/// Places of a mode's bits: 16 * (3 * end + channel) + bit of the number there, each in turn.
struct Bc6hLayout {
    std::array<std::uint8_t, 75> places{};
    std::uint32_t count = 0;
};
const Bc6hLayout& bc6hLayout(const Bc6hMode& mode);

/// Bit i: texel i lies in the second region.
inline constexpr std::array<std::uint16_t, 32> kBc6hPartitions = {
    0xcccc, 0x8888, 0xeeee, 0xecc8, 0xc880, 0xfeec, 0xfec8, 0xec80, 0xc800, 0xffec, 0xfe80,
    0xe800, 0xffe8, 0xff00, 0xfff0, 0xf000, 0xf710, 0x008e, 0x7100, 0x08ce, 0x008c, 0x7310,
    0x3100, 0x8cce, 0x088c, 0x3110, 0x6666, 0x366c, 0x17e8, 0x0ff0, 0x718e, 0x399c};

/// Texel of the second region whose index lacks its highest bit, which is 0. In the first region it
/// is texel 0.
inline constexpr std::array<std::uint8_t, 32> kBc6hAnchors = {
    15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15, 15,
    15, 2,  8,  2,  2,  8,  8,  15, 2,  8,  2,  2,  8,  8,  2,  2};

/// Where colours lie between both ends, in 64ths, by index of `bits` bits, 3 or 4.
std::span<const std::uint32_t> bc6hWeights(std::uint32_t bits);

/// A number of `bits` bits as one of 16 (unsigned) or 15 and a sign; lines are interpolated in
/// these.
std::int32_t bc6hUnquantised(std::int32_t value, std::uint32_t bits, Bc6hSign sign);

} // namespace limn
