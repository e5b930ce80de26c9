// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

namespace limn {

/// Vertices of a mesh after cutting it along chart borders: vertex k is a copy of the mesh's vertex
/// sourceVertex[k]. Triangles keep their indices.
struct MeshCharts {
    std::vector<std::uint32_t> sourceVertex;
    std::vector<std::uint32_t> indices; ///< into sourceVertex; as long as Mesh::indices
    std::vector<std::uint32_t> chartOfTriangle;
    std::vector<glm::vec2>
        chartUv; ///< per vertex: position in its chart's plane, object units; lower corner 0
    std::vector<glm::vec2> chartSize; ///< per chart: extent in the same units

    bool operator==(const MeshCharts&) const = default;
};

/// Positions of an instance's vertices in the atlas.
struct InstanceLightmap {
    /// Normalised atlas coordinates in [0, 1], v down, per vertex of MeshCharts. A bilinear lookup
    /// anywhere inside a triangle reads texels of its own chart only. Empty: the instance is lit
    /// from the grid.
    std::vector<glm::vec2> uv;
    /// For a two-sided surface, rows of texels from a point's position on the front down to its
    /// position on the back. 0: one-sided, or the back has no light (Instance::darkBacks).
    std::uint32_t backRows = 0;

    bool operator==(const InstanceLightmap&) const = default;
};

inline constexpr std::uint32_t kSnapCells =
    8; ///< along each side of a place of LightmapLayout::snaps
inline constexpr std::uint32_t kSnaps = 9;
/// Cells along each side of an element of LightmapLayout::snaps that is replaced by finer texels.
inline constexpr std::uint32_t kFineCells = 4;
inline constexpr std::uint32_t kFineLookup = 1U << 31; ///< marks such an element
inline constexpr int kFineLevels = 5; ///< maximum number of successively finer levels

/// The lightmap's geometry: charts per mesh, places per instance.
struct LightmapLayout {
    std::uint32_t width = 0, height = 0; ///< atlas texels
    std::vector<MeshCharts>
        meshes; ///< as Assets::meshes; empty entries for meshes without lightmap
    std::vector<InstanceLightmap> instances; ///< as Scene::instances
    /// How bilinear lookups stay on one side of walls and where they find finer texels; empty if no
    /// lookup needs either. Element y * width + x belongs to lookups between the centres of the
    /// texels (x, y) and (x+1, y+1). kFineLookup + i means that a block of finer texels, with
    /// kFineCells cells per side and first texel i, replaces these four texels; its lookups have
    /// elements of their own. Any other value is 0 or the index in this same vector of kSnapCells
    /// elements, one for each row of cells, 4 bits per cell: 0 interpolates between all four
    /// texels; 1, 2 read the left or right two, 3, 4 the upper or lower two; 5 to 8 read one: upper
    /// left, upper right, lower left, lower right.
    std::vector<std::uint32_t> snaps;

    bool operator==(const LightmapLayout&) const = default;
};

} // namespace limn
