// SPDX-License-Identifier: MIT
#include "engine/lightmap/fine_blocks.h"

#include <utility>

#include <glm/common.hpp>

namespace limn {

namespace {

constexpr std::uint32_t kNone = ~0U;

/// Adds rows of texels; coordinates are relative to the atlas' height.
void grow(LightmapLayout& layout, std::uint32_t rows) {
    const float shrink = float(double(layout.height) / double(layout.height + rows));
    layout.height += rows;
    for (InstanceLightmap& i : layout.instances)
        for (glm::vec2& uv : i.uv)
            uv.y *= shrink;
    layout.snaps.resize(std::size_t(layout.width) * layout.height, 0);
}

} // namespace

std::uint64_t FineLookups::texels() const {
    std::uint64_t count = 0;
    for (const std::vector<std::uint32_t>& level : places)
        count += level.size() * kBlockTexels;
    return count;
}

TexelGrid::TexelGrid(const Scene& scene, const Atlas& atlas)
    : m_scene(scene), m_atlas(atlas),
      m_texelAt(std::size_t(atlas.layout.width) * atlas.layout.height, kNone) {
    for (std::uint32_t i = 0; i < atlas.texels.size(); ++i)
        m_texelAt[atlas.texels[i].texel] = i;
}

bool TexelGrid::holds(std::uint32_t place, const PlacedTriangle& t) const {
    if (place >= m_texelAt.size() || m_texelAt[place] == kNone)
        return false;
    const AtlasTexel& texel = (*this)[place];
    const std::vector<std::uint32_t>& chartOf =
        m_atlas.layout.meshes[m_scene.instances[t.instance].mesh].chartOfTriangle;
    return texel.instance == t.instance && texel.back == t.back &&
           chartOf[texel.points[0].triangle] == chartOf[t.triangle];
}

bool TexelGrid::holdsAll(std::uint32_t place, const PlacedTriangle& t) const {
    const std::uint32_t width = m_atlas.layout.width;
    return holds(place, t) && holds(place + 1, t) && holds(place + width, t) &&
           holds(place + width + 1, t);
}

std::vector<LocalTexel> coverBlock(std::span<const BlockTriangle> parts) {
    std::vector<FlatTriangle> flat;
    for (const BlockTriangle& p : parts)
        flat.push_back(p.flat);
    return coverTriangles(flat, glm::uvec2(kBlockSide));
}

std::uint64_t fineRows(const LightmapLayout& layout, std::uint64_t blocks) {
    const std::uint64_t perRow = layout.width / kBlockSide;
    return perRow > 0 ? (blocks + perRow - 1) / perRow * kBlockSide : 0;
}

std::vector<PlacedTriangle> addFineLevel(const Scene& scene,
                                         const std::vector<PlacedTriangle>& triangles,
                                         const std::vector<std::uint32_t>& places, Atlas& atlas) {
    LightmapLayout& layout = atlas.layout;
    const std::uint32_t perRow = layout.width / kBlockSide, top = layout.height;
    std::vector<PlacedTriangle> result;
    if (places.empty() || perRow == 0)
        return result;
    const TexelGrid grid(scene, atlas);
    const std::vector<BlockTriangle> parts =
        partTriangles(triangles, layout.width, [&](std::uint32_t place, const PlacedTriangle& t) {
            return grid.holds(place, t) && std::ranges::binary_search(places, place);
        });
    std::vector<AtlasTexel> more;
    grow(layout, std::uint32_t(fineRows(layout, places.size())));
    forPlaces(parts, [&](std::uint32_t place, std::span<const BlockTriangle> placeParts) {
        const auto block = std::uint32_t(std::ranges::lower_bound(places, place) - places.begin());
        const glm::uvec2 first(block % perRow * kBlockSide, top + block / perRow * kBlockSide);
        layout.snaps[place] = kFineLookup | (first.y * layout.width + first.x);
        const AtlasTexel& owner = grid[place];
        for (const LocalTexel& t : coverBlock(placeParts)) {
            const glm::uvec2 position = first + t.position;
            more.push_back({position.y * layout.width + position.x, owner.instance, owner.back,
                            owner.width / float(kFineCells), t.count, t.points});
        }
        for (const BlockTriangle& part : placeParts) {
            const glm::ivec2 lower(first);
            result.push_back({owner.instance, owner.back, part.flat.triangle, part.flat.corner,
                              lower, lower + int(kFineCells)});
            for (glm::vec2& c : result.back().corner)
                c += glm::vec2(first) - 0.5f;
        }
    });
    std::ranges::sort(more, {}, &AtlasTexel::texel);
    atlas.texels.insert(atlas.texels.end(), more.begin(), more.end());
    return result;
}

std::vector<PlacedTriangle> addChosenLevel(const Scene& scene,
                                           const std::vector<PlacedTriangle>& triangles,
                                           std::vector<std::uint32_t> places, Atlas& atlas,
                                           FineLookups& lookups) {
    std::ranges::sort(places);
    std::vector<PlacedTriangle> result = addFineLevel(scene, triangles, places, atlas);
    if (!places.empty())
        lookups.places.push_back(std::move(places));
    return result;
}

std::vector<PlacedTriangle> addFineTexels(const Scene& scene, std::vector<PlacedTriangle> triangles,
                                          const FineLookups& lookups, Atlas& atlas) {
    std::vector<PlacedTriangle> all;
    for (const std::vector<std::uint32_t>& places : lookups.places) {
        triangles = addFineLevel(scene, triangles, places, atlas);
        all.insert(all.end(), triangles.begin(), triangles.end());
    }
    return all;
}

std::vector<std::uint32_t> fineBlocks(const LightmapLayout& layout) {
    std::vector<std::uint32_t> finer;
    bool any = false;
    const std::size_t count = std::size_t(layout.width) * layout.height;
    for (std::size_t place = 0; place < count && place < layout.snaps.size(); ++place) {
        const bool fine = (layout.snaps[place] & kFineLookup) != 0;
        finer.push_back(fine ? layout.snaps[place] & ~kFineLookup : ~0U);
        any = any || fine;
    }
    return any ? finer : std::vector<std::uint32_t>();
}

} // namespace limn
