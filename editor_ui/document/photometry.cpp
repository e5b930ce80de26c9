// SPDX-License-Identifier: MIT
#include "editor_ui/document/photometry.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/vec2.hpp>

namespace limn {

static constexpr float kMinKelvin = 1667, kMaxKelvin = 25000;

float lumen(const Light& light) {
    constexpr float kPi = glm::pi<float>();
    switch (light.kind) {
    case LightKind::Directional:
        return 0;
    case LightKind::Point:
        return 4 * kPi * light.strength;
    case LightKind::Spot: {
        const float inner = std::cos(light.innerAngle), outer = std::cos(light.outerAngle);
        return 2 * kPi * light.strength * ((1 - inner) + (inner - outer) / 3);
    }
    case LightKind::Rectangle:
        return kPi * light.strength * light.size.x * light.size.y;
    }
    return 0;
}

float strengthForLumen(const Light& light, float flux) {
    Light one = light;
    one.strength = 1;
    const float perUnit = lumen(one);
    return perUnit > 0 ? flux / perUnit : light.strength;
}

/// Planckian locus in CIE 1931 xy, cubic fits of Kim et al.
static glm::vec2 planckianXy(float kelvin) {
    const double t = 1e3 / double(kelvin);
    const double x = kelvin <= 4000
                         ? -0.2661239 * t * t * t - 0.2343589 * t * t + 0.8776956 * t + 0.179910
                         : -3.0258469 * t * t * t + 2.1070379 * t * t + 0.2226347 * t + 0.240390;
    double y = 0;
    if (kelvin <= 2222)
        y = -1.1063814 * x * x * x - 1.34811020 * x * x + 2.18555832 * x - 0.20219683;
    else if (kelvin <= 4000)
        y = -0.9549476 * x * x * x - 1.37418593 * x * x + 2.09137015 * x - 0.16748867;
    else
        y = 3.0817580 * x * x * x - 5.87338670 * x * x + 3.75112997 * x - 0.37001483;
    return {float(x), float(y)};
}

glm::vec3 blackbodyColor(float kelvin) {
    const glm::vec2 xy = planckianXy(std::clamp(kelvin, kMinKelvin, kMaxKelvin));
    const float X = xy.x / xy.y, Z = (1 - xy.x - xy.y) / xy.y;
    glm::vec3 rgb(3.2404542f * X - 1.5371385f - 0.4985314f * Z,
                  -0.9692660f * X + 1.8760108f + 0.0415560f * Z,
                  0.0556434f * X - 0.2040259f + 1.0572252f * Z);
    rgb = glm::max(rgb, glm::vec3(0));
    return rgb / std::max({rgb.x, rgb.y, rgb.z});
}

float nearestKelvin(glm::vec3 color) {
    const float largest = std::max({color.x, color.y, color.z});
    if (!(largest > 0))
        return 6500;
    const glm::vec3 wanted = color / largest;
    const auto distance = [&](float mired) {
        return glm::length(blackbodyColor(1e6f / mired) - wanted);
    };
    // Even steps in mired (1e6 / K) are about even to the eye.
    float best = 1e6f / 6500, bestDistance = distance(best);
    for (float mired = 1e6f / kMaxKelvin; mired <= 1e6f / kMinKelvin; mired += 1)
        if (const float d = distance(mired); d < bestDistance)
            best = mired, bestDistance = d;
    return 1e6f / best;
}

} // namespace limn
