// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

namespace limn {

/// A mesh's vertices after cutting it along chart borders: vertex k copies sourceVertex[k] of the
/// mesh. Triangle t of the mesh is still triangle t here.
struct MeshCharts {
    std::vector<std::uint32_t> sourceVertex;
    std::vector<std::uint32_t> indices; ///< into sourceVertex; as long as Mesh::indices
    std::vector<std::uint32_t> chartOfTriangle;
    std::vector<glm::vec2>
        chartUv; ///< per vertex: position in its chart's plane, object units; lower corner 0
    std::vector<glm::vec2> chartSize; ///< per chart: extent in the same units

    bool operator==(const MeshCharts&) const = default;
};

/// Where an instance's vertices lie in the atlas.
struct InstanceLightmap {
    /// Per vertex of MeshCharts, normalised atlas coordinates [0, 1], v down; a bilinear lookup
    /// anywhere inside a triangle reads only texels of its own chart. Empty: the instance is lit
    /// from the grid.
    std::vector<glm::vec2> uv;
    /// Of a surface that shows both sides: rows of texels from a point's place for its front down
    /// to that for its back. 0: one-sided.
    std::uint32_t backRows = 0;

    bool operator==(const InstanceLightmap&) const = default;
};

inline constexpr std::uint32_t kSnapCells =
    8; ///< along each side of a place of LightmapLayout::snaps
inline constexpr std::uint32_t kSnaps = 9;
/// Along each side of a place of LightmapLayout::snaps that finer texels stand for.
inline constexpr std::uint32_t kFineCells = 4;
inline constexpr std::uint32_t kFineLookup = 1U << 31; ///< marks such a place
inline constexpr int kFineLevels = 5;                  ///< of finer and finer texels, at most

/// The lightmap's geometry: charts per mesh, places per instance.
struct LightmapLayout {
    std::uint32_t width = 0, height = 0; ///< atlas texels
    std::vector<MeshCharts>
        meshes; ///< as Assets::meshes; empty entries for meshes without lightmap
    std::vector<InstanceLightmap> instances; ///< as Scene::instances
    /// How bilinear lookups keep to one side of walls, and where they find finer texels; empty:
    /// they need neither. Element y * width + x belongs to lookups between the centres of the
    /// texels (x, y) and (x+1, y+1). kFineLookup + i: a block of finer texels, kFineCells a side,
    /// whose first one is texel i, stands for these four, and its lookups have elements of their
    /// own. Else 0, or the index in this very vector of kSnapCells elements, one for each row of
    /// cells there, 4 bits a cell: 0 interpolates between all four texels; 1, 2 read the left or
    /// right two, 3, 4 the upper or lower two; 5 to 8 read one: upper left, upper right, lower
    /// left, lower right.
    std::vector<std::uint32_t> snaps;

    bool operator==(const LightmapLayout&) const = default;
};

} // namespace limn
