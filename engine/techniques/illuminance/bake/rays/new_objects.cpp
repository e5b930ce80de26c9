// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/rays/new_objects.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace limn {

static std::vector<bool> maskOf(std::size_t count, const std::vector<std::uint32_t>& chosen) {
    std::vector<bool> mask(count);
    for (const std::uint32_t i : chosen)
        mask[i] = true;
    return mask;
}

BoundingSphere sphereAround(const TraceScene& trace, const Mesh& mesh, const glm::mat4& toWorld) {
    if (mesh.positions.empty())
        return {};
    const Bounds box = boundsOf(mesh.positions | std::views::transform([&](glm::vec3 p) {
                                    return glm::vec3(toWorld * glm::vec4(p, 1));
                                }));
    return {box.centre(), glm::length(box.size()) * 0.505f + trace.epsilonAt(box.centre()) * 4};
}

NewObjects::NewObjects(const TraceScene& trace, const std::vector<std::uint32_t>& instances)
    : m_objects(trace.scene(), maskOf(trace.scene().instances.size(), instances)) {
    for (const std::uint32_t i : instances) {
        const Instance& instance = trace.scene().instances[i];
        m_spheres.push_back(sphereAround(trace, trace.scene().meshOf(instance), instance.toWorld));
    }
}

// z decreases along the lattice, so a cone's rays lie within one contiguous range of it.
void NewObjects::markInCone(const CacheRays& rays, std::uint32_t k, glm::vec3 from,
                            const BoundingSphere& sphere,
                            std::vector<std::uint8_t>& candidate) const {
    const glm::vec3 way = sphere.centre - from;
    const float distance = glm::length(way);
    const auto count = std::uint32_t(candidate.size());
    float minCosine = -2; // all
    glm::vec3 axis(0, 0, 1);
    std::uint32_t begin = 0, end = count;
    if (distance > sphere.radius) {
        axis = glm::transpose(rays.toWorld[k]) * (way / distance);
        const float half = std::asin(std::min(1.f, sphere.radius / distance)) + 1e-3f;
        const float toAxis = std::acos(std::clamp(axis.z, -1.f, 1.f));
        minCosine = std::cos(half);
        const float highest = toAxis > half ? std::cos(toAxis - half) : 1.f;
        const float lowest =
            toAxis + half < 3.14159f ? std::cos(std::min(toAxis + half, 3.14159f)) : -1.f;
        const auto place = [&](float z) { return rays.local.above(z) * float(count); };
        begin = std::uint32_t(std::clamp(place(highest) - 2, 0.f, float(count)));
        end = std::uint32_t(std::clamp(place(lowest) + 2, 0.f, float(count)));
    }
    begin += (k + rays.points - begin % rays.points) % rays.points;
    for (std::uint32_t r = begin; r < end; r += rays.points)
        if (!candidate[r] && glm::dot(rays.local[r], axis) >= minCosine)
            candidate[r] = 1;
}

std::uint32_t NewObjects::mark(const RayGatherer& gatherer, const CachePoints& points,
                               std::uint32_t cache, std::vector<std::uint8_t>& met) const {
    const CacheRays rays = gatherer.directions(cache);
    std::vector<std::uint8_t> candidate(met.size());
    for (std::uint32_t k = 0; k < rays.points; ++k)
        for (const BoundingSphere& sphere : m_spheres)
            markInCone(rays, k, points.position[points.begin[cache] + k], sphere, candidate);
    std::uint32_t traced = 0;
    for (std::uint32_t r = 0; r < met.size(); ++r) {
        if (!candidate[r] || met[r])
            continue;
        ++traced;
        met[r] = m_objects.occluded(gatherer.ray(rays, cache, r), TraceMask::Static) ? 1 : 0;
    }
    return traced;
}

} // namespace limn
