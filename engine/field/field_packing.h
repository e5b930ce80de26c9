// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/gtc/type_precision.hpp>
#include <glm/vec4.hpp>

namespace limn {

// An IndirectField as shaders sample it: halfs in layers of four. The first chroma^2 coefficients
// have red, green and blue one after the other; the others are grey and have one value each. Every
// value is multiplied by a power of two that the whole field shares, so that neither lights of 1e10
// nor of 1e-6 leave the range of halfs. 56 bytes for 3 bands, 96 for 4; the layout is also that of
// shaders/viewport/indirect.frag and shaders/illuminance/relight_field.comp.

/// Layers of four values; chroma in [1, bands].
constexpr std::uint32_t fieldLayers(std::uint32_t bands, std::uint32_t chroma) {
    return (bands * bands + 2 * chroma * chroma + 3) / 4;
}

/// What `brightest`, the largest magnitude to come, is to be multiplied by: it lands in [2^12,
/// 2^13), far below the largest half, 65504, and what is 2e-8 of it is still a normal half. 1 for
/// 0, NaN and infinity.
float fieldScale(float brightest);

/// Whether `scale` still serves: `brightest` may grow four times, or fall to 1/256.
bool scaleServes(float scale, float brightest);

/// Largest magnitude of red, green and blue; 0 of nothing.
float brightestOf(std::span<const glm::vec4> coefficients);

/// `coefficients`: bands^2 layers of as many texels each, RGB in xyz. What the scale leaves above
/// 65504 is that; NaN is 0.
std::vector<glm::u16vec4> packField(std::span<const glm::vec4> coefficients, std::uint32_t bands,
                                    std::uint32_t chroma, float scale);

/// The inverse, but for rounding: relative 2^-11, and of what is far below the brightest, 2^-25
/// over the scale.
std::vector<glm::vec4> unpackField(std::span<const glm::u16vec4> packed, std::uint32_t bands,
                                   std::uint32_t chroma, float scale);

} // namespace limn
