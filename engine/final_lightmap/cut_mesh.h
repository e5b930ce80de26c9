// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lightmap/layout/lightmap_layout.h"
#include "engine/scene/mesh/mesh.h"
#include "engine/scene/mesh/triangle_geometry.h"

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

namespace limn {

/// How a chart is cut into pieces: a tree of straight cuts in the plane of MeshCharts::chartUv.
struct ChartCuts {
    struct Node {
        glm::vec2 across{0};     ///< unit, across the cut; 0: a piece
        float position = 0;      ///< of the cut in that direction [object units]
        std::uint32_t child = 0; ///< node below the cut, which that above follows; a piece's number

        bool isPiece() const { return across == glm::vec2(0); }
        /// Whether a point lies beyond the cut.
        bool isAbove(glm::vec2 uv) const { return across.x * uv.x + across.y * uv.y > position; }
    };
    std::vector<Node> nodes; ///< the root first; empty: the chart stays whole

    std::uint32_t pieceAt(glm::vec2 uv) const;
};

/// Where the triangles and charts of a cut mesh come from.
struct CutSource {
    struct Chart {
        std::uint32_t chart, piece; ///< of the charts before
    };
    std::vector<Chart> charts;                     ///< per chart
    std::vector<std::uint32_t> firstTriangle;      ///< per triangle before, and one more
    std::vector<std::uint32_t> triangle;           ///< per triangle: that before
    std::vector<std::array<glm::vec2, 3>> corners; ///< their barycentrics in it

    MeshPoint toSource(const MeshPoint& point) const;
    /// The inverse of toSource().
    MeshPoint fromSource(const MeshPoint& point) const;
};

/// A mesh whose triangles end where its charts are cut.
struct CutMesh {
    /// Has the vertices of the mesh before, then those on cuts, whose attributes are interpolated.
    Mesh mesh;
    MeshCharts charts; ///< one for each piece that has surface
    CutSource source;
};

/// Cuts the triangles of a mesh along the cuts of its charts, of which there is one entry each.
/// Where a cut meets an edge, all triangles at that edge get the same vertex, so closed meshes stay
/// closed. Vertices on an edge that lie within a ten-thousandth of its length are one.
CutMesh cutMesh(const Mesh& mesh, const MeshCharts& charts, const std::vector<ChartCuts>& cuts);

} // namespace limn
