// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/gtc/type_precision.hpp>
#include <glm/vec4.hpp>

namespace limn {

// The packed form of an IndirectField that shaders sample: halfs in layers of four. The first
// chroma^2 coefficients store red, green and blue one after the other; the remaining ones are grey
// and store one value each. Every value is multiplied by a power of two that the whole field
// shares, so that neither lights of 1e10 nor of 1e-6 leave the range of halfs. A texel takes 56
// bytes for 3 bands and 96 for 4. shaders/viewport/indirect.frag and the compute shaders that write
// fields, such as shaders/illuminance/relight_field.comp, use the same layout.

/// Number of layers of four values; chroma in [1, bands].
constexpr std::uint32_t fieldLayers(std::uint32_t bands, std::uint32_t chroma) {
    return (bands * bands + 2 * chroma * chroma + 3) / 4;
}

/// Factor by which packed values are multiplied, a power of two. It takes `brightest`, the largest
/// expected magnitude, to [2^12, 2^13), far below the largest half, 65504, so that values down to
/// 2e-8 of it remain normal halfs. Returns 1 for 0, NaN and infinity.
float fieldScale(float brightest);

/// Whether `scale` can still be used: `brightest` may grow fourfold or fall to 1/256.
bool scaleServes(float scale, float brightest);

/// Largest magnitude of red, green and blue; 0 for an empty span.
float brightestOf(std::span<const glm::vec4> coefficients);

/// Packs `coefficients`: bands^2 layers with the same number of texels each, RGB in xyz. Scaled
/// values above 65504 are clamped to it; NaN becomes 0.
std::vector<glm::u16vec4> packField(std::span<const glm::vec4> coefficients, std::uint32_t bands,
                                    std::uint32_t chroma, float scale);

/// Inverse of packField() up to rounding: the relative error is 2^-11; values far below the
/// brightest have an absolute error of 2^-25 / scale.
std::vector<glm::vec4> unpackField(std::span<const glm::u16vec4> packed, std::uint32_t bands,
                                   std::uint32_t chroma, float scale);

} // namespace limn
