// SPDX-License-Identifier: MIT
#include "engine/shading/incident_light.h"

#include <glm/geometric.hpp>

namespace limn {

IncidentLightSample sampleEmitterLight(const TraceScene& trace, const Emitters& emitters,
                                       const SurfacePoint& p, float pick, glm::vec2 u,
                                       std::uint64_t& rays) {
    if (emitters.empty())
        return {};
    const EmitterSample s = sampleEmitter(emitters, trace.scene(), p.position, pick, u);
    if (s.radiance == glm::vec3(0))
        return {};
    const glm::vec3 origin = rayOrigin(trace, p);
    const glm::vec3 way = s.position + s.normal * trace.epsilonAt(s.position) - origin;
    const float distance = glm::length(way);
    const glm::vec3 direction = way / distance;
    const float cosTheta = glm::dot(p.normal, direction);
    if (!(cosTheta > 0) || !(glm::dot(p.geometricNormal, direction) > 0))
        return {};
    ++rays;
    if (trace.occluded({origin, direction, 0, distance}))
        return {};
    return {s.radiance * (cosTheta / s.pdf), direction, s.pdf, s.instance};
}

IncidentLightSample sampleSkyLight(const TraceScene& trace, const SkyLight& sky,
                                   const SurfacePoint& p, glm::vec2 u, std::uint64_t& rays) {
    if (sky.empty())
        return {};
    const SkySample s = sampleSky(sky, trace.scene().sky, u);
    const float cosTheta = glm::dot(p.normal, s.direction);
    if (!(s.pdf > 0) || !(cosTheta > 0) || !(glm::dot(p.geometricNormal, s.direction) > 0))
        return {};
    ++rays;
    if (trace.occluded({rayOrigin(trace, p), s.direction}))
        return {};
    return {s.radiance * (cosTheta / s.pdf), s.direction, s.pdf};
}

} // namespace limn
