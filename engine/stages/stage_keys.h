// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/hash.h"

#include <cstdint>

namespace limn {

/// Every kind of content that a StageStore keeps. Each has keys of its own, whatever it is made
/// from.
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
    Training
};

/// `inputs`: hash of all that the content is made from.
inline std::uint64_t stageKey(Stage stage, std::uint64_t inputs) {
    return hashValue(inputs, hashValue(stage, 0));
}

} // namespace limn
