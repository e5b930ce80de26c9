// SPDX-License-Identifier: MIT
#include "engine/reference/surface_point.h"

#include <array>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace limn {

// Interpolated normal on the front's side; the triangle's own where the file's normals are useless.
static glm::vec3 shadingNormal(const Mesh& mesh, const Instance& instance, const Hit& hit) {
    if (mesh.normals.empty())
        return hit.geometricNormal;
    const std::array<std::uint32_t, 3> k = mesh.triangle(hit.triangle);
    const glm::vec3 n = (1 - hit.u - hit.v) * mesh.normals[k[0]] + hit.u * mesh.normals[k[1]] +
                        hit.v * mesh.normals[k[2]];
    // The cofactor matrix up to a positive factor; its sign under mirroring is settled below.
    glm::vec3 world = instance.normalToWorld * n;
    const float length = glm::length(world);
    if (!(length > 0))
        return hit.geometricNormal;
    world /= length;
    return glm::dot(world, hit.geometricNormal) > 0 ? world : hit.geometricNormal;
}

std::optional<SurfacePoint> surfacePoint(const TraceScene& trace, const Hit& hit) {
    const Scene& scene = trace.scene();
    const Instance& instance = scene.instances[hit.instance];
    if (!hit.frontFace && !scene.materialOf(instance).doubleSided)
        return std::nullopt;
    const SurfaceMaterial material = surfaceMaterial(scene, instance, hit.triangle, hit.u, hit.v);
    const float side = hit.frontFace ? 1.f : -1.f;
    SurfacePoint p;
    p.position = hit.position;
    p.geometricNormal = side * hit.geometricNormal;
    p.normal = side * shadingNormal(scene.meshOf(instance), instance, hit);
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
