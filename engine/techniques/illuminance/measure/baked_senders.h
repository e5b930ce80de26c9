// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lightmap/atlas_stage.h"
#include "engine/techniques/illuminance/bake/receivers/cache_points.h"
#include "engine/techniques/illuminance/bake/senders/owner_tables.h"

namespace limn {

class StageStore;

/// Data that a bake was traced with but does not store: its surfels as they were placed, the tables
/// that assign points to surfels, and the start points of its caches' rays.
struct BakedSenders {
    PlacedAtlas placed;
    SurfelSet set;
    OwnerTables owners;
    CachePoints lightmap, grid;

    /// Reads what the bake of `scene` kept in `store` and recomputes the rest. Keeps references to
    /// `scene`. Precondition: scene.bake places surfels and texels as the settings of
    /// `baked` do.
    BakedSenders(const TraceScene& trace, const Scene& scene, const Bake& baked, StageStore& store);
};

} // namespace limn
