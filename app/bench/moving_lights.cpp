// SPDX-License-Identifier: MIT
#include "app/bench/moving_lights.h"

#include "engine/math/sampling.h"
#include "engine/scene/mesh/triangle_geometry.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace limn {

SurfacePoints spreadPoints(const Scene& scene, std::uint32_t count) {
    double area = 0;
    for (const Instance& instance : scene.instances)
        area += instance.dynamic ? 0 : worldArea(scene, instance);
    SurfacePoints points;
    double passed = 0; // area of the triangles so far
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshOf(instance);
        for (std::size_t t = 0; t < mesh.triangleCount() && !instance.dynamic; ++t) {
            passed += double(triangleWorldArea(scene, instance, t));
            while (points.positions.size() < count &&
                   passed * count >= area * (double(points.positions.size()) + 0.5)) {
                const auto k = std::uint32_t(points.positions.size());
                const glm::vec2 uv = sampleTriangle({radicalInverse(k, 2), radicalInverse(k, 3)});
                points.positions.emplace_back(instance.toWorld *
                                              glm::vec4(trianglePoint(mesh, t, uv), 1));
                points.normals.push_back(
                    glm::normalize(instance.normalToWorld * triangleNormal(mesh, t)));
            }
        }
    }
    return points;
}

std::vector<Light> pointsOver(const Scene& scene, std::span<const glm::vec3> positions,
                              std::span<const glm::vec3> normals, std::uint32_t count) {
    std::vector<Light> lights(count);
    for (std::uint32_t k = 0; k < count; ++k) {
        const std::size_t s =
            (2 * std::size_t(k) + 1) * positions.size() / (2 * std::size_t(count));
        lights[k].position = positions[s] + normals[s] * (0.05f * glm::length(scene.bounds.size()));
        lights[k].strength = 10;
    }
    return lights;
}

void moveObjects(Scene& scene, const Scene& standing, int k) {
    const float a = 0.1f * float(k), radius = 0.05f * glm::length(standing.bounds.size());
    const glm::vec4 offset(radius * std::sin(a), 0, radius * (std::cos(a) - 1), 0);
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
        if (scene.instances[i].dynamic)
            scene.instances[i].toWorld[3] = standing.instances[i].toWorld[3] + offset;
}

} // namespace limn
