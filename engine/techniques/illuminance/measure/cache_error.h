// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/techniques/illuminance/bake/receivers/cache_points.h"
#include "engine/techniques/illuminance/relight/relight.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <vector>

namespace limn {

/// Reference irradiance [W m^-2] of some of a bake's surface caches: light that was reflected once,
/// or comes from emissive surfaces and the sky, over the front of the surface that the cache stands
/// for. It is computed without surfels, clusters, links or SH.
struct CacheReference {
    std::vector<std::uint32_t> cache; ///< ascending
    std::vector<glm::vec3> irradiance;
    double noise = 0; ///< rms standard error / mean irradiance, due to the number of rays
};

/// Computes the reference of every k-th lightmap cache, at most `count`. Each shoots `rays` rays in
/// four independent sets and traces the direct light at every hit. Caches whose points all lie in
/// walls are skipped. Empty when cancelled.
CacheReference referenceIrradiance(const TraceScene& trace, const Caches& caches,
                                   const CachePoints& points, std::uint32_t count,
                                   std::uint32_t rays, const Progress& progress = {});

/// Irradiance [W m^-2] at a cache's own normal, never negative. `sh`: bands^2 coefficients per
/// cache.
glm::vec3 cacheIrradiance(const Caches& caches, int bands, const std::vector<glm::vec3>& sh,
                          std::uint32_t cache);

/// Error of the caches' irradiance at their own normals.
struct CacheError {
    double nrmse = 0;        ///< rms(E - E_ref) / mean(E_ref), all channels
    double nrmseTrimmed = 0; ///< the same without the worst 1 % of the caches
    double bias = 0;         ///< mean(E) / mean(E_ref) - 1
};

/// `sh`: bands^2 coefficients per cache, of light that was reflected once.
CacheError compareCaches(const CacheReference& reference, const Caches& caches, int bands,
                         const std::vector<glm::vec3>& sh);

} // namespace limn
