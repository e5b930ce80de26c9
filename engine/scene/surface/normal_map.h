// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// Unit normal of the front of a surface as its normal map bends it, in world space, at (u, v) of a
/// triangle. `front` is the unit normal there without it, interpolated from the vertices; it is
/// returned where the material has no normal map or the mesh no tangents. May lie below the
/// triangle's plane: light that comes from there is none, as for all shading normals.
glm::vec3 mappedNormal(const Scene& scene, const Instance& instance, std::uint32_t triangle,
                       glm::vec2 uv, glm::vec3 front);

} // namespace limn
