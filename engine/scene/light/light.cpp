// SPDX-License-Identifier: MIT
#include "engine/scene/light/light.h"

#include "engine/scene/light/rectangle_light.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

// KHR_lights_punctual: the smooth edge of a spot is ((cos - cosOuter) / (cosInner - cosOuter))^2.
static float spotFalloff(const Light& light, glm::vec3 toLight) {
    const float cosOuter = std::cos(light.outerAngle);
    const float cosInner = std::max(std::cos(light.innerAngle), cosOuter + 1e-4f);
    const float t = (glm::dot(-toLight, light.direction) - cosOuter) / (cosInner - cosOuter);
    const float clamped = std::clamp(t, 0.f, 1.f);
    return clamped * clamped;
}

const LightProfile* profileOf(const Light& light) {
    return light.kind == LightKind::Point || light.kind == LightKind::Spot
               ? light.profile.profile.get()
               : nullptr;
}

glm::mat3 profileAxes(const Light& light) {
    Light unit = {.direction = light.direction, .size = glm::vec2(2), .roll = light.roll};
    const LightRectangle rectangle = lightRectangle(unit);
    return {rectangle.halfWidth, rectangle.halfHeight, light.direction};
}

LightSample sampleLight(const Light& light, glm::vec3 p) {
    constexpr float kNearest = 1e-8f; // shadowed_light.glsl has its square
    LightSample s;
    if (!light.enabled || light.kind == LightKind::Rectangle)
        return s;
    if (light.kind == LightKind::Directional) {
        s.toLight = -light.direction;
        s.distance = std::numeric_limits<float>::infinity();
        s.irradiance = light.color * light.strength;
        return s;
    }
    const glm::vec3 d = light.position - p;
    const float d2 = glm::dot(d, d);
    if (!(d2 > 0))
        return s;
    s.distance = std::sqrt(d2);
    s.toLight = d / s.distance;
    float window = 1;
    if (light.range > 0) {
        const float q = s.distance / light.range;
        window = std::clamp(1 - q * q * q * q, 0.f, 1.f);
    }
    if (light.kind == LightKind::Spot)
        window *= spotFalloff(light, s.toLight);
    if (const LightProfile* profile = profileOf(light); profile && window > 0)
        window *= profileShare(*profile, profileAxes(light), -s.toLight);
    const float intensity = light.strength * window;
    s.irradiance =
        glm::min(light.color * (intensity / std::max(d2, kNearest * kNearest)), kMaxIrradiance);
    return s;
}

} // namespace limn
