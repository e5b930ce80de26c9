// SPDX-License-Identifier: MIT
#pragma once

#include "engine/bake/atlas.h"
#include "engine/bake/stage_store.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace limn {

/// The stages charts and atlas: what `store` (may be null) knows of them, else made anew. `meshes`:
/// hashMeshes(scene). Nothing when cancelled.
std::optional<Atlas> atlasStage(const Scene& scene, const std::vector<std::uint64_t>& meshes,
                                const Progress& progress, StageStore* store);

} // namespace limn
