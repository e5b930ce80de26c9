// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/mesh/bounds.h"
#include "shaders/shared/grid_lookup.h"

#include <array>
#include <cstdint>

#include <glm/vec3.hpp>

namespace limn {

// Distances from a grid cell to the surfaces around it, as an octahedral map of kGridDepthSide^2
// texels per cell. The vector w from the cell's centre maps to w / |w|_1 on the octahedron, and a
// wall hit at w has depth |w|_1. For a plane, 1 / depth is linear on each face of the octahedron,
// so the map stores the inverse and bilinear lookups reproduce flat walls exactly; moments of the
// depth, as in Majercik et al. Dynamic Diffuse Global Illumination with Ray-Traced Irradiance
// Fields, 2019, would spread over the width of a texel. Texels are 16-bit unorms of reach / (64
// depth). 0 means the sky; all ones mean that the cell lies in a solid. A cell takes 512 bytes.

inline constexpr std::uint32_t kGridDepthSide = GRID_DEPTH_SIDE;
inline constexpr std::uint32_t kGridDepthTexels = kGridDepthSide * kGridDepthSide;
inline constexpr float kGridDepthScale =
    float(GRID_DEPTH_SCALE); ///< the smallest representable depth is reach / this

/// The four texels around a direction, with bilinear weights.
struct GridDepthLookup {
    std::array<std::uint32_t, 4> texel;
    std::array<float, 4> weight;
};

/// Lookup in direction `d`, which must not be 0 but need not be of unit length.
GridDepthLookup gridDepthLookup(glm::vec3 d);

/// Centre of a texel on the octahedron, |p|_1 = 1.
glm::vec3 gridDepthPoint(std::uint32_t texel);

/// |w|_1 from a cell's centre to the farthest centre of a cell that shares points with it [m].
float gridReach(const Bounds& bounds, glm::uvec3 size);

/// Visibility in [0, 1] of the point at offset `way` from a cell's centre, by the cell's map
/// `texels`: 1 up to 1.05 times the depth in that direction, falling to 0 at 1.15 times. Depths
/// come out up to 1 / 16 too large where faces of the octahedron meet, and too small in corners
/// between walls.
float seenFromCell(const std::uint16_t* texels, glm::vec3 way, float reach);

} // namespace limn
