// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lightmap/atlas_stage.h"
#include "engine/techniques/illuminance/bake/receivers/cache_points.h"
#include "engine/techniques/illuminance/bake/senders/owner_tables.h"

namespace limn {

class StageStore;

/// What a bake was traced with and does not keep: its surfels as they were placed, the tables of
/// which surfel stands for a point, and where the rays of its caches start.
struct BakedSenders {
    PlacedAtlas placed;
    SurfelSet set;
    OwnerTables owners;
    CachePoints lightmap, grid;

    /// Reads from `store` what the bake of `scene` kept there, and makes the rest again. Keeps
    /// references to `scene`.
    BakedSenders(const TraceScene& trace, const Scene& scene, const Bake& baked, StageStore& store);
};

} // namespace limn
