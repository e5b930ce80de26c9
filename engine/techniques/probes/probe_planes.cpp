// SPDX-License-Identifier: MIT
#include "engine/techniques/probes/probe_planes.h"

#include "engine/scene/mesh/triangle_geometry.h"

#include <glm/geometric.hpp>

namespace limn {

glm::vec3 seenNormal(const Scene& scene, const ProbeHit& hit) {
    const Instance& instance = scene.instances[hit.instance];
    const glm::vec3 front = glm::normalize(instance.normalToWorld *
                                           triangleNormal(scene.meshOf(instance), hit.triangle));
    return hit.side == 0 ? front : -front;
}

static glm::vec4 planeOf(const Scene& scene, const ProbeHit& hit, glm::vec3 direction) {
    if (hit.instance == ~0U || !(hit.distance > 0))
        return glm::vec4(0, 0, 0, MarchedMaps::kSky);
    const bool solid = hit.side == kInSolid;
    return marchedPlane(direction, hit.distance, seenNormal(scene, hit),
                        solid ? MarchedMaps::kSolid : MarchedMaps::kSurface);
}

void writePlanes(const Scene& scene, const ProbeMaps& seen, std::uint32_t probe,
                 MarchedMaps& maps) {
    const std::size_t first = probe * maps.texels();
    for (std::uint32_t t = 0; t < seen.map.texels(); ++t)
        maps.planes[first + t] = planeOf(scene, seen.hits[first + t], seen.map.direction(t));
    maps.inSolid[probe] = seen.inSolid[probe];
    updateNearest(maps, probe);
}

} // namespace limn
