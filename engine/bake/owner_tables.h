// SPDX-License-Identifier: MIT
#pragma once

#include "engine/bake/stage_store.h"
#include "engine/bake/surfels.h"
#include "engine/core/progress.h"

#include <cstdint>
#include <mutex>
#include <utility>
#include <vector>

namespace limn {

/// The SurfelOwners of a scene's meshes, each made when it is first asked for.
class OwnerTables {
public:
    /// Keeps references.
    OwnerTables(const Scene& scene, const SurfelSet& set)
        : m_scene(scene), m_set(set), m_tables(set.meshes.size()) {}

    /// Tables are taken from `store`, or kept there, under these keys per mesh.
    void keep(StageStore& store, std::vector<std::uint64_t> keys) {
        m_store = &store;
        m_keys = std::move(keys);
    }

    /// Tables made after `progress` was cancelled are of no use.
    void stopWith(const Progress& progress) {
        m_progress = {.report = {}, .cancel = progress.cancel};
    }

    /// Any thread may ask. Precondition: the mesh has surfels.
    const SurfelOwners& of(std::uint32_t mesh) const;

private:
    struct Lazy {
        std::once_flag once;
        SurfelOwners owners;
    };

    const Scene& m_scene;
    const SurfelSet& m_set;
    Progress m_progress;
    StageStore* m_store = nullptr;
    std::vector<std::uint64_t> m_keys;
    mutable std::vector<Lazy> m_tables; ///< per mesh
};

} // namespace limn
