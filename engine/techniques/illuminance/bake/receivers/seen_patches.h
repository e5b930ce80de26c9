// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/techniques/illuminance/bake/receivers/cache_points.h"
#include "engine/techniques/illuminance/bake/senders/owner_tables.h"
#include "engine/trace/trace_scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace limn {

/// Number of lightmap caches for each surfel cache: there is at most one surfel cache per this
/// many.
inline constexpr std::uint32_t kCachesPerSurfelCache = 20;

/// A cache that only a few surfels read. It gathers over the part of their patches that
/// caches see.
struct SurfelCache {
    std::uint32_t instance = 0, back = 0; ///< as AtlasTexel
    std::uint32_t count = 0;              ///< number of points, [1, AtlasTexel::kMaxPoints]
    std::array<MeshPoint, AtlasTexel::kMaxPoints> points{};
};

/// New places and caches for surfels whose patches lie partly where they are not seen: behind a
/// wall, on other sides of a bar, out of doors.
struct SeenPatches {
    std::vector<MeshPoint> place; ///< per surfel: its place on its patch
    /// Per surfel, Surfels::cache and cacheWeight before surfel caches are added.
    std::vector<glm::uvec4> cache;
    std::vector<glm::vec4> cacheWeight;
    std::vector<SurfelCache> surfelCaches;
    std::vector<std::uint32_t> surfelCache; ///< per surfel: index into `surfelCaches`; ~0: none
    std::uint64_t rays = 0;                 ///< rays traced for this result
};

/// Finds where surfels are seen by shooting `rays` rays from every lightmap cache; with 0 rays
/// nothing changes. Rays from closer than a patch is wide count only where no others meet the
/// patch, because caches in a gap between surfaces see only a piece of it. Rays of texels that were
/// added near lamps do not count: many of them see the same side of a lamp, and would move all of
/// its surfels to that side.
///
/// A surfel stays where it is unless most of these caches do not see that place, or one of the
/// points where their rays meet its patch lies closer to the others in distance and orientation. It
/// then moves to such a point, so that the light it receives, and sends from its whole patch, is
/// that of the seen part.
///
/// A surfel whose lightmap caches see a share of the sky, or of emissive surfaces, that differs
/// from its own by a tenth or more reads a surfel cache, which it shares with such surfels beside
/// it: within a niche, a texel may lie half behind a bar. Surfel caches go where the difference
/// times the number of rays is largest: at most one per kCachesPerSurfelCache lightmap caches, and
/// no more than the atlas has texels that no lookup needs. `caches`: the lightmap's. The result is
/// meaningless when cancelled.
SeenPatches findSeenPatches(const TraceScene& trace, const SurfelSet& set,
                            const OwnerTables& owners, const Atlas& atlas, const Caches& caches,
                            const CachePoints& points, std::uint32_t rays,
                            const Progress& progress);

/// Moves surfels to their places and sets the lightmap caches that they read there. Surfels that
/// stay keep every bit.
void placeSeen(const Scene& scene, const SeenPatches& seen, SurfelSet& set);

/// Moves surfels to `place`. Surfels that stay keep every bit.
void moveSurfels(const Scene& scene, const std::vector<MeshPoint>& place, SurfelSet& set);

/// Appends the surfel caches, in texels that no lookup needs, and makes their surfels read them.
void addSurfelCaches(const Scene& scene, const LightmapLayout& layout, const SeenPatches& seen,
                     Surfels& surfels, Caches& caches, CachePoints& points);

} // namespace limn
