// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lattice/lattice.h"
#include "engine/scene/scene.h"
#include "engine/techniques/lpv/propagation.h"

#include <span>
#include <vector>

namespace limn {

/// A piece of a surface.
struct SurfacePiece {
    glm::vec3 position; ///< middle
    glm::vec3 normal;   ///< unit, geometric, of the front
    float area;         ///< of one side [m^2]
    bool twoSided;
};

/// Pieces of all surfaces, none longer than `longest` [m] unless the surface has more than a few
/// million. Pieces whose middle lies in a hole of a cutout are left out.
std::vector<SurfacePiece> surfacePieces(const Scene& scene, float longest);

/// The geometry volume of `lattice`: each side that reflects light blocks what falls on it, by a
/// clamped cosine of its area over that of a cell's face. The lobes are summed at the cells'
/// corners and averaged over the four corners of each face. Kaplanyan and Dachsbacher take the
/// pieces from shadow maps and from the camera's depths; here they are those of the whole scene, so
/// that light depends neither on the camera nor on which other lights are on.
FaceBlockers blockersOf(std::span<const SurfacePiece> pieces, const Lattice& lattice);

} // namespace limn
