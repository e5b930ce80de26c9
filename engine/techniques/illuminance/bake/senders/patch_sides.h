// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"

#include <cstdint>
#include <vector>

namespace limn {

class OwnerTables;
class TraceScene;
struct SurfelSet;

/// Which surfel stands for each point where walls cut surfels' patches.
struct PatchSides {
    /// Per instance, empty where no wall does: per cell of its mesh's SurfelOwners the surfel of
    /// the MeshSurfels on the front; on two-sided ones then per cell that on the back.
    std::vector<std::vector<std::uint32_t>> owner;
    /// Per surfel of the scene, 0 or a hash of the cells that it lost or gained; empty: all 0.
    std::vector<std::uint64_t> changed;
    std::uint64_t rays = 0; ///< traced for it
};

/// A cell of a patch belongs to the nearest surfel of like normal that it is on one side of all
/// walls with: a segment between the two, a quarter of the surfels' spacing above the surface,
/// meets nothing but surfaces of the same instance that face alike. A cell that is with none of the
/// nearest few keeps the nearest. Without this, the floor on either side of a wall would be as
/// bright as one surfel on one side of it. Of no use when cancelled.
PatchSides findPatchSides(const TraceScene& trace, const SurfelSet& set, const OwnerTables& owners,
                          const Progress& progress);

} // namespace limn
