// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/measure/baked_senders.h"

#include "engine/scene/mesh/input_hash.h"
#include "engine/stages/stage_store.h"
#include "engine/techniques/illuminance/bake/rays/trace_record.h"
#include "engine/techniques/illuminance/bake/senders/patch_sides.h"

#include <cassert>

namespace limn {

static PlacedAtlas placedAtlas(const TraceScene& trace, const Scene& scene, StageStore& store) {
    std::uint64_t rays = 0;
    return *atlasStage(trace, scene, hashMeshes(scene), {}, &store, rays);
}

BakedSenders::BakedSenders(const TraceScene& trace, const Scene& scene, const Bake& baked,
                           StageStore& store)
    : placed(placedAtlas(trace, scene, store)),
      set(placeSurfels(scene, scene.bake.surfels, placed.surfels, {}, &store)), owners(scene, set) {
    assert(set.surfels.size() == baked.surfels.size());
    owners.keep(store, ownerKeys(set, hashMeshes(scene)));
    owners.part(findPatchSides(trace, set, owners, {}));
    placeCaches(scene, placed.atlas, lightmap);
    Caches cells;
    grid.begin = {0};
    addGridCaches(baked.gridSize, baked.gridBounds, cells, grid);
}

} // namespace limn
