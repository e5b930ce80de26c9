// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/field_rule.h"
#include "engine/lightmap/lightmap_layout.h"
#include "engine/scene/mesh/triangle_geometry.h"
#include "engine/scene/reach.h"

#include <cstdint>
#include <vector>

// What charts, texels and their lookups must hold to be followed safely, for lists of fields: in
// bake files and in kept stages alike.

namespace limn {

/// A triangle that the mesh has, and a place on it.
bool isPointOf(const Mesh& mesh, const MeshPoint& point);

/// The points of an AtlasTexel or an OwnCache.
template <class Texel>
bool arePointsOf(const Mesh& mesh, const Texel& texel) {
    if (texel.count == 0 || texel.count > texel.points.size())
        return false;
    for (std::uint32_t k = 0; k < texel.count; ++k)
        if (!isPointOf(mesh, texel.points[k]))
            return false;
    return true;
}

/// Texels along the sides of an atlas that `used` of them fill, hardly less than one in thousands.
bool isAtlasSize(std::uint64_t width, std::uint64_t height, std::uint64_t used);

/// LightmapLayout::snaps of an atlas of that size: places lead to rows of snaps that there are, or
/// to blocks of finer texels within the atlas. nullptr, or what is wrong.
const char* snapDefect(const std::vector<std::uint32_t>& snaps, std::uint32_t width,
                       std::uint32_t height);

/// Every vertex of a chart lies within its extent.
bool chartsHoldVertices(const MeshCharts& charts);

namespace rule {

/// Every coordinate lies within the reach of scenes.
inline auto inReach() {
    return within(-double(kMaxCoordinate), double(kMaxCoordinate));
}

/// Unit vectors, as rounding leaves them.
inline auto unit() {
    return each("not of unit length", [](std::size_t, glm::vec3 v) {
        return std::abs(double(v.x) * v.x + double(v.y) * v.y + double(v.z) * v.z - 1) < 1e-3;
    });
}

} // namespace rule

/// `mesh`: what the charts are of; null where that is not known.
template <class A, class C>
void chartFields(A& a, C& c, const Mesh* mesh) {
    const std::uint64_t vertices = mesh ? mesh->positions.size() : ~std::uint64_t(0);
    a("sourceVertex", c.sourceVertex, rule::below(vertices));
    a("indices", c.indices, rule::below(c.sourceVertex.size()),
      rule::holds("not in threes", [](const auto& all) { return all.size() % 3 == 0; }),
      mesh ? rule::noneOr(mesh->indices.size()) : rule::noneOr(c.indices.size()));
    a("chartOfTriangle", c.chartOfTriangle, rule::count(c.indices.size() / 3),
      rule::below(c.chartSize.size()));
    a("chartUv", c.chartUv, rule::count(c.sourceVertex.size()),
      rule::within(0, 2 * double(kMaxCoordinate)));
    a("chartSize", c.chartSize, rule::within(0, 2 * double(kMaxCoordinate)),
      rule::holds("smaller than its vertices' extent",
                  [&c](const auto&) { return chartsHoldVertices(c); }));
}

} // namespace limn
