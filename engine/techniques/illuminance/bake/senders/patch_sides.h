// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"

#include <cstdint>
#include <vector>

namespace limn {

class OwnerTables;
class TraceScene;
struct SurfelSet;

/// Assignment of points to surfels where walls cut surfels' patches.
struct PatchSides {
    /// Per instance, empty where no wall cuts a patch: for each cell of its mesh's SurfelOwners,
    /// the index into MeshSurfels of the surfel on the front; on two-sided instances then, for each
    /// cell, of that on the back.
    /// For a cell that a wall crosses, kSplit + n instead: its owners are the n-th in `parts`.
    std::vector<std::vector<std::uint32_t>> owner;
    static constexpr std::uint32_t kSplit = 1U << 31;
    /// Per instance, the owners of the SurfelOwners::kParts parts of each split cell.
    std::vector<std::vector<std::uint32_t>> parts;
    /// Per surfel of the scene, 0 or a hash of the cells that it lost or gained; empty: all 0.
    std::vector<std::uint64_t> changed;
    std::uint64_t rays = 0; ///< rays traced for this result
};

/// Assigns each cell of a patch to the nearest surfel of like normal on the same side of all walls:
/// a segment between the two meets only surfaces of the same instance that face alike. It runs a
/// quarter of the surfels' spacing above the surface, or half way to the next surface above where
/// that is closer, so the gap above a lamp that hangs closely below a ceiling lies on another side
/// than the ceiling beside it. A cell that is partly covered in that way belongs to the open side,
/// which is seen from more places. A cell that a wall crosses is split into parts. A cell for which
/// none of the nearest few surfels qualifies keeps the nearest. Without this, the floor on both
/// sides of a wall would be as bright as one surfel on one side of it. The result is meaningless
/// when cancelled.
PatchSides findPatchSides(const TraceScene& trace, const SurfelSet& set, const OwnerTables& owners,
                          const Progress& progress);

} // namespace limn
