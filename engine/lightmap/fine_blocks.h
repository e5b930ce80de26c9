// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lightmap/atlas.h"
#include "engine/lightmap/texel_cover.h"
#include "engine/lightmap/texel_sides.h"
#include "engine/scene/scene.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace limn {

inline constexpr std::uint32_t kBlockSide = kFineCells + 1; ///< texels along a block's side
inline constexpr std::uint32_t kBlockTexels = kBlockSide * kBlockSide;

/// Lookups between four texels of an atlas that read a block of finer texels instead. A block has
/// kBlockSide^2 texels, stored below the atlas; its corners coincide with the four texels.
/// Lookups inside a block may in turn read even finer blocks.
struct FineLookups {
    std::vector<std::vector<std::uint32_t>> places; ///< per level, ascending; y * width + x
    std::uint64_t rays = 0;                         ///< number of rays traced to find them

    /// Maximum number of texels in their blocks.
    std::uint64_t texels() const;
};

/// A triangle in the lookups of one place, in texels of a block that may be added there.
struct BlockTriangle {
    std::uint32_t place;
    FlatTriangle flat;
};

/// Texels of an atlas, indexed by their position. Keeps references to both arguments.
class TexelGrid {
public:
    TexelGrid(const Scene& scene, const Atlas& atlas);

    /// Texel at a place. Precondition: there is one.
    const AtlasTexel& operator[](std::uint32_t place) const {
        return m_atlas.texels[m_texelAt[place]];
    }

    /// Whether the lookups at a place belong to the triangle's side and chart.
    bool holds(std::uint32_t place, const PlacedTriangle& t) const;

    /// Whether all four texels of the lookups at a place belong to the triangle's side and chart.
    bool holdsAll(std::uint32_t place, const PlacedTriangle& t) const;

private:
    const Scene& m_scene;
    const Atlas& m_atlas;
    std::vector<std::uint32_t> m_texelAt; ///< per place: into Atlas::texels; ~0: none
};

/// Computes how triangles lie in the places selected by wanted(place, triangle), sorted by place.
template <class Wanted>
std::vector<BlockTriangle> partTriangles(const std::vector<PlacedTriangle>& triangles,
                                         std::uint32_t width, const Wanted& wanted) {
    constexpr float kReach = 0.5f / float(kFineCells);
    std::vector<BlockTriangle> result;
    for (const PlacedTriangle& t : triangles) {
        const auto& p = t.corner;
        const glm::ivec2 lower = glm::max(
            glm::ivec2(glm::floor(glm::min(p[0], glm::min(p[1], p[2])) - kReach)), t.lower);
        const glm::ivec2 upper = glm::min(
            glm::ivec2(glm::floor(glm::max(p[0], glm::max(p[1], p[2])) + kReach)), t.upper - 1);
        for (int y = lower.y; y <= upper.y; ++y)
            for (int x = lower.x; x <= upper.x; ++x) {
                const std::uint32_t place = std::uint32_t(y) * width + std::uint32_t(x);
                if (!wanted(place, t))
                    continue;
                BlockTriangle part{place, {t.triangle, {}}};
                for (std::size_t k = 0; k < 3; ++k)
                    part.flat.corner[k] =
                        (p[k] - glm::vec2(float(x), float(y))) * float(kFineCells) + 0.5f;
                result.push_back(part);
            }
    }
    std::ranges::stable_sort(result, {}, &BlockTriangle::place);
    return result;
}

/// Calls visit(place, its triangles) for each place. `parts` must be sorted by place.
template <class Visit>
void forPlaces(const std::vector<BlockTriangle>& parts, const Visit& visit) {
    for (std::size_t begin = 0, end = 0; begin < parts.size(); begin = end) {
        while (end < parts.size() && parts[end].place == parts[begin].place)
            ++end;
        visit(parts[begin].place, std::span(parts).subspan(begin, end - begin));
    }
}

/// Texels of a block that lookups on these triangles can read.
std::vector<LocalTexel> coverBlock(std::span<const BlockTriangle> parts);

/// Number of rows by which `blocks` blocks make an atlas higher.
std::uint64_t fineRows(const LightmapLayout& layout, std::uint64_t blocks);

/// Adds the finer texels of one level: grows the atlas and redirects the lookups to their blocks
/// (LightmapLayout::snaps). `places` must be ascending, `triangles` those that lie there. Returns
/// how triangles lie in the blocks.
std::vector<PlacedTriangle> addFineLevel(const Scene& scene,
                                         const std::vector<PlacedTriangle>& triangles,
                                         const std::vector<std::uint32_t>& places, Atlas& atlas);

/// Adds a level to `lookups` and to the atlas. Returns how triangles lie in its blocks; nothing
/// where there are no places.
std::vector<PlacedTriangle> addChosenLevel(const Scene& scene,
                                           const std::vector<PlacedTriangle>& triangles,
                                           std::vector<std::uint32_t> places, Atlas& atlas,
                                           FineLookups& lookups);

/// Adds all levels, of which the first lies on `triangles`, and returns how triangles lie in the
/// blocks of all of them.
std::vector<PlacedTriangle> addFineTexels(const Scene& scene, std::vector<PlacedTriangle> triangles,
                                          const FineLookups& lookups, Atlas& atlas);

/// Per texel of a layout: the first texel of the block that its lookups read instead; ~0: none.
/// Empty: the layout has no finer texels.
std::vector<std::uint32_t> fineBlocks(const LightmapLayout& layout);

} // namespace limn
