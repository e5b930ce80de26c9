// SPDX-License-Identifier: MIT
#include "engine/scene/mesh/triangle_geometry.h"

#include <ranges>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>

namespace limn {

/// Twice the area, along the normal. Computed in doubles, because the squares of a needle of 0.1 um
/// underflow floats and it would have no area.
static glm::dvec3 edgeCross(const Mesh& mesh, std::size_t triangle) {
    const auto [a, b, c] = mesh.triangle(triangle);
    const glm::dvec3 o(mesh.positions[a]);
    return glm::cross(glm::dvec3(mesh.positions[b]) - o, glm::dvec3(mesh.positions[c]) - o);
}

static glm::vec3 unitOr(glm::dvec3 n, double length) {
    return length > 0 ? glm::vec3(n / length) : glm::vec3(0, 1, 0);
}

float triangleArea(const Mesh& mesh, std::size_t triangle) {
    return float(glm::length(edgeCross(mesh, triangle)) / 2);
}

glm::vec3 triangleNormal(const Mesh& mesh, std::size_t triangle) {
    const glm::dvec3 n = edgeCross(mesh, triangle);
    return unitOr(n, glm::length(n));
}

glm::vec3 trianglePoint(const Mesh& mesh, std::size_t triangle, glm::vec2 uv) {
    const auto [a, b, c] = mesh.triangle(triangle);
    return mesh.positions[a] * (1 - uv.x - uv.y) + mesh.positions[b] * uv.x +
           mesh.positions[c] * uv.y;
}

TriangleGeometry triangleGeometry(const Mesh& mesh) {
    TriangleGeometry g;
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
        const glm::dvec3 n = edgeCross(mesh, t);
        const double length = glm::length(n);
        g.normal.push_back(unitOr(n, length));
        g.area.push_back(float(length / 2));
    }
    return g;
}

glm::vec3 shadingNormal(const Mesh& mesh, const Instance& instance, std::size_t triangle,
                        glm::vec2 uv, glm::vec3 geometric) {
    if (mesh.normals.empty())
        return geometric;
    const auto [a, b, c] = mesh.triangle(triangle);
    // The cofactor matrix up to a positive factor; its sign under mirroring is settled below.
    const glm::vec3 world =
        instance.normalToWorld *
        ((1 - uv.x - uv.y) * mesh.normals[a] + uv.x * mesh.normals[b] + uv.y * mesh.normals[c]);
    const float length = glm::length(world);
    return length > 0 && glm::dot(world, geometric) > 0 ? world / length : geometric;
}

static double stretchedArea(const Mesh& mesh, const glm::dmat3& m, std::size_t triangle) {
    const auto [a, b, c] = mesh.triangle(triangle);
    const glm::dvec3 o(mesh.positions[a]);
    return glm::length(glm::cross(m * (glm::dvec3(mesh.positions[b]) - o),
                                  m * (glm::dvec3(mesh.positions[c]) - o))) /
           2;
}

float triangleWorldArea(const Scene& scene, const Instance& instance, std::size_t triangle) {
    return float(
        stretchedArea(scene.meshOf(instance), glm::dmat3(glm::mat3(instance.toWorld)), triangle));
}

double worldArea(const Scene& scene, const Instance& instance) {
    const Mesh& mesh = scene.meshOf(instance);
    const glm::dmat3 m(glm::mat3(instance.toWorld));
    double area = 0;
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t)
        area += stretchedArea(mesh, m, t);
    return area;
}

Bounds worldBounds(const Scene& scene, const Instance& instance) {
    return boundsOf(scene.meshOf(instance).positions | std::views::transform([&](glm::vec3 p) {
                        return glm::vec3(instance.toWorld * glm::vec4(p, 1));
                    }));
}

} // namespace limn
