// SPDX-License-Identifier: MIT
#pragma once

#include "engine/bake/bake.h"

#include <cstdint>
#include <vector>

namespace limn {

class StageStore;

/// Sample points of one mesh in object space, front sides first; a two-sided mesh repeats them with
/// the normal turned.
struct MeshSurfels {
    std::vector<glm::vec3> position;
    std::vector<glm::vec3> normal; ///< unit, object space, of the side it stands for
    std::vector<std::uint32_t> triangle;
    std::vector<glm::vec2> barycentric;
    std::uint32_t frontCount = 0; ///< size() or, two-sided, half of it
    float area = 0; ///< of each surfel in object space; frontCount * area is the mesh's area

    std::size_t size() const { return position.size(); }
};

/// `count` >= 1 points, area-proportional: point i starts in the triangle at (i + 1/2)/count of the
/// mesh's summed area, so the areas of small triangles carry over to their neighbours, at a Halton
/// point (bases 2, 3) of that triangle, or a random one. Halton. On the Efficiency of Certain
/// Quasi-Random Sequences of Points in Evaluating Multi-Dimensional Integrals. 1960
MeshSurfels placeSurfels(const Mesh& mesh, std::uint32_t count, bool twoSided,
                         SurfelPlacement placement, const Progress& progress = {});

/// Surfels of every static instance of a scene.
struct SurfelSet {
    std::vector<MeshSurfels> meshes; ///< as Assets::meshes; empty where no static instance uses one
    std::vector<std::uint32_t>
        instanceBegin; ///< per instance (+1): first surfel; empty range for dynamic ones
    Surfels surfels;   ///< world space; cache links not filled yet
};

/// About `target` surfels spread over the static instances by world area, at least one per mesh
/// side. Instances of a mesh share its points. World areas include the local stretch of the
/// transform; those of an instance sum to the area of its lit sides.
/// When cancelled, of no use. Points of meshes that `store` knows are not placed again.
SurfelSet placeSurfels(const Scene& scene, std::uint32_t target, const Progress& progress = {},
                       StageStore* store = nullptr);

/// Light leaves both sides of such a surface.
bool isTwoSided(const Material& material);

/// Which surfel stands for a point of a mesh: tables of triangle cells, built with the nearest
/// surfel of like normal.
class SurfelOwners {
public:
    SurfelOwners() = default;
    /// When cancelled, of no use.
    SurfelOwners(const Mesh& mesh, const MeshSurfels& surfels, const Progress& progress = {});

    /// Index into the MeshSurfels. Precondition: the mesh has surfels; `back` only on two-sided
    /// ones.
    std::uint32_t at(std::uint32_t triangle, float u, float v, bool back) const {
        return m_owner[cellAt(triangle, u, v)] + (back ? m_frontCount : 0);
    }

    /// The table's cell at barycentrics (u, v) of a triangle, < cells().
    std::uint32_t cellAt(std::uint32_t triangle, float u, float v) const {
        const std::uint32_t n = m_resolution[triangle];
        const std::uint32_t i = std::min(std::uint32_t(u * float(n)), n - 1);
        const std::uint32_t j = std::min(std::uint32_t(v * float(n)), n - 1);
        return m_begin[triangle] + j * n + i;
    }
    std::uint32_t cells() const { return std::uint32_t(m_owner.size()); }
    /// Cells along u and v of a triangle.
    std::uint32_t resolution(std::uint32_t triangle) const { return m_resolution[triangle]; }
    /// The surfel on the front of a cell.
    std::uint32_t front(std::uint32_t cell) const { return m_owner[cell]; }

    /// Lists the tables for an archive.
    template <class A, class T>
    static void fields(A& a, T& o) {
        a(o.m_frontCount), a(o.m_resolution), a(o.m_begin), a(o.m_owner);
    }

private:
    std::uint32_t m_frontCount = 0;
    std::vector<std::uint16_t> m_resolution; ///< per triangle: cells along u and v
    std::vector<std::uint32_t> m_begin;
    std::vector<std::uint32_t> m_owner; ///< front surfel per cell
};

} // namespace limn
