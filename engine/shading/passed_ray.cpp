// SPDX-License-Identifier: MIT
#include "engine/shading/passed_ray.h"

#include "engine/scene/surface/dielectric.h"
#include "engine/shading/surface_point.h"

#include <glm/geometric.hpp>

namespace limn {

bool isWithinBody(const Scene& scene, const Hit& hit) {
    const Material& m = scene.materialOf(scene.instances[hit.instance]);
    return !hit.frontFace && m.transmission > 0 && m.thickness > 0;
}

PassedRay passRay(const TraceScene& trace, const Hit& hit, const Ray& ray, float pick,
                  glm::vec2 facet) {
    const Scene& scene = trace.scene();
    const Instance& instance = scene.instances[hit.instance];
    const Transmission t = surfaceTransmission(scene, instance, hit.triangle, hit.u, hit.v);
    if (!t)
        return {};
    const float side = hit.frontFace ? 1.f : -1.f;
    const glm::vec3 geometricNormal = side * hit.geometricNormal, toEye = -ray.direction;
    glm::vec3 n = shadingNormalAt(scene, hit);
    if (!(glm::dot(n, toEye) > 0))
        n = geometricNormal;
    const bool inside = isWithinBody(scene, hit);
    const BoundarySplit split = splitAtBoundary(t, n, toEye, inside, facet);
    const bool mirrors = inside && pick < split.reflectance;
    const glm::vec3 direction = mirrors ? split.mirrored : split.refracted;
    const float away = mirrors ? 1.f : -1.f;
    if (!(away * glm::dot(direction, geometricNormal) > 0))
        return {};
    PassedRay passed;
    const float offset = away * trace.epsilonAt(hit.position);
    passed.ray = {hit.position + offset * geometricNormal, direction};
    if (mirrors)
        passed.weight = glm::vec3(t.share * split.mirroredShare);
    else
        passed.weight = t.tint * (split.refractedShare * (inside ? 1 : 1 - split.reflectance));
    return passed;
}

} // namespace limn
