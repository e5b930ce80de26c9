// SPDX-License-Identifier: MIT
#include "engine/scene/tone_map.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

namespace limn {

namespace {

// Stephen Hill's fit of the ACES reference and output transforms for sRGB displays, 2016.
glm::vec3 aces(glm::vec3 c) {
    const glm::mat3 toAp1 = glm::transpose(glm::mat3(
        0.59719f, 0.35458f, 0.04823f, 0.07600f, 0.90834f, 0.01566f, 0.02840f, 0.13383f, 0.83777f));
    const glm::mat3 toRec709 =
        glm::transpose(glm::mat3(1.60475f, -0.53108f, -0.07367f, -0.10208f, 1.10813f, -0.00605f,
                                 -0.00327f, -0.07276f, 1.07602f));
    c = glm::min(toAp1 * c, 1e4f); // the quotient has reached its limit; squares would overflow
    c = (c * (c + 0.0245786f) - 0.000090537f) / (c * (0.983729f * c + 0.4329510f) + 0.238081f);
    return toRec709 * c;
}

// Troy Sobotka's AgX, base look, in Rec. 2020 with Benjamin Wrensch's polynomial for the curve.
glm::vec3 agx(glm::vec3 c) {
    const glm::mat3 toRec2020(0.6274f, 0.0691f, 0.0164f, 0.3293f, 0.9195f, 0.0880f, 0.0433f,
                              0.0113f, 0.8956f);
    const glm::mat3 toRec709(1.6605f, -0.1246f, -0.0182f, -0.5876f, 1.1329f, -0.1006f, -0.0728f,
                             -0.0083f, 1.1187f);
    const glm::mat3 inset(0.856627153315983f, 0.137318972929847f, 0.11189821299995f,
                          0.0951212405381588f, 0.761241990602591f, 0.0767994186031903f,
                          0.0482516061458583f, 0.101439036467562f, 0.811302368396859f);
    const glm::mat3 outset(1.1271005818144368f, -0.1413297634984383f, -0.14132976349843826f,
                           -0.11060664309660323f, 1.157823702216272f, -0.11060664309660294f,
                           -0.016493938717834573f, -0.016493938717834257f, 1.2519364065950405f);
    const float minEv = -12.47393f, maxEv = 4.026069f;
    c = inset * (toRec2020 * c);
    c = glm::clamp((glm::log2(glm::max(c, 1e-10f)) - minEv) / (maxEv - minEv), 0.f, 1.f);
    const glm::vec3 c2 = c * c, c4 = c2 * c2;
    c = 15.5f * c4 * c2 - 40.14f * c4 * c + 31.96f * c4 - 6.868f * c2 * c + 0.4298f * c2 +
        0.1191f * c - 0.00232f;
    c = glm::pow(glm::max(outset * c, 0.f), glm::vec3(2.2f));
    return toRec709 * c;
}

// Khronos PBR Neutral Tone Mapper, 2024.
glm::vec3 pbrNeutral(glm::vec3 c) {
    const float startCompression = 0.8f - 0.04f, desaturation = 0.15f;
    const float x = std::min({c.r, c.g, c.b});
    c -= x < 0.08f ? x - 6.25f * x * x : 0.04f;
    const float peak = std::max({c.r, c.g, c.b});
    if (peak < startCompression)
        return c;
    const float d = 1 - startCompression;
    const float newPeak = 1 - d * d / (peak + d - startCompression);
    c *= newPeak / peak;
    const float g = 1 - 1 / (desaturation * (peak - newPeak) + 1);
    return glm::mix(c, glm::vec3(newPeak), g);
}

glm::vec3 curved(glm::vec3 c, Tonemap curve) {
    switch (curve) {
    case Tonemap::None:
        return c;
    case Tonemap::Aces:
        return aces(c);
    case Tonemap::Agx:
        return agx(c);
    case Tonemap::PbrNeutral:
        return pbrNeutral(c);
    }
    return c;
}

} // namespace

glm::vec3 toneMapped(glm::vec3 color, Tonemap curve) {
    return glm::clamp(curved(color, curve), 0.f, 1.f);
}

float encodeSrgb(float x) {
    return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f;
}

Image toneMappedImage(const ImageF& image, Tonemap curve, float exposureEv) {
    const float exposure = std::exp2(exposureEv);
    Image result{"picture", image.width, image.height, {}};
    result.rgba.reserve(image.rgb.size() * 4);
    for (const glm::vec3& p : image.rgb) {
        const glm::vec3 c = toneMapped(glm::min(p * exposure, 1e30f), curve);
        for (int k = 0; k < 3; ++k) {
            const float encoded = encodeSrgb(c[k]) * 255;
            result.rgba.push_back(encoded > 0 ? std::uint8_t(std::lround(encoded))
                                              : std::uint8_t(0));
        }
        result.rgba.push_back(255);
    }
    return result;
}

} // namespace limn
