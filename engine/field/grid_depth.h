// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/mesh/bounds.h"

#include <array>
#include <cstdint>

#include <glm/vec3.hpp>

namespace limn {

// How far a cell of the grid sees, in every direction: an octahedral map of kGridDepthSide^2 texels
// per cell. A way of w from the cell's centre lies at w / |w|_1 on the octahedron, and a wall that
// it meets at w has depth |w|_1. Of a plane 1 / depth is linear on each face of the octahedron, so
// the inverse is kept, and bilinear lookups find flat walls where they are; moments of the depth,
// as in Majercik et al. Dynamic Diffuse Global Illumination with Ray-Traced Irradiance Fields,
// 2019, would spread over the width of a texel. 16-bit unorms of reach / (64 depth); 0: the sky,
// all ones: the cell lies in a solid. 512 bytes a cell.

inline constexpr std::uint32_t kGridDepthSide = 16;
inline constexpr std::uint32_t kGridDepthTexels = kGridDepthSide * kGridDepthSide;
inline constexpr float kGridDepthScale = 64; ///< the nearest depth told apart is reach / this

/// The four texels about a direction, with bilinear weights.
struct GridDepthLookup {
    std::array<std::uint32_t, 4> texel;
    std::array<float, 4> weight;
};

/// `d` need not be unit, but not 0.
GridDepthLookup gridDepthLookup(glm::vec3 d);

/// Where a texel's middle lies on the octahedron, |p|_1 = 1.
glm::vec3 gridDepthPoint(std::uint32_t texel);

/// |v|_1
float norm1(glm::vec3 v);

/// |w|_1 from one cell's centre to the farthest one it shares points with [m].
float gridReach(const Bounds& bounds, glm::uvec3 size);

/// How much a cell of the map `texels` sees of a point that lies `way` from its centre, in [0, 1]:
/// 1 up to 1.05 of the depth there, 0 from 1.15 of it. Where faces of the octahedron meet depths
/// come out up to 1 / 16 too large, in corners between walls too small.
float seenFromCell(const std::uint16_t* texels, glm::vec3 way, float reach);

} // namespace limn
