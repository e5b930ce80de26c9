// SPDX-License-Identifier: MIT
#include "engine/bake/owner_tables.h"

#include "engine/bake/stage_archive.h"

#include <tbb/task_arena.h>

namespace limn {

const SurfelOwners& OwnerTables::of(std::uint32_t mesh) const {
    Lazy& lazy = m_tables[mesh];
    std::call_once(lazy.once, [&] {
        // Alone: a thread waiting for its helpers must not begin another cache and come back here.
        tbb::this_task_arena::isolate([&] {
            const Mesh& m = m_scene.assets->meshes[mesh];
            const std::size_t cells = m.triangleCount() + 9 * m_set.meshes[mesh].size();
            constexpr std::size_t kWorthKeeping = 2048; // fewer are as fast to make
            lazy.owners = keptOrMade<SurfelOwners>(
                cells < kWorthKeeping ? nullptr : m_store, m_store ? m_keys[mesh] : 0, m_progress,
                [](auto& a, auto& o) { SurfelOwners::fields(a, o); },
                [&] { return SurfelOwners(m, m_set.meshes[mesh], m_progress); });
        });
    });
    return lazy.owners;
}

} // namespace limn
