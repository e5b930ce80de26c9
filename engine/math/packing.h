// SPDX-License-Identifier: MIT
#pragma once

#include "engine/math/octahedral.h"

#include <bit>
#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// Converts to IEEE 754 binary16, rounded to nearest even; overflow becomes infinity, values below
/// 2^-25 zero.
std::uint16_t floatToHalf(float value);

/// Exact for all finite halfs, including denormals and under FlushDenormals. Infinity and NaN,
/// which no writer here stores, are not decoded.
inline float halfToFloat(std::uint16_t h) {
    const std::uint32_t magnitude = h & 0x7fffU;
    const float value = magnitude < 0x400U // a multiple of 2^-24
                            ? float(int(magnitude)) * 0x1p-24f
                            : std::bit_cast<float>((magnitude << 13) + (112U << 23));
    return (h & 0x8000U) != 0 ? -value : value;
}

/// Packs a colour >= 0 into 32 bits: mantissas of 9 bits each for r, g, b from the lowest bit on,
/// and a shared exponent of 5 bits. The error is within 1/1024 of the largest component. Components
/// above 65408 are clamped to it; negative ones and NaN become 0. VK_FORMAT_E5B9G9R9_UFLOAT_PACK32,
/// after the Vulkan specification's "RGB to Shared Exponent".
std::uint32_t packRgb9e5(glm::vec3 color);
glm::vec3 unpackRgb9e5(std::uint32_t packed);

/// Unit vector as an octahedral map in 2 x 16-bit snorm; the error is below 6.5e-5 rad.
/// Cigolle et al. A Survey of Efficient Representations for Independent Unit Vectors. 2014
struct Oct16 {
    std::uint16_t x, y;
};
Oct16 packOct(glm::vec3 d);
/// packOct() in one word, x in its lower half, as unpackSnorm2x16() of GLSL reads it.
std::uint32_t packOctWord(glm::vec3 d);

/// Unnormalised octahedral direction; must be normalised before use.
inline glm::vec3 unpackOctUnnormalised(std::uint16_t px, std::uint16_t py) {
    return octahedralPoint(glm::vec2(float(std::int16_t(px)) * (1 / 32767.f),
                                     float(std::int16_t(py)) * (1 / 32767.f)));
}

inline glm::vec3 unpackOct(std::uint16_t px, std::uint16_t py) {
    return glm::normalize(unpackOctUnnormalised(px, py));
}

} // namespace limn
