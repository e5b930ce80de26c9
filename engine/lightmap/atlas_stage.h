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
    Atlas atlas;                      ///< each texel keeps its open points only
    std::vector<MeshDensity> surfels; ///< per mesh
};

/// Whether lookups get finer texels where light from emissive surfaces varies (findLampLookups()):
/// where a static surface emits, but not in quick bakes of few rays, nor where the density is
/// given.
bool refinesNearLamps(const Scene& scene);

/// Runs the stages charts, density and atlas with the scene's bake settings, reusing results in
/// `store` (may be null). The texel density follows Instance::texelDensity alone if the settings
/// prescribe it. `meshes` is hashMeshes(scene). Adds the rays traced to `rays`. Returns
/// std::nullopt when cancelled.
std::optional<PlacedAtlas> atlasStage(const TraceScene& trace, const Scene& scene,
                                      const std::vector<std::uint64_t>& meshes,
                                      const Progress& progress, StageStore* store,
                                      std::uint64_t& rays);

} // namespace limn
