// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/senders/owner_tables.h"

#include "engine/scene/mesh/input_hash.h"
#include "engine/stages/stage_archive.h"
#include "engine/stages/stage_keys.h"
#include "engine/techniques/illuminance/bake/senders/owned_cells.h"

#include <algorithm>

#include <tbb/task_arena.h>

namespace limn {

const SurfelOwners& OwnerTables::tableOf(std::uint32_t mesh) const {
    Lazy& lazy = m_tables[mesh];
    std::call_once(lazy.once, [&] {
        // Isolated: a thread that waits for its helpers must not begin another cache and come back
        // here.
        tbb::this_task_arena::isolate([&] {
            const Mesh& m = m_scene.assets->meshes[mesh];
            const std::size_t cells = m.triangleCount() + 9 * m_set.meshes[mesh].size();
            constexpr std::size_t kWorthKeeping = 2048; // smaller ones are as fast to rebuild
            lazy.owners = keptOrMade<SurfelOwners>(
                cells < kWorthKeeping ? nullptr : m_store,
                stageKey(Stage::SurfelOwners, m_store ? m_keys[mesh] : 0), m_progress,
                [&](auto& a, auto& o) { SurfelOwners::fields(a, o, m, m_set.meshes[mesh]); },
                [&] { return SurfelOwners(m, m_set.meshes[mesh], m_progress); });
        });
    });
    return lazy.owners;
}

std::vector<float> ownedAreas(const Scene& scene, const SurfelSet& set, const OwnerTables& owners) {
    std::vector<float> result(set.surfels.size());
    forSenders(scene, set, [&](std::uint32_t instance) {
        const std::uint32_t first = set.instanceBegin[instance];
        std::vector<double> sum(set.instanceBegin[instance + 1] - first);
        forOwnedCells(scene, owners, instance,
                      [&](const OwnedCell& cell) { sum[cell.surfel - first] += cell.area; });
        for (std::size_t s = 0; s < sum.size(); ++s)
            result[first + s] = std::max(float(sum[s]), kLeastSurfelArea);
    });
    return result;
}

} // namespace limn
