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

/// For each texel, where its surface is open and on which side of walls it lies.
struct TexelSides {
    /// Texels of the atlas. A texel of several points keeps those on one side of all walls, in
    /// proportion to how open each of them is.
    std::vector<AtlasTexel> texels;
    std::vector<std::uint8_t> open;   ///< Atlas::open
    std::vector<std::uint32_t> snaps; ///< LightmapLayout::snaps
    std::uint64_t rays = 0;           ///< number of rays traced
};

/// Position of a triangle in an atlas. A lookup is identified by its upper left texel.
struct PlacedTriangle {
    std::uint32_t instance, back; ///< as AtlasTexel
    std::uint32_t triangle;
    std::array<glm::vec2, 3> corner; ///< in texels from the centre of the atlas' first texel
    glm::ivec2 lower, upper;         ///< it applies to the lookups in [lower, upper) only
};

/// Position of a triangle in the layout, valid for all of its lookups.
PlacedTriangle placeTriangle(const LightmapLayout& layout, std::uint32_t mesh,
                             std::uint32_t instance, std::uint32_t back, std::uint32_t triangle);

/// Computes which points of texels are open and which texels a lookup may use.
///
/// The openness of a point is the share of a few directions in which there is no surface within a
/// texel's width and no back of a one-sided surface at any distance. It measures how much of the
/// point can be seen from further away than the texel's width: folds and corners get little weight,
/// as they do in a picture, and points inside a solid get none.
///
/// A wall that stands on a surface separates the points of texels below it. Two points are on the
/// same side if a segment between them, raised by a quarter of a texel or half way to the next
/// surface above, hits nothing but their own chart. Of the sides that have open points a texel
/// keeps the most open one, and a bilinear lookup snaps to the texels whose points are on the same
/// side as the lookup itself, because interpolation across the wall would light each room by the
/// other. Where the lookup lies in a pocket narrower than half a texel, beside a place in the open,
/// it snaps to the texels of that place. Texels of several charts keep all their open points. A
/// texel without any open point keeps all its points; lookups avoid it where possible.
///
/// `placed` states how triangles lie in the lookups of addFineTexels(). The result must not be used
/// when cancelled.
TexelSides findTexelSides(const TraceScene& trace, const Atlas& atlas,
                          const std::vector<PlacedTriangle>& placed, const Progress& progress);

/// Snapped lookups of single points. Each traces rays of its own instead of using those of its
/// cell: for surfels, which represent more than a pixel.
class SideLookup {
public:
    /// `atlas` must have sides. Keeps references to both arguments.
    SideLookup(const TraceScene& trace, const Atlas& atlas);
    ~SideLookup();

    /// Same as lightmapUv(), with a snap of its own. Thread-safe.
    glm::vec2 uvOf(std::uint32_t instance, const MeshPoint& point, bool back) const;

    std::uint64_t rays() const; ///< number of rays traced so far

private:
    struct State;
    std::unique_ptr<State> m_state;
};

} // namespace limn
