// SPDX-License-Identifier: MIT
#include "engine/lightmap/texel_points.h"

#include "engine/math/sampling.h"
#include "engine/math/unit_vector.h"

#include <bit>

#include <glm/geometric.hpp>

namespace limn {

WorldPoint worldPoint(const Scene& scene, const Instance& instance, const MeshPoint& point,
                      bool back) {
    const Mesh& mesh = scene.meshOf(instance);
    const auto [a, b, c] = mesh.triangle(point.triangle);
    const glm::vec3 pa = mesh.positions[a], pb = mesh.positions[b], pc = mesh.positions[c];
    const glm::vec2 uv = point.barycentric;
    const glm::vec3 normal =
        unitOr(instance.normalToWorld * glm::cross(pb - pa, pc - pa), glm::vec3(0, 1, 0));
    return {instance.toWorld * glm::vec4(pa * (1 - uv.x - uv.y) + pb * uv.x + pc * uv.y, 1),
            back ? -normal : normal};
}

WorldPoint texelPoint(const Scene& scene, const AtlasTexel& texel, std::uint32_t k) {
    return worldPoint(scene, scene.instances[texel.instance], texel.points[k], texel.back != 0);
}

Ray rayAbove(const TraceScene& trace, const WorldPoint& point, float height) {
    return {trace.clearOf(point.position, point.normal), point.normal, 0, 2 * height};
}

RaisedPoint raise(const TraceScene& trace, const WorldPoint& point, float height) {
    const Ray ray = rayAbove(trace, point, height);
    const SurfaceHit above = trace.closestSurface(ray, TraceMask::Static);
    return {ray.origin + ray.direction * (above ? above.t / 2 : height), bool(above)};
}

std::uint32_t seedOf(const Scene& scene, const AtlasTexel& texel) {
    const Instance& instance = scene.instances[texel.instance];
    const MeshPoint& point = texel.points[0];
    std::uint32_t seed = mixBits(instance.mesh ^ (texel.back << 31));
    for (const std::uint32_t v : {std::uint32_t(instance.node), point.triangle,
                                  std::bit_cast<std::uint32_t>(point.barycentric.x),
                                  std::bit_cast<std::uint32_t>(point.barycentric.y)})
        seed = mixBits(seed ^ v) + seed;
    return seed;
}

} // namespace limn
