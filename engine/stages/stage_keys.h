// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/hash.h"

#include <cstdint>

namespace limn {

/// Every kind of content in a StageStore. Each kind has its own keys, whatever its inputs.
enum class Stage : std::uint32_t {
    Charts,
    Density,
    Atlas,
    FineTexels,
    TexelSides,
    MeshSurfels,
    SurfelOwners,
    MeshTree,
    PatchSides,
    SeenPatches,
    TraceRecord,
    TraceBlock,
    TraceOfDocument,
    AimedHits,
    Training,
    SparseProbes,
    RelightRays,
    SparseTransport,
    SparseCompression,
    LampTexels,
    LightPoints,
    SkyHits
};

/// Key of a content; `inputs` is the hash of everything that it is computed from.
inline std::uint64_t stageKey(Stage stage, std::uint64_t inputs) {
    return hashValue(inputs, hashValue(stage, 0));
}

} // namespace limn
