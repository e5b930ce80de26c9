// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/techniques/radiance_volumes/area_lights.h"
#include "engine/techniques/radiance_volumes/cache_place.h"
#include "engine/techniques/radiance_volumes/glossy_map.h"
#include "engine/techniques/radiance_volumes/shadow_cone.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// A light's area lights with its colour.
struct LitAreaLights {
    const AreaLights* lights;
    glm::vec3 colour; ///< times strength
};

/// Everything that the light of caches depends on besides their places.
struct CacheLightInput {
    std::span<const LitAreaLights> lights;
    const VoxelVolume* voxels = nullptr; ///< null: nothing casts a shadow
    ConeShadows shadows = ConeShadows::None;
    std::uint32_t bands = 2; ///< 2 or 3
    /// Shape of the maps for reflections, and the eye that they are for; none: no maps.
    std::optional<GlossyMapShape> glossy;
    glm::vec3 eye{0};
};

/// The light of caches.
struct CacheLight {
    /// Harmonics (sh.h) of incident radiance: coefficient i of cache c is at c bands^2 + i.
    std::vector<glm::vec3> harmonics;
    std::vector<glm::vec3> glossy; ///< maps one after the other; empty: none
    std::uint64_t cones = 0;       ///< followed
};

/// Gathers the perpendicular irradiance of each area light, E = (flux / pi) cos v / (r^2 + A / pi)
/// with the cosine at the sender, the visibility v of its block and its area A, into the harmonics
/// of its direction. The form factor is that of a disk: Wallace, Elmquist, Haines. A Ray Tracing
/// Algorithm for Progressive Radiosity. 1989. Incomplete when cancelled.
CacheLight lightCaches(std::span<const CachePlace> caches, const CacheLightInput& input,
                       const Progress& progress = {});

/// Distance by which both ends of cones are raised above the surfaces there. `voxel`: side of a
/// voxel.
float coneRaise(ConeShadows shadows, float voxel);
/// Where the cones of a cache start.
glm::vec3 coneStart(const CachePlace& cache, ConeShadows shadows, float voxel);

/// A cone from a cache to a block, in the world.
struct BlockCone {
    glm::vec3 from{0}, to{0};
    float sine = 0; ///< of half its angle
};
/// Both ends are raised above the surfaces there, which would hide light that runs along them.
BlockCone coneOf(const CacheLightInput& input, const AreaLightBlock& block,
                 const CachePlace& cache);

/// Share of the light of a block that reaches a cache.
float blockVisibility(const CacheLightInput& input, const AreaLightBlock& block,
                      const CachePlace& cache);

/// What arrives at a cache from one area light.
struct Arrival {
    std::uint32_t source; ///< index into CacheLightInput::lights
    std::uint32_t light;  ///< of that
    glm::vec3 direction;  ///< unit, towards the area light
    float factor;         ///< of its flux: perpendicular irradiance [m^-2]
};
/// Calls `visit` for each area light from which anything arrives. The sums of lightCaches() are
/// those over these arrivals.
void visitArrivals(const CacheLightInput& input, const CachePlace& cache,
                   const std::function<void(const Arrival&)>& visit);

} // namespace limn
