// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/reach.h"
#include "engine/scene/scene.h"
#include "tests/fuzz/target.h"

#include <algorithm>
#include <cmath>

namespace limn {

struct Bake;

/// Bakes an accepted scene and lights it with two bounces; the light must be finite. Replays of the
/// corpus do this. Fuzzers link readers alone, and this does nothing in them: clang takes minutes
/// for the baker, and baking each input would leave readers few of them.
void bakeAndLight(const Scene& scene);

/// The same for an accepted bake of the scene.
void light(const Scene& scene, const Bake& bake);

template <int N>
bool isFinite(const glm::vec<N, float>& v) {
    return std::isfinite(glm::dot(v, glm::vec<N, float>(0)));
}

/// Requires what mesh.h promises of imported meshes.
inline void checkMesh(const Mesh& mesh) {
    const std::size_t vertices = mesh.positions.size();
    require(mesh.indices.size() % 3 == 0, "indices come in threes");
    require(std::ranges::all_of(mesh.indices, [=](std::uint32_t i) { return i < vertices; }),
            "indices are in range");
    const auto perVertex = [&](const auto& values, const char* promise) {
        require(values.empty() || values.size() == vertices, promise);
        for (const auto& value : values)
            require(isFinite(value), "a mesh's numbers are finite");
    };
    perVertex(mesh.positions, "positions are as many as vertices");
    perVertex(mesh.normals, "normals are as many as positions");
    perVertex(mesh.tangents, "tangents are as many as positions");
    perVertex(mesh.uv0, "texture coordinates are as many as positions");
    perVertex(mesh.uv1, "lightmap coordinates are as many as positions");
    perVertex(mesh.colors, "colours are as many as positions");
    for (const glm::vec3& n : mesh.normals)
        require(std::abs(glm::dot(n, n) - 1) < 1e-3f, "normals have unit length");
}

/// Requires of an accepted scene that its parts refer to parts that exist, and that its numbers are
/// numbers.
inline void checkScene(const Scene& scene) {
    for (const Mesh& mesh : scene.assets->meshes)
        checkMesh(mesh);
    for (const Image& image : scene.assets->images)
        require(image.rgba.size() == std::size_t(4) * image.width * image.height,
                "an image has all its texels");
    for (const Instance& instance : scene.instances) {
        require(instance.mesh < scene.assets->meshes.size(), "an instance's mesh exists");
        require(instance.material < scene.materials.size(), "an instance's material exists");
        const auto count = std::uint32_t(scene.meshOf(instance).triangleCount());
        for (std::uint32_t t = 0; t < std::min(count, 8U); ++t) {
            const SurfaceMaterial m = surfaceMaterial(scene, instance, t, 0.3f, 0.3f);
            require(m.albedo.x >= 0 && m.albedo.x <= 0.99f, "an albedo is in [0, 0.99]");
            require(std::isfinite(m.emission.x), "emission is finite");
        }
    }
    for (const Light& l : scene.lights)
        require(isFinite(l.color) && std::isfinite(l.strength), "a light's strength is a number");
    require(isFinite(chooseCamera(scene, std::optional<std::string>()).eye),
            "a camera's position is a number");
    reachDefect(scene);
}

/// Uses an accepted scene as the program would: its materials, its camera, a bake and its light.
inline void exercise(const Scene& scene) {
    checkScene(scene);
    bakeAndLight(scene);
}

} // namespace limn
