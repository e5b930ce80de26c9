// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/field_rule.h"
#include "engine/lightmap/layout/lightmap_layout.h"
#include "engine/scene/mesh/triangle_geometry.h"
#include "engine/scene/reach.h"
#include "engine/scene/scene.h"

#include <cstdint>
#include <vector>

// Conditions that charts, texels and their lookups must satisfy to be used safely, as rules for
// field lists. They apply both to bake files and to cached stages.

namespace limn {

/// Whether the mesh has the point's triangle and the barycentrics lie on it.
bool isPointOf(const Mesh& mesh, const MeshPoint& point);

/// Whether all points of an AtlasTexel or an SurfelCache are valid on the mesh.
template <class Texel>
bool arePointsOf(const Mesh& mesh, const Texel& texel) {
    if (texel.count == 0 || texel.count > texel.points.size())
        return false;
    for (std::uint32_t k = 0; k < texel.count; ++k)
        if (!isPointOf(mesh, texel.points[k]))
            return false;
    return true;
}

/// Whether an atlas of `width` x `height` texels is plausible if `used` texels are occupied: about
/// one in 4096 must be.
bool isAtlasSize(std::uint64_t width, std::uint64_t height, std::uint64_t used);

/// Checks LightmapLayout::snaps of an atlas of that size: every element must refer to an existing
/// row of snaps or to a block of finer texels inside the atlas. Returns a description of the error,
/// or nullptr.
const char* snapDefect(const std::vector<std::uint32_t>& snaps, std::uint32_t width,
                       std::uint32_t height);

/// Whether every vertex of a chart lies within the chart's extent.
bool chartsHoldVertices(const MeshCharts& charts);

namespace rule {

/// Every coordinate is at most kMaxCoordinate in magnitude.
inline auto inReach() {
    return within(-double(kMaxCoordinate), double(kMaxCoordinate));
}

/// Every vector has unit length up to rounding.
inline auto unit() {
    return each("not of unit length", [](std::size_t, glm::vec3 v) {
        return std::abs(double(v.x) * v.x + double(v.y) * v.y + double(v.z) * v.z - 1) < 1e-3;
    });
}

} // namespace rule

/// Lists the fields of charts. `mesh` is the mesh they were made from, or null if it is unknown.
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

/// Lists the fields of a LightmapLayout of which `used` texels are read. `scene` is the one it was
/// made for, or null if it is unknown.
template <class A, class L>
void layoutFields(A& a, L& l, std::uint64_t used, const Scene* scene) {
    a("width", l.width, rule::any);
    a("height", l.height, rule::holds("too large for its texels", [&](std::uint32_t height) {
          return isAtlasSize(l.width, height, used);
      }));
    const auto perMesh = [scene](const auto& all) {
        return !scene || all.size() == scene->assets->meshes.size();
    };
    a.each("meshes", l.meshes, rule::holds("not those of the scene", perMesh), [&](auto& m) {
        const auto mesh = std::size_t(&m - l.meshes.data());
        chartFields(a, m, scene ? &scene->assets->meshes[mesh] : nullptr);
    });
    const auto perInstance = [scene](const auto& all) {
        return !scene || all.size() == scene->instances.size();
    };
    const auto perVertex = [&l, scene](std::size_t i) {
        return scene ? l.meshes[scene->instances[i].mesh].sourceVertex.size() : 0;
    };
    a.each(
        "instances", l.instances, rule::holds("not those of the scene", perInstance), [&](auto& i) {
            const std::uint64_t vertices = perVertex(std::size_t(&i - l.instances.data()));
            a("uv", i.uv, rule::within(0, 1), rule::holds("of another length", [&](const auto& uv) {
                  return !scene || uv.empty() || uv.size() == vertices;
              }));
            a("backRows", i.backRows, rule::below(l.height));
        });
    a("snaps", l.snaps, [&l](const auto& snaps) { return snapDefect(snaps, l.width, l.height); });
}

/// Hash of everything in a layout.
std::uint64_t hashLayout(const LightmapLayout& layout, std::uint64_t seed);

} // namespace limn
