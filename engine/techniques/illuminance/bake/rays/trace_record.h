// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/bake/receivers/cache_points.h"
#include "engine/techniques/illuminance/bake/senders/owner_tables.h"
#include "engine/techniques/illuminance/bake/senders/surfels.h"

#include <cstdint>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

namespace limn {

/// The properties of one static instance that rays depend on.
struct TracedInstance {
    std::uint64_t shape;   ///< hash of triangles, sides and holes
    std::uint64_t surfels; ///< hash of the mesh's surfels
    glm::mat4 toWorld;
    std::uint32_t surfelCount;
    std::uint32_t instance; ///< index into Scene::instances

    bool inPlace(const TracedInstance& o) const { return shape == o.shape && toWorld == o.toWorld; }
};

/// Everything that determines the raw hits of a bake, so that a later bake can find the hits that
/// are still valid.
struct TraceRecord {
    std::uint32_t rays = 0;           ///< per cache
    std::uint32_t cachesPerBlock = 1; ///< hits are stored in blocks of that many caches
    float clearance = 0;              ///< TraceScene::epsilonAt(0) [m]
    std::vector<TracedInstance> instances;
    std::vector<std::uint64_t> parted; ///< PatchSides::changed of the surfels
    std::vector<std::uint64_t> caches; ///< hash of each cache's points and seed
    std::vector<std::uint64_t> blocks; ///< key in the store of each block's hits; filled last

    std::uint32_t surfels() const;
    std::uint32_t blockCount() const {
        return (std::uint32_t(caches.size()) + cachesPerBlock - 1) / cachesPerBlock;
    }
};

/// Describes a trace, without `blocks`. `meshes`: hashMeshes of the scene.
TraceRecord describeTrace(const TraceScene& trace, const SurfelSet& set, const OwnerTables& owners,
                          const Caches& caches, const CachePoints& points, std::uint32_t rays,
                          const std::vector<std::uint64_t>& meshes);

/// Hash, per mesh, of everything that determines its SurfelOwners.
std::vector<std::uint64_t> ownerKeys(const SurfelSet& set,
                                     const std::vector<std::uint64_t>& meshes);

/// Hash of which instances emit. How much they emit changes no ray.
std::uint64_t hashLamps(const Scene& scene, std::uint64_t seed);

/// Hash of everything but `blocks`.
std::uint64_t hashRecord(const TraceRecord& record);

std::string recordBytes(const TraceRecord& record);
/// Returns false where `bytes` are not those of a record.
bool readRecord(const std::string& bytes, TraceRecord& record);

/// How the instances of two records correspond.
struct InstanceMatch {
    static constexpr std::uint32_t kGone = ~0U;
    /// Per surfel of the older record: its index now; kGone where its place has changed. Sky cells
    /// follow the surfels in both.
    std::vector<std::uint32_t> surfelNow;
    std::vector<std::uint32_t> appeared; ///< Scene::instances that are new at their place
    std::uint32_t moved = 0, added = 0, removed = 0, resampled = 0; ///< for people
    /// Instances that are no longer at their place.
    struct Departed {
        glm::mat4 toWorld;
        std::uint32_t
            sameShape; ///< index now into Scene::instances of one of the same shape; ~0: none
    };
    std::vector<Departed> departed;
    bool identity = true; ///< no surfel's index has changed; some may have moved
};
InstanceMatch matchInstances(const TraceRecord& before, const TraceRecord& now);

/// Describes a match in words, "2 instances moved, 1 removed"; empty where nothing changed.
std::string matchWords(const InstanceMatch& match);

} // namespace limn
