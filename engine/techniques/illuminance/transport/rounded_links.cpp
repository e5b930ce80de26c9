// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/transport/rounded_links.h"

#include <algorithm>

namespace limn {

namespace {

constexpr int kDirectionBits = 6, kTransportBits = 3, kWidthBits = 5; ///< lowest bits that go

/// The nearest multiple of 2^bits, away from 0 at a tie, within the range of 16-bit snorms.
std::uint16_t roundSnorm(std::uint16_t stored, int bits) {
    const int value = std::int16_t(stored), step = 1 << bits, limit = 32767 / step * step;
    const int magnitude = (std::abs(value) + step / 2) / step * step;
    const int rounded = std::min(magnitude, limit);
    return std::uint16_t(value < 0 ? -rounded : rounded);
}

/// The same for a half >= 0, whose bits grow with its value. Ties go to even multiples: away from
/// 0, they would make 0.03 % of light.
std::uint16_t roundHalf(std::uint16_t half, int bits) {
    constexpr int kInfinity = 0x7c00;
    const int step = 1 << bits, odd = (half >> bits) & 1;
    return std::uint16_t(std::min((half + step / 2 - 1 + odd) / step * step, kInfinity - step));
}

} // namespace

std::vector<Link> roundLinks(std::span<const Link> links) {
    std::vector<Link> rounded(links.begin(), links.end());
    for (Link& link : rounded) {
        link.octX = roundSnorm(link.octX, kDirectionBits);
        link.octY = roundSnorm(link.octY, kDirectionBits);
        link.transport = roundHalf(link.transport, kTransportBits);
        link.u = std::min<std::uint16_t>(roundHalf(link.u, kWidthBits), 0x4000); // u <= 2
    }
    return rounded;
}

} // namespace limn
