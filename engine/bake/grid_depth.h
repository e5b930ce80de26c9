// SPDX-License-Identifier: MIT
#pragma once

#include "engine/bake/gather.h"

#include <cstdint>
#include <vector>

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

/// |w|_1 from one cell's centre to the farthest one it shares points with [m].
float gridReach(const Bounds& bounds, glm::uvec3 size);

/// What the rays of the grid's caches tell, as they were traced and before anything is made of
/// them: no ray is traced. A wall is the plane of the surfel that the hit is credited to. Cells
/// follow one another as caches do.
std::vector<std::uint16_t> gridDepths(const Surfels& surfels, const Caches& caches,
                                      const CachePoints& points, const std::vector<RawHit>& hits,
                                      std::uint32_t rays, float reach);

/// How much a cell of the map `texels` sees of a point that lies `way` from its centre, in [0, 1]:
/// 1 up to 1.05 of the depth there, 0 from 1.15 of it. Where faces of the octahedron meet depths
/// come out up to 1 / 16 too large, in corners between walls too small.
float seenFromCell(const std::uint16_t* texels, glm::vec3 way, float reach);

} // namespace limn
