// SPDX-License-Identifier: MIT
#include "engine/files/bc6h_modes.h"

#include <cstddef>
#include <cstdlib>

namespace limn {

namespace {

#define LIMN_BC6H_ENDS "r0.0-9 g0.0-9 b0.0-9 "
constexpr std::array<Bc6hMode, 14> kModes = {{
    {0,
     2,
     10,
     {5, 5, 5},
     true,
     "g2.4 b2.4 b3.4 " LIMN_BC6H_ENDS "r1.0-4 g3.4 g2.0-3 g1.0-4 b3.0 g3.0-3 b1.0-4 b3.1 b2.0-3 "
     "r2.0-4 b3.2 r3.0-4 b3.3"},
    {1,
     2,
     7,
     {6, 6, 6},
     true,
     "g2.5 g3.4-5 r0.0-6 b3.0-1 b2.4 g0.0-6 b2.5 b3.2 g2.4 b0.0-6 b3.3 b3.5-4 r1.0-5 g2.0-3 g1.0-5 "
     "g3.0-3 b1.0-5 b2.0-3 r2.0-5 r3.0-5"},
    {2,
     2,
     11,
     {5, 4, 4},
     true,
     LIMN_BC6H_ENDS "r1.0-4 r0.10 g2.0-3 g1.0-3 g0.10 b3.0 g3.0-3 b1.0-3 b0.10 b3.1 b2.0-3 r2.0-4 "
                    "b3.2 r3.0-4 b3.3"},
    {6,
     2,
     11,
     {4, 5, 4},
     true,
     LIMN_BC6H_ENDS "r1.0-3 r0.10 g3.4 g2.0-3 g1.0-4 g0.10 g3.0-3 b1.0-3 b0.10 b3.1 b2.0-3 r2.0-3 "
                    "b3.0 b3.2 r3.0-3 g2.4 b3.3"},
    {10,
     2,
     11,
     {4, 4, 5},
     true,
     LIMN_BC6H_ENDS "r1.0-3 r0.10 b2.4 g2.0-3 g1.0-3 g0.10 b3.0 g3.0-3 b1.0-4 b0.10 b2.0-3 r2.0-3 "
                    "b3.1-2 r3.0-3 b3.4-3"},
    {14,
     2,
     9,
     {5, 5, 5},
     true,
     "r0.0-8 b2.4 g0.0-8 g2.4 b0.0-8 b3.4 r1.0-4 g3.4 g2.0-3 g1.0-4 b3.0 g3.0-3 b1.0-4 b3.1 b2.0-3 "
     "r2.0-4 b3.2 r3.0-4 b3.3"},
    {18,
     2,
     8,
     {6, 5, 5},
     true,
     "r0.0-7 g3.4 b2.4 g0.0-7 b3.2 g2.4 b0.0-7 b3.3-4 r1.0-5 g2.0-3 g1.0-4 b3.0 g3.0-3 b1.0-4 b3.1 "
     "b2.0-3 r2.0-5 r3.0-5"},
    {22,
     2,
     8,
     {5, 6, 5},
     true,
     "r0.0-7 b3.0 b2.4 g0.0-7 g2.5-4 b0.0-7 g3.5 b3.4 r1.0-4 g3.4 g2.0-3 g1.0-5 g3.0-3 b1.0-4 b3.1 "
     "b2.0-3 r2.0-4 b3.2 r3.0-4 b3.3"},
    {26,
     2,
     8,
     {5, 5, 6},
     true,
     "r0.0-7 b3.1 b2.4 g0.0-7 b2.5 g2.4 b0.0-7 b3.5-4 r1.0-4 g3.4 g2.0-3 g1.0-4 b3.0 g3.0-3 b1.0-5 "
     "b2.0-3 r2.0-4 b3.2 r3.0-4 b3.3"},
    {30,
     2,
     6,
     {6, 6, 6},
     false,
     "r0.0-5 g3.4 b3.0-1 b2.4 g0.0-5 g2.5 b2.5 b3.2 g2.4 b0.0-5 g3.5 b3.3 b3.5-4 r1.0-5 g2.0-3 "
     "g1.0-5 g3.0-3 b1.0-5 b2.0-3 r2.0-5 r3.0-5"},
    {3, 1, 10, {10, 10, 10}, false, LIMN_BC6H_ENDS "r1.0-9 g1.0-9 b1.0-9"},
    {7, 1, 11, {9, 9, 9}, true, LIMN_BC6H_ENDS "r1.0-8 r0.10 g1.0-8 g0.10 b1.0-8 b0.10"},
    {11, 1, 12, {8, 8, 8}, true, LIMN_BC6H_ENDS "r1.0-7 r0.11-10 g1.0-7 g0.11-10 b1.0-7 b0.11-10"},
    {15, 1, 16, {4, 4, 4}, true, LIMN_BC6H_ENDS "r1.0-3 r0.15-10 g1.0-3 g0.15-10 b1.0-3 b0.15-10"},
}};
#undef LIMN_BC6H_ENDS

constexpr std::uint32_t numberAt(std::string_view text, std::size_t& i) {
    std::uint32_t number = 0;
    for (; i < text.size() && text[i] >= '0' && text[i] <= '9'; ++i)
        number = 10 * number + std::uint32_t(text[i] - '0');
    return number;
}

constexpr Bc6hLayout parsed(std::string_view text) {
    Bc6hLayout layout;
    for (std::size_t i = 0; i < text.size();) {
        const std::uint32_t channel = text[i] == 'r' ? 0 : text[i] == 'g' ? 1 : 2;
        ++i;
        const std::uint32_t end = numberAt(text, i);
        ++i; // the point
        std::uint32_t bit = numberAt(text, i), last = bit;
        if (i < text.size() && text[i] == '-')
            last = numberAt(text, ++i);
        ++i; // the space
        for (const std::uint32_t step = last < bit ? ~0U : 1U;; bit += step) {
            layout.places[layout.count++] = std::uint8_t(16 * (3 * end + channel) + bit);
            if (bit == last)
                break;
        }
    }
    return layout;
}

constexpr std::array<Bc6hLayout, kModes.size()> kLayouts = [] {
    std::array<Bc6hLayout, kModes.size()> all;
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = parsed(kModes[i].layout);
    return all;
}();

/// Each mode has as many bits as its ends take.
constexpr bool fitsItsLayout(std::size_t i) {
    const Bc6hMode& m = kModes[i];
    std::uint32_t bits = 3 * m.bits;
    for (const std::uint32_t d : m.delta)
        bits += (2 * m.regions - 1) * d;
    return bits == kLayouts[i].count;
}
static_assert([] {
    for (std::size_t i = 0; i < kModes.size(); ++i)
        if (!fitsItsLayout(i))
            return false;
    return true;
}());

constexpr std::array<std::uint32_t, 8> kWeights3 = {0, 9, 18, 27, 37, 46, 55, 64};
constexpr std::array<std::uint32_t, 16> kWeights4 = {0,  4,  9,  13, 17, 21, 26, 30,
                                                     34, 38, 43, 47, 51, 55, 60, 64};

} // namespace

std::span<const Bc6hMode, 14> bc6hModes() {
    return kModes;
}

const Bc6hLayout& bc6hLayout(const Bc6hMode& mode) {
    return kLayouts[std::size_t(&mode - kModes.data())];
}

std::span<const std::uint32_t> bc6hWeights(std::uint32_t bits) {
    return bits == 3 ? std::span<const std::uint32_t>(kWeights3) : kWeights4;
}

std::int32_t bc6hUnquantised(std::int32_t value, std::uint32_t bits, Bc6hSign sign) {
    if (sign == Bc6hSign::Unsigned) {
        if (bits >= 15 || value == 0)
            return value;
        if (value == (1 << bits) - 1)
            return 0xffff;
        return ((value << 16) + 0x8000) >> bits;
    }
    const std::int32_t size = std::abs(value);
    if (bits >= 16 || size == 0)
        return value;
    const std::int32_t wide =
        size >= (1 << (bits - 1)) - 1 ? 0x7fff : ((size << 15) + 0x4000) >> (bits - 1);
    return value < 0 ? -wide : wide;
}

} // namespace limn
