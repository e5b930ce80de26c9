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

/// One cache of surfels' own for so many of the lightmap, at most.
inline constexpr std::uint32_t kCachesPerOwn = 20;

/// A cache that a few surfels alone read, over the part of their patches that caches see.
struct OwnCache {
    std::uint32_t instance = 0, back = 0; ///< as AtlasTexel
    std::uint32_t count = 0;              ///< of points, [1, AtlasTexel::kMaxPoints]
    std::array<MeshPoint, AtlasTexel::kMaxPoints> points{};
};

/// What becomes of surfels whose patches lie partly elsewhere than where they are seen: behind a
/// wall, on other sides of a bar, out of doors.
struct SeenPatches {
    std::vector<MeshPoint> place; ///< per surfel: where on its patch it stands
    /// Per surfel, Surfels::cache and cacheWeight before it reads one of its own.
    std::vector<glm::uvec4> cache;
    std::vector<glm::vec4> cacheWeight;
    std::vector<OwnCache> own;
    std::vector<std::uint32_t> ownCache; ///< per surfel: which of `own` it reads; ~0: none
    std::uint64_t rays = 0;              ///< traced for it
};

/// Shoots `rays` rays from every lightmap cache, with 0 of them nothing changes. Those that come
/// from nearer than a patch is wide count only where no others meet it: such caches, in a gap
/// between surfaces, see a piece of it. A surfel stays where it is unless most of these caches do
/// not see that place, or one of the points where their rays meet its patch lies closer to the
/// others, in distance and in orientation: then it moves there, so that the light it gets, and
/// sends from its whole patch, is that of what is seen. Where its lightmap caches see another share
/// of the sky than its place does, by a tenth or more, their light is not that of its patch: it
/// reads a cache of its own, which it shares with such surfels beside it. Those go where difference
/// times rays is largest: one for every kCachesPerOwn at most, and no more than the atlas has
/// texels that no lookup needs. `caches`: the lightmap's. When cancelled, of no use.
SeenPatches findSeenPatches(const TraceScene& trace, const SurfelSet& set,
                            const OwnerTables& owners, const Atlas& atlas, const Caches& caches,
                            const CachePoints& points, std::uint32_t rays,
                            const Progress& progress);

/// Puts surfels at their places, where they read the lightmap. Those that stay keep every bit.
void placeSeen(const Scene& scene, const SeenPatches& seen, SurfelSet& set);

/// Puts surfels at `place`. Those that stay keep every bit.
void moveSurfels(const Scene& scene, const std::vector<MeshPoint>& place, SurfelSet& set);

/// Appends the caches, in texels that no lookup needs, and lets their surfels read them.
void addOwnCaches(const Scene& scene, const LightmapLayout& layout, const SeenPatches& seen,
                  Surfels& surfels, Caches& caches, CachePoints& points);

} // namespace limn
