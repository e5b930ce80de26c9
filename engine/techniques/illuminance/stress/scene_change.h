// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

#include <cstdint>
#include <span>

#include <glm/mat3x3.hpp>

namespace limn {

/// The same scene `s` times as large and equally bright: the power of lamps grows with s^2.
Scene scaledScene(Scene scene, float s);

Scene movedScene(Scene scene, glm::vec3 offset);

/// The document with its roots and lights moved in the file's coordinates [m], and the origin that
/// an import would give it. `meshes` are those of its Assets.
Document movedDocument(Document document, std::span<const Mesh> meshes, const glm::dvec3& offset);

/// The scene rotated about the origin. The sky is not rotated.
Scene turnedScene(Scene scene, const glm::mat3& rotation);

/// The scene with the triangles of each mesh in another order.
Scene withTrianglesShuffled(Scene scene, std::uint64_t seed);

/// The scene with its instances in another order.
Scene withObjectsShuffled(Scene scene, std::uint64_t seed);

/// Whether the sky is the same in every direction.
bool isEven(const Sky& sky);

} // namespace limn
