// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/mesh/closed_surfaces.h"
#include "engine/scene/scene.h"

#include <cstdint>
#include <vector>

#include <glm/mat4x4.hpp>

namespace limn {

/// A closed surface of static, opaque instances that have one transform.
struct PlacedSurface {
    std::vector<std::uint32_t> instances; ///< that the shell's triangles name by their `mesh`
    std::vector<const Mesh*> meshes;      ///< theirs
    ClosedSurface surface;                ///< in their object space
    glm::dmat4 toObject{1};

    bool isBehind(glm::dvec3 world) const;
};

/// Finds the closed surfaces of a scene. Instances that move, have holes or let light through
/// belong to none.
std::vector<PlacedSurface> findClosedSurfaces(const Scene& scene);

/// Whether anything behind a surface may light its back, or shows light there: a light, emissive
/// triangles, the back itself where it is emissive, the middle of a dynamic object; behind a room
/// also the sky and the sun. Lights count even where they are off, but a black sky does not.
bool isLitBehind(const Scene& scene, const PlacedSurface& placed);

/// Sets Instance::darkBacks of those two-sided static instances all of whose triangles belong to
/// closed surfaces that are neither lit nor seen behind, and clears that of all others. They are
/// seen by the scene's cameras, or by that of chooseCamera() where it has none.
void leaveOutDarkBacks(Scene& scene);

} // namespace limn
