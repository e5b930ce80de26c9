// SPDX-License-Identifier: MIT
#include "engine/field/field_packing.h"

#include "engine/core/parallel.h"
#include "engine/math/packing.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/common.hpp>

namespace limn {

namespace {

constexpr float kLargestHalf = 65504;
constexpr std::size_t kTexels = 4096; ///< of one task

/// Position of the value with index `value` of a field.
struct Place {
    std::uint32_t coefficient;
    int channel;
    bool grey; ///< the others are alike
};

Place placeOf(std::uint32_t value, std::uint32_t chroma) {
    const std::uint32_t coloured = 3 * chroma * chroma;
    return value < coloured ? Place{value / 3, int(value % 3), false}
                            : Place{value - coloured + chroma * chroma, 0, true};
}

std::uint32_t valuesOf(std::uint32_t bands, std::uint32_t chroma) {
    return bands * bands + 2 * chroma * chroma;
}

} // namespace

float fieldScale(float brightest) {
    if (!(brightest > 0) || std::isinf(brightest))
        return 1;
    return std::ldexp(1.f, std::clamp(12 - std::ilogb(brightest), -120, 120));
}

bool scaleServes(float scale, float brightest) {
    const float scaled = scale * brightest;
    return brightest == 0 ? scale > 0 : scaled >= 0x1p4f && scaled < 0x1p15f;
}

float brightestOf(std::span<const glm::vec4> coefficients) {
    glm::vec3 maximum(0);
    for (const glm::vec4& c : coefficients)
        maximum = glm::max(maximum, glm::abs(glm::vec3(c)));
    return std::max({maximum.x, maximum.y, maximum.z});
}

std::vector<glm::u16vec4> packField(std::span<const glm::vec4> coefficients, std::uint32_t bands,
                                    std::uint32_t chroma, float scale) {
    assert(chroma >= 1 && chroma <= bands && coefficients.size() % (bands * bands) == 0);
    const std::size_t texels = coefficients.size() / (bands * bands);
    const std::uint32_t values = valuesOf(bands, chroma);
    std::vector<glm::u16vec4> packed(fieldLayers(bands, chroma) * texels, glm::u16vec4(0));
    parallelRanges(texels, kTexels, [&](std::size_t begin, std::size_t end) {
        for (std::uint32_t v = 0; v < values; ++v) {
            const Place place = placeOf(v, chroma);
            const glm::vec4* from = &coefficients[place.coefficient * texels];
            glm::u16vec4* to = &packed[v / 4 * texels];
            for (std::size_t t = begin; t < end; ++t) {
                const float scaled = from[t][place.channel] * scale;
                const float clamped = std::clamp(scaled, -kLargestHalf, kLargestHalf);
                to[t][int(v % 4)] = floatToHalf(scaled == scaled ? clamped : 0.f);
            }
        }
    });
    return packed;
}

std::vector<glm::vec4> unpackField(std::span<const glm::u16vec4> packed, std::uint32_t bands,
                                   std::uint32_t chroma, float scale) {
    const std::size_t texels = packed.size() / fieldLayers(bands, chroma);
    std::vector<glm::vec4> coefficients(texels * bands * bands, glm::vec4(0));
    for (std::uint32_t v = 0; v < valuesOf(bands, chroma); ++v) {
        const Place place = placeOf(v, chroma);
        for (std::size_t t = 0; t < texels; ++t) {
            const float value = halfToFloat(packed[v / 4 * texels + t][int(v % 4)]) / scale;
            glm::vec4& c = coefficients[place.coefficient * texels + t];
            if (place.grey)
                c = glm::vec4(glm::vec3(value), 0);
            else
                c[place.channel] = value;
        }
    }
    return coefficients;
}

} // namespace limn
