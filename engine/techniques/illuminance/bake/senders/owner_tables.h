// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/stages/stage_store.h"
#include "engine/techniques/illuminance/bake/senders/patch_sides.h"
#include "engine/techniques/illuminance/bake/senders/surfel_owners.h"

#include <cstdint>
#include <mutex>
#include <utility>
#include <vector>

namespace limn {

/// The SurfelOwners of a scene's meshes, each built on first use.
class OwnerTables {
public:
    /// Keeps references.
    OwnerTables(const Scene& scene, const SurfelSet& set)
        : m_scene(scene), m_set(set), m_tables(set.meshes.size()) {}

    /// Loads tables from `store`, or keeps them there, under `keys`, one per mesh.
    void keep(StageStore& store, std::vector<std::uint64_t> keys) {
        m_store = &store;
        m_keys = std::move(keys);
    }

    /// Stops building tables when `progress` is cancelled. Tables built after that are meaningless.
    void stopWith(const Progress& progress) {
        m_progress = {.report = {}, .cancel = progress.cancel};
    }

    /// Uses `sides` from now on for instances whose patches are split by walls. Must not be called
    /// while other threads read the tables.
    void part(PatchSides sides) { m_sides = std::move(sides); }
    const PatchSides& sides() const { return m_sides; }

    /// Table of a mesh. Thread-safe. Precondition: the mesh has surfels.
    const SurfelOwners& tableOf(std::uint32_t mesh) const;

    /// Length of PatchSides::owner for an instance with surfels.
    std::uint64_t cellsOf(std::uint32_t instance) const {
        const Instance& i = m_scene.instances[instance];
        return std::uint64_t(tableOf(i.mesh).cells()) * (isTwoSided(m_scene, i) ? 2 : 1);
    }

    /// The surfel of the scene that stands for a place in the table of an instance's mesh.
    std::uint32_t ofCell(std::uint32_t instance, SurfelOwners::Place place, bool back) const {
        const std::uint32_t first = m_set.instanceBegin[instance],
                            owned = entry(instance, place.cell, back);
        if (!(owned & PatchSides::kSplit))
            return first + owned;
        const std::size_t cell = owned & ~PatchSides::kSplit;
        return first + m_sides.parts[instance][cell * SurfelOwners::kParts + place.part];
    }

    /// Whether a wall crosses a cell, so that its parts may have different owners.
    bool isSplit(std::uint32_t instance, std::uint32_t cell, bool back) const {
        return (entry(instance, cell, back) & PatchSides::kSplit) != 0;
    }

    /// The surfel of the scene that stands for a point; `back` only on two-sided instances.
    std::uint32_t surfelAt(std::uint32_t instance, std::uint32_t triangle, float u, float v,
                           bool back) const {
        const SurfelOwners& owners = tableOf(m_scene.instances[instance].mesh);
        return ofCell(instance, owners.cellAt(triangle, u, v), back);
    }

private:
    /// As PatchSides::owner.
    std::uint32_t entry(std::uint32_t instance, std::uint32_t cell, bool back) const {
        const SurfelOwners& owners = tableOf(m_scene.instances[instance].mesh);
        if (m_sides.owner.empty() || m_sides.owner[instance].empty())
            return owners.front(cell) + (back ? owners.frontCount() : 0);
        return m_sides.owner[instance][cell + (back ? owners.cells() : 0)];
    }

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
    PatchSides m_sides;
};

/// World-space area that each surfel stands for [m^2], from the cells that it owns; > 0 even for
/// surfels that own none. Surfels pushed over an edge, onto the rim of a thin lamp or the other
/// way, stand for other areas than they were placed for; a rim of 6 mm had five times its own.
std::vector<float> ownedAreas(const Scene& scene, const SurfelSet& set, const OwnerTables& owners);

} // namespace limn
