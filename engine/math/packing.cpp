// SPDX-License-Identifier: MIT
#include "engine/math/packing.h"

#include <algorithm>

namespace limn {

std::uint16_t floatToHalf(float value) {
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(value);
    const auto sign = std::uint16_t((bits >> 16) & 0x8000U);
    const float magnitude = std::abs(value);
    if (!(magnitude < 65520.f)) // rounds up to infinity; NaN becomes infinity too
        return std::uint16_t(sign | 0x7c00U);
    if (magnitude < 0x1p-14f) // denormal: a multiple of 2^-24
        return std::uint16_t(sign | std::uint16_t(std::nearbyint(magnitude * 0x1p24f)));
    const std::uint32_t m = bits & 0x7fffffffU;
    const std::uint32_t rounded = m + 0xfffU + ((m >> 13) & 1U);
    return std::uint16_t(sign | std::uint16_t((rounded >> 13) - (112U << 10)));
}

std::uint32_t packRgb9e5(glm::vec3 color) {
    constexpr float kMaximum = 65408; // 511/512 2^16
    for (int c = 0; c < 3; ++c)
        color[c] = color[c] > 0 ? std::min(color[c], kMaximum) : 0.f;
    const float maximum = std::max({color.x, color.y, color.z});
    int exponent = -15; // of the step's 2^9 multiple: values lie below 2^exponent
    if (maximum > 0)
        exponent = std::max(std::ilogb(maximum) + 1, exponent);
    if (std::lround(std::ldexp(maximum, 9 - exponent)) == 512)
        ++exponent;
    const auto mantissa = [&](float v) {
        return std::uint32_t(std::lround(std::ldexp(v, 9 - exponent)));
    };
    return mantissa(color.x) | mantissa(color.y) << 9 | mantissa(color.z) << 18 |
           std::uint32_t(exponent + 15) << 27;
}

glm::vec3 unpackRgb9e5(std::uint32_t packed) {
    const float step = std::ldexp(1.f, int(packed >> 27) - 15 - 9);
    return step *
           glm::vec3(float(packed & 511), float(packed >> 9 & 511), float(packed >> 18 & 511));
}

Oct16 packOct(glm::vec3 d) {
    const glm::vec2 p = norm1(d) > 0 ? octahedralSquare(d) : glm::vec2(0);
    const auto snorm = [](float v) {
        return std::uint16_t(std::int16_t(std::lround(std::clamp(v, -1.f, 1.f) * 32767.f)));
    };
    return {snorm(p.x), snorm(p.y)};
}

std::uint32_t packOctWord(glm::vec3 d) {
    const Oct16 packed = packOct(d);
    return packed.x | std::uint32_t(packed.y) << 16;
}

} // namespace limn
