// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/lightmap/mesh_density.h"
#include "engine/techniques/illuminance/format/bake.h"

#include <cstdint>
#include <span>
#include <vector>

namespace limn {

class StageStore;
/// Sample points of one mesh in object space, front sides first; a two-sided mesh repeats them with
/// the normal reversed.
struct MeshSurfels {
    std::vector<glm::vec3> position;
    std::vector<glm::vec3> normal; ///< unit, object space, of the side it stands for
    std::vector<std::uint32_t> triangle;
    std::vector<glm::vec2> barycentric;
    std::uint32_t frontCount = 0; ///< size() or, two-sided, half of it
    float area = 0; ///< mean area of a surfel in object space; frontCount * area is the mesh's area
    std::vector<float> areas; ///< area of each surfel; empty: all equal
    MeshDensity density;

    std::size_t size() const { return position.size(); }
};

/// A mesh's area times its density, summed over the density's cells [object space].
double summedWeight(const Mesh& mesh, const MeshDensity& density);

/// Places `count` >= 1 points in proportion to area times density. Point i starts in the cell at (i
/// + 1/2)/count of the mesh's sum of those, so that the share of small triangles carries over to
/// their neighbours, at a Halton point (bases 2, 3) of that cell, or a random one. Halton. On the
/// Efficiency of Certain Quasi-Random Sequences of Points in Evaluating Multi-Dimensional
/// Integrals. 1960
MeshSurfels placeSurfels(const Mesh& mesh, std::uint32_t count, bool twoSided,
                         SurfelPlacement placement, MeshDensity density = {},
                         const Progress& progress = {});

/// Surfels of every static instance of a scene.
struct SurfelSet {
    std::vector<MeshSurfels> meshes; ///< as Assets::meshes; empty where no static instance uses one
    std::vector<std::uint32_t>
        instanceBegin; ///< per instance (+1): first surfel; empty range for dynamic ones
    Surfels surfels;   ///< world space; cache links not filled yet
};

/// Spreads about `target` surfels over the static instances by world area times `density` (per
/// mesh; empty: uniform), at least one per mesh side. Instances of a mesh share its points. World
/// areas include the local stretch of the transform; those of an instance sum to the area of its
/// lit sides.
/// Points of meshes found in `store` are reused. The result is meaningless when cancelled.
SurfelSet placeSurfels(const Scene& scene, std::uint32_t target,
                       std::span<const MeshDensity> density = {}, const Progress& progress = {},
                       StageStore* store = nullptr);

/// Approximate number of `target` surfels on emissive surfaces if all others were equally dense.
std::uint64_t expectedLampSurfels(const Scene& scene, std::uint32_t target);

} // namespace limn
