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
    std::uint32_t instance = 0, triangle = 0;
    glm::vec2 barycentric{0}; ///< (u, v) of the middle
    glm::vec3 position{0};    ///< middle
    glm::vec3 normal{0};      ///< unit, geometric, of the front
    float area = 0;           ///< of one side [m^2]
    bool twoSided = false;
};

/// Pieces of an instance's surface, none longer than `longest` [m] unless a triangle would have
/// more than 2^18. Pieces whose middle lies in a hole of a cutout are left out.
void addPieces(const Scene& scene, std::uint32_t instance, float longest,
               std::vector<SurfacePiece>& pieces);

/// addPieces() of all instances.
std::vector<SurfacePiece> surfacePieces(const Scene& scene, float longest);

/// The geometry volume of `lattice`: each side that reflects light blocks what falls on it, by a
/// clamped cosine of its area over that of a cell's face. The lobes are summed at the cells'
/// corners and averaged over the four corners of each face. Kaplanyan and Dachsbacher take the
/// pieces from shadow maps and from the camera's depths; here they are those of the whole scene, so
/// that light depends neither on the camera nor on which other lights are on.
FaceBlockers blockersOf(std::span<const SurfacePiece> pieces, const Lattice& lattice);

} // namespace limn
