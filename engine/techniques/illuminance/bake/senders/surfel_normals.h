// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"
#include "engine/techniques/illuminance/format/bake.h"

#include <cstdint>

namespace limn {

/// The unit normal of the triangle that a surfel lies on, on the surfel's side.
glm::vec3 geometricNormal(const Scene& scene, const Surfels& surfels, std::uint32_t surfel);

/// The interpolated vertex normal, unit, at a surfel whose own is the triangle's, on its side.
glm::vec3 vertexNormal(const Scene& scene, const Surfels& surfels, std::uint32_t surfel);

/// Sets each surfel's normal to its vertexNormal(), as the last step of a bake. The viewport and
/// the reference light surfaces by these normals. With the triangles' normals, a room of boxes
/// whose faces share vertices was a fourth too bright. Lessens cacheWeight by what the triangle's
/// plane hides of even light above the new normal, since the light of caches continues below it.
void shade(const Scene& scene, Surfels& surfels);

} // namespace limn
