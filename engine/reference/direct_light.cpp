// SPDX-License-Identifier: MIT
#include "engine/reference/direct_light.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace limn {

namespace {

struct Unshadowed {
    glm::vec3 irradiance{0};
    LightSample sample;
};

Unshadowed unshadowed(const Light& light, const SurfacePoint& p) {
    Unshadowed u;
    u.sample = sampleLight(light, p.position);
    if (glm::dot(p.geometricNormal, u.sample.toLight) > 0)
        u.irradiance = u.sample.irradiance * std::max(0.f, glm::dot(p.normal, u.sample.toLight));
    return u;
}

bool inShadow(const TraceScene& trace, const SurfacePoint& p, const LightSample& s) {
    Ray ray;
    ray.origin = rayOrigin(trace, p);
    if (std::isinf(s.distance)) {
        ray.direction = s.toLight;
        return trace.occluded(ray);
    }
    const glm::vec3 light = p.position + s.toLight * s.distance;
    const glm::vec3 way = light - ray.origin;
    const float distance = glm::length(way);
    ray.tFar = distance - trace.epsilonAt(light); // a lamp on a wall is not in the wall's shadow
    if (!(ray.tFar > 0))
        return false;
    ray.direction = way / distance;
    return trace.occluded(ray);
}

float strength(glm::vec3 e) {
    return e.x + e.y + e.z;
}

} // namespace

glm::vec3 directIrradiance(const TraceScene& trace, const SurfacePoint& p, std::uint64_t& rays) {
    glm::vec3 E(0);
    for (const Light& light : trace.scene().lights) {
        const Unshadowed l = unshadowed(light, p);
        if (!(strength(l.irradiance) > 0))
            continue;
        ++rays;
        if (!inShadow(trace, p, l.sample))
            E += l.irradiance;
    }
    return E;
}

glm::vec3 sampleDirectIrradiance(const TraceScene& trace, const SurfacePoint& p, float u,
                                 std::uint64_t& rays) {
    float total = 0;
    for (const Light& light : trace.scene().lights)
        total += strength(unshadowed(light, p).irradiance);
    if (!(total > 0))
        return glm::vec3(0);
    float below = 0;
    Unshadowed chosen;
    for (const Light& light : trace.scene().lights) {
        const Unshadowed l = unshadowed(light, p);
        if (!(strength(l.irradiance) > 0))
            continue;
        chosen = l;
        below += strength(l.irradiance);
        if (u * total < below)
            break;
    }
    ++rays;
    if (inShadow(trace, p, chosen.sample))
        return glm::vec3(0);
    return chosen.irradiance * (total / strength(chosen.irradiance));
}

} // namespace limn
