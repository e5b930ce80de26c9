// SPDX-License-Identifier: MIT
#include "engine/shading/surface_point.h"

#include "engine/scene/mesh/triangle_geometry.h"
#include "engine/scene/surface/normal_map.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace limn {

glm::vec3 shadingNormalAt(const Scene& scene, const Hit& hit, NormalDetail detail) {
    const Instance& instance = scene.instances[hit.instance];
    const glm::vec2 uv(hit.u, hit.v);
    const glm::vec3 front =
        shadingNormal(scene.meshOf(instance), instance, hit.triangle, uv, hit.geometricNormal);
    return (hit.frontFace ? 1.f : -1.f) *
           (detail == NormalDetail::Map ? mappedNormal(scene, instance, hit.triangle, uv, front)
                                        : front);
}

std::optional<SurfacePoint> surfacePoint(const TraceScene& trace, const Hit& hit,
                                         NormalDetail detail) {
    const Scene& scene = trace.scene();
    const Instance& instance = scene.instances[hit.instance];
    if (!hit.frontFace && !scene.materialOf(instance).doubleSided)
        return std::nullopt;
    const SurfaceMaterial material = surfaceMaterial(scene, instance, hit.triangle, hit.u, hit.v);
    const float side = hit.frontFace ? 1.f : -1.f;
    SurfacePoint p;
    p.position = hit.position;
    p.geometricNormal = side * hit.geometricNormal;
    p.normal = shadingNormalAt(scene, hit, detail);
    p.albedo = material.albedo;
    p.emission = material.emission;
    return p;
}

glm::vec3 GlossyPoint::reflect(glm::vec3 irradiance, glm::vec3 toLight) const {
    if (irradiance == glm::vec3(0))
        return irradiance;
    return irradiance * (surface.albedo / glm::pi<float>() +
                         specularBrdf(gloss, surface.normal, toEye, toLight));
}

GlossyPoint glossyPoint(const TraceScene& trace, const Hit& hit, const Ray& ray,
                        const SurfacePoint& p) {
    const Scene& scene = trace.scene();
    return {p, surfaceGloss(scene, scene.instances[hit.instance], hit.triangle, hit.u, hit.v),
            -ray.direction};
}

glm::vec3 rayOrigin(const TraceScene& trace, const SurfacePoint& p) {
    return p.position + p.geometricNormal * trace.epsilonAt(p.position);
}

} // namespace limn
