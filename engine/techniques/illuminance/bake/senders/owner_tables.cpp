// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/senders/owner_tables.h"

#include "engine/core/parallel.h"
#include "engine/scene/mesh/triangle_geometry.h"
#include "engine/stages/stage_archive.h"
#include "engine/stages/stage_keys.h"

#include <algorithm>

#include <tbb/task_arena.h>

namespace limn {

const SurfelOwners& OwnerTables::of(std::uint32_t mesh) const {
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
    const auto areasOf = [&](std::uint32_t instance) {
        const Instance& placed = scene.instances[instance];
        const std::uint32_t first = set.instanceBegin[instance];
        const std::uint32_t sides = isTwoSided(scene.materialOf(placed)) ? 2 : 1;
        std::vector<double> sum(set.instanceBegin[instance + 1] - first);
        for (std::uint32_t t = 0; t < scene.meshOf(placed).triangleCount(); ++t) {
            const auto area = double(triangleWorldArea(scene, placed, t));
            owners.of(placed.mesh).forCellsOf(t, [&](std::uint32_t cell, glm::vec2, double share) {
                for (std::uint32_t back = 0; back < sides; ++back)
                    sum[owners.ofCell(instance, cell, back != 0) - first] += share * area;
            });
        }
        for (std::size_t s = 0; s < sum.size(); ++s)
            result[first + s] = std::max(float(sum[s]), 1e-30f);
    };
    parallelRanges(scene.instances.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (auto i = std::uint32_t(begin); i < end; ++i)
            if (set.instanceBegin[i] < set.instanceBegin[i + 1])
                areasOf(i);
    });
    return result;
}

} // namespace limn
