// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/senders/surfel_normals.h"

#include "engine/core/parallel.h"
#include "engine/scene/mesh/triangle_geometry.h"

#include <glm/geometric.hpp>

namespace limn {

namespace {

/// Unit normal of the front; 0 where the triangle has none.
glm::vec3 frontNormal(const Scene& scene, const Surfels& surfels, std::uint32_t surfel) {
    const Instance& instance = scene.instances[surfels.instance[surfel]];
    const glm::vec3 n =
        instance.normalToWorld * triangleNormal(scene.meshOf(instance), surfels.triangle[surfel]);
    const float length = glm::length(n);
    return length > 0 ? n / length : glm::vec3(0);
}

float sideOf(const Surfels& surfels, std::uint32_t surfel, glm::vec3 front) {
    return glm::dot(front, surfels.normal[surfel]) < 0 ? -1.f : 1.f;
}

} // namespace

glm::vec3 geometricNormal(const Scene& scene, const Surfels& surfels, std::uint32_t surfel) {
    const glm::vec3 front = frontNormal(scene, surfels, surfel);
    return front == glm::vec3(0) ? surfels.normal[surfel] : sideOf(surfels, surfel, front) * front;
}

glm::vec3 vertexNormal(const Scene& scene, const Surfels& surfels, std::uint32_t surfel) {
    const Instance& instance = scene.instances[surfels.instance[surfel]];
    const glm::vec3 front = frontNormal(scene, surfels, surfel);
    if (front == glm::vec3(0))
        return surfels.normal[surfel];
    return sideOf(surfels, surfel, front) * shadingNormal(scene.meshOf(instance), instance,
                                                          surfels.triangle[surfel],
                                                          surfels.barycentric[surfel], front);
}

void shade(const Scene& scene, Surfels& surfels) {
    parallelRanges(surfels.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (auto s = std::uint32_t(begin); s < end; ++s) {
            const glm::vec3 surface = surfels.normal[s];
            surfels.normal[s] = vertexNormal(scene, surfels, s);
            surfels.cacheWeight[s] *= (1 + glm::dot(surface, surfels.normal[s])) / 2;
        }
    });
}

} // namespace limn
