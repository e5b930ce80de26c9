// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lightmap/layout/layout_rules.h"
#include "engine/lightmap/mesh_density.h"

namespace limn {

/// Lists the fields that divide a mesh's triangles into `cells` cells in total.
template <class A, class D>
void partFields(A& a, D& d, const Mesh& mesh, std::uint64_t cells) {
    a("level", d.level, rule::noneOr(mesh.triangleCount()),
      rule::below(MeshDensity::kMaxLevel + 1));
    a("begin", d.begin, rule::count(d.level.size()),
      rule::each("out of range", [&d, cells](std::size_t t, std::uint32_t begin) {
          return begin + (std::uint64_t(1) << 2 * d.level[t]) <= cells;
      }));
}

/// Lists the fields of a MeshDensity of the mesh.
template <class A, class D>
void densityFields(A& a, D& d, const Mesh& mesh) {
    partFields(a, d, mesh, d.density.size());
    a("density", d.density, rule::within(1e-9, 1e9),
      rule::holds("of another length",
                  [&d](const auto& cells) { return d.uniform() ? cells.size() == 1 : true; }));
}

} // namespace limn
