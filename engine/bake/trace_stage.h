// SPDX-License-Identifier: MIT
#pragma once

#include "engine/bake/gather.h"
#include "engine/bake/stage_store.h"
#include "engine/core/result.h"

#include <cstdint>
#include <string>
#include <vector>

namespace limn {

struct TraceInput {
    const TraceScene& trace;
    const SurfelSet& set;
    const Caches& caches;
    const CachePoints& points;
    Linker linker;
    std::uint32_t rays;                       ///< per cache
    const std::vector<std::uint64_t>& meshes; ///< hashMeshes of the scene
};

struct TraceReport {
    std::uint64_t key = 0;          ///< hash of all that the hits depend on
    std::uint64_t rays = 0;         ///< traced now, whatever for
    std::vector<std::string> notes; ///< what was traced again and why
};

/// The trace stage: fills `hits` from what the store knows and traces the rest. Hits are stored in
/// blocks as they come, so a trace that was stopped goes on where it was. Where objects moved since
/// the latest trace of the same meshes and rays, only the rays that met one of them before, or meet
/// it now, are traced again. The hits are those of tracing everything. `store` may be null.
/// Fails when cancelled ("cancelled") and where the hits would take more than half the machine's
/// memory.
Result<TraceReport> traceHits(const TraceInput& input, const Progress& progress, StageStore* store,
                              GatherHits& hits);

} // namespace limn
