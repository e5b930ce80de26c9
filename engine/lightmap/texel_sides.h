// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/lightmap/atlas.h"
#include "engine/trace/trace_scene.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace limn {

/// Where the surface of each texel lies open, and on which side of walls.
struct TexelSides {
    /// The atlas' texels; a texel of several points keeps those on one side of all walls, in
    /// proportion to how open each lies.
    std::vector<AtlasTexel> texels;
    std::vector<std::uint8_t> open;   ///< Atlas::open
    std::vector<std::uint32_t> snaps; ///< LightmapLayout::snaps
    std::uint64_t rays = 0;           ///< traced for it
};

/// Where a triangle lies in an atlas. A lookup is named by the texel at its upper left.
struct PlacedTriangle {
    std::uint32_t instance, back; ///< as AtlasTexel
    std::uint32_t triangle;
    std::array<glm::vec2, 3> corner; ///< in texels from the middle of the atlas' first texel
    glm::ivec2 lower, upper;         ///< it counts only for the lookups in [lower, upper)
};

/// Where the layout draws a triangle, for all of its lookups.
PlacedTriangle placeTriangle(const LightmapLayout& layout, std::uint32_t mesh,
                             std::uint32_t instance, std::uint32_t back, std::uint32_t triangle);

/// A point is open in the share of a few directions in which nothing lies within a texel's width,
/// nor the back of a one-sided surface anywhere. So much of a point is seen from further off than
/// the texel is wide: folds and corners count for little in it, as they do in a picture, and what
/// lies in a solid for nothing.
///
/// A wall that stands on a surface parts the points of texels below it. Two points are on one side
/// if a segment between them, a quarter of a texel above the surface or half way to what lies above
/// it, meets nothing but their own chart. Of the sides with open points a texel keeps the most open
/// one, and bilinear lookups snap to the texels whose points the place of the lookup is on one side
/// with: interpolation across the wall would light each room by the other. Texels of several charts
/// keep all their open points. A texel without any open point keeps all; lookups avoid it where
/// they can.
///
/// `placed`: how triangles lie in the lookups of addFineTexels(). Of no use when cancelled.
TexelSides findTexelSides(const TraceScene& trace, const Atlas& atlas,
                          const std::vector<PlacedTriangle>& placed, const Progress& progress);

/// Snapped lookups of single points, by rays of their own instead of those of the cell that they
/// lie in: for surfels, which stand for more than a pixel.
class SideLookup {
public:
    /// `atlas` has sides. Keeps references.
    SideLookup(const TraceScene& trace, const Atlas& atlas);
    ~SideLookup();

    /// As lightmapUv(). Thread-safe.
    glm::vec2 uvOf(std::uint32_t instance, const MeshPoint& point, bool back) const;

    std::uint64_t rays() const; ///< traced so far

private:
    struct State;
    std::unique_ptr<State> m_state;
};

} // namespace limn
