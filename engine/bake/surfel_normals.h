// SPDX-License-Identifier: MIT
#pragma once

#include "engine/bake/bake.h"
#include "engine/scene/scene.h"

#include <cstdint>

namespace limn {

/// The unit normal of the triangle that a surfel lies on, on the surfel's side.
glm::vec3 geometricNormal(const Scene& scene, const Surfels& surfels, std::uint32_t surfel);

/// Gives surfels the normals of the vertices, on their sides: the last step of a bake. Surfaces are
/// shaded by those; a box whose vertices are shared by its sides would send a fourth too much light
/// by the normals of its triangles.
void shade(const Scene& scene, Surfels& surfels);

} // namespace limn
