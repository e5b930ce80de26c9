// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/stages/stage_store.h"
#include "engine/techniques/illuminance/bake/rays/new_objects.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace limn {

struct TraceInput {
    const TraceScene& trace;
    const SurfelSet& set;
    const OwnerTables& owners; ///< of `set`
    const Caches& caches;
    const CachePoints& points;
    Linker linker;
    std::uint32_t rays;                       ///< per cache
    const std::vector<std::uint64_t>& meshes; ///< hashMeshes of the scene
    float gridReach = 0;                      ///< gridReach() of the grid [m]
};

/// What has moved since an earlier trace in which all surfels had the same indices.
struct MovedSince {
    std::uint64_t key = 0;               ///< of that trace
    std::vector<std::uint8_t> elsewhere; ///< per surfel: 1 where its place has changed
    std::vector<BoundingSphere> places;  ///< around all that moved, at old and new places
};

struct TraceReport {
    std::uint64_t key = 0;                ///< hash of all that the hits depend on
    std::uint64_t rays = 0;               ///< traced by this call, for any purpose
    std::vector<std::string> notes;       ///< what was traced again and why
    std::vector<std::uint16_t> gridDepth; ///< gridDepths() of the hits
    std::optional<MovedSince> moved;      ///< set where hits of such a trace were reused
};

/// Runs the trace stage: fills `hits` from the store and traces the rest. Hits are stored in blocks
/// as they are traced, so a trace that was stopped resumes where it ended. Where objects moved
/// since the latest trace of the same meshes and rays, only the rays that met one of them before,
/// or meet it now, are traced again. The hits equal those of tracing everything. `store` may be
/// null.
/// Fails when cancelled ("cancelled") and where the hits would take more than half the machine's
/// memory.
Result<TraceReport> traceHits(const TraceInput& input, const Progress& progress, StageStore* store,
                              GatherHits& hits);

} // namespace limn
