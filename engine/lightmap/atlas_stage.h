// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lightmap/atlas.h"
#include "engine/lightmap/mesh_density.h"
#include "engine/stages/stage_store.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace limn {

struct PlacedAtlas {
    Atlas atlas;                      ///< each texel's points are the open ones
    std::vector<MeshDensity> surfels; ///< per mesh
};

/// The stages charts, density and atlas, by the scene's bake settings: what `store` (may be null)
/// knows of them, else made anew. Texels are equally dense all over where the settings say how
/// dense. `meshes`: hashMeshes(scene). `rays` grows by the rays traced. Nothing when cancelled.
std::optional<PlacedAtlas> atlasStage(const TraceScene& trace, const Scene& scene,
                                      const std::vector<std::uint64_t>& meshes,
                                      const Progress& progress, StageStore* store,
                                      std::uint64_t& rays);

} // namespace limn
