// SPDX-License-Identifier: MIT
#pragma once

#include "engine/bake/atlas.h"
#include "engine/bake/stage_store.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace limn {

/// The stages charts and atlas, by the scene's bake settings, each texel's points the open ones:
/// what `store` (may be null) knows of them, else made anew. `meshes`: hashMeshes(scene). `rays`
/// grows by the rays traced. Nothing when cancelled.
std::optional<Atlas> atlasStage(const TraceScene& trace, const Scene& scene,
                                const std::vector<std::uint64_t>& meshes, const Progress& progress,
                                StageStore* store, std::uint64_t& rays);

} // namespace limn
