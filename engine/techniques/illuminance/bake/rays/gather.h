// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/bake/rays/cache_rays.h"
#include "engine/techniques/illuminance/bake/rays/gather_hits.h"
#include "engine/techniques/illuminance/bake/senders/owner_tables.h"
#include "engine/trace/trace_scene.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace limn {

/// The solid angle that a sender subtends at a point without occlusion.
struct SubtendedSolidAngle {
    float transport = 0;          ///< solid angle / pi; 0: they do not face each other
    float cosTheta = 0;           ///< at the point; 0 for the grid
    glm::vec3 direction{0, 0, 1}; ///< unit, away from the point
};

/// Where the ray of a sample of a surfel ends: at one of the points of an emissive surfel's patch
/// that face the start, which a hash of sender and start chooses, so that the share of blocked rays
/// is that of the patch which is hidden. Other surfels have their position alone.
WorldPoint targetOf(const Surfels& surfels, const LampPatches& lamps, const CachePoints& points,
                    const AimedSample& sample);

/// Solid angle of the sample's sender at its point, times the sample's scale. A sky cell has its
/// whole solid angle. That of an emissive surfel is a cos / d^2 at targetOf(), at most 2 pi, with
/// the cosine of the patch's mean normal: over a flat patch its mean is exact, and over a closed
/// body the errors of curved ones cancel, where the cosines of single points would be noise. That
/// of another surfel, with the one position, is the bounded a cos / (d^2 + a / 2 pi), which tends
/// to 2 pi at contact. A point of a Hemisphere cache sees nothing behind it.
SubtendedSolidAngle solidAngleOf(const Surfels& surfels, const LampPatches& lamps,
                                 const CachePoints& points, CacheKind kind,
                                 const AimedSample& sample);

/// Result of one ray before classifyHits(): a leaf of the ClusterTree or, with kBack set, the
/// surfel on the front of the one-sided surface whose back it met. Tracing yields only these 4
/// bytes per ray, so they can be stored and read again.
using RawHit = std::uint32_t;
inline constexpr RawHit kBack = 1U << 31;
/// The ray was not traced, since its cache lies in a solid.
inline constexpr RawHit kUntraced = ~0U;

/// Number of probes, which are evenly spaced among a cache's rays. A cache whose probes all meet
/// backs lies in a solid, and its other rays need not be traced. Not applied to caches with fewer
/// than twice as many rays.
inline constexpr std::uint32_t kProbes = 64;
bool isInSolid(const RawHit* hits, std::uint32_t rays);

/// Shoots the rays of caches at the static scene. A hit is credited to the surfel that owns the hit
/// point, an escaped ray to its sky cell.
class RayGatherer {
public:
    /// Keeps references to all but `rays`, the number per cache.
    RayGatherer(const TraceScene& trace, const SurfelSet& set, const Caches& caches,
                const CachePoints& points, std::uint32_t rays, const OwnerTables& owners)
        : m_trace(trace), m_set(set), m_caches(caches), m_points(points), m_rays(rays),
          m_owners(owners) {}

    CacheRays directions(std::uint32_t cache) const {
        return raysOf(m_caches, m_points, cache, m_rays);
    }
    Ray ray(const CacheRays& directions, std::uint32_t cache, std::uint32_t r) const;

    RawHit trace(const Ray& ray) const {
        return credit(m_trace.closestSurface(ray, TraceMask::Static), ray.direction);
    }

    /// Raw hit of a ray along `direction` that met `hit`.
    RawHit credit(const SurfaceHit& hit, glm::vec3 direction) const {
        return resolve(placeOf(hit, direction));
    }

    /// Traces all of a cache's rays, or only the probes of one in a solid. Returns the number
    /// traced.
    std::uint32_t traceCache(std::uint32_t cache, RawHit* out) const;

    /// Traces those rays of a cache that are kUntraced, unless it lies in a solid. Returns the
    /// number traced.
    std::uint32_t traceRest(std::uint32_t cache, RawHit* hits) const;

private:
    /// What a ray met: a cell of an instance's SurfelOwners, or part of the sky.
    struct Place {
        std::uint32_t instance;   ///< ~0: the sky
        SurfelOwners::Place cell; ///< or the sky's cell
        bool back;                ///< of a surface with two sides
        bool passed;              ///< the back of a surface with one
    };
    Place placeOf(const SurfaceHit& hit, glm::vec3 direction) const;
    RawHit resolve(const Place& place) const;
    void traceSome(std::uint32_t cache, const CacheRays& rays, std::span<const std::uint32_t> which,
                   RawHit* hits) const;

    const TraceScene& m_trace;
    const SurfelSet& m_set;
    const Caches& m_caches;
    const CachePoints& m_points;
    std::uint32_t m_rays;
    const OwnerTables& m_owners;
};

/// Turns the raw hits in hits.sender into senders and marks; backs of one-sided surfaces carry
/// nothing. Points of a cache most of whose rays meet backs are excluded; a cache without remaining
/// points is invalid.
///
/// Linker::Gather: only a handful of rays would meet a small bright lamp, which causes blotches. A
/// cache that meets the emissive surfels with fewer than an eighth of its rays therefore aims one
/// ray at each of them or, where there are more than maxLampsAimed(), at a sample of them in
/// proportion to what they would contribute without occlusion. A single ray tells little of how
/// much of a surfel is in sight from nearer than kAimedFrom times the extent of its patch in
/// hits.lamps: such a surfel keeps its chance hits. Which materials emit only guides the sampling;
/// rays meet all other senders.
///
/// Linker::FormFactor: every cache aims a ray at every surfel and sky cell that faces it, and the
/// rays only tell which of its points are in walls.
///
/// Where hits.aimedBegin is already filled, nothing is traced and hits.aimed stays. Adds the number
/// of aimed rays to `aimedRays`. Returns false when cancelled.
bool classifyHits(const TraceScene& trace, const SurfelSet& set, const Caches& caches,
                  const CachePoints& points, Linker linker, const Progress& progress,
                  GatherHits& hits, std::uint64_t& aimedRays);

/// Distance from which caches may aim at an emissive surfel, in extents of its patch: from there,
/// the solid angles of the patch's points are within about a third of each other.
inline constexpr float kAimedFrom = 4;

/// Maximum number of emissive surfels that a cache of `rays` rays aims at. Aiming at more takes
/// longer, and hardly lowers the error, which is mostly noise of the other rays: with 512, 128 and
/// 64 for 256 rays, the nRMSE was .0170, .0173 and .0184 in Cornell, .177, .179 and .182 in another
/// box.
constexpr std::uint32_t maxLampsAimed(std::uint32_t rays) {
    return std::clamp(rays / 2, 64U, 512U);
}

/// Maximum number of senders that one cache aims at.
std::uint32_t maxAimed(const Scene& scene, const SurfelSet& set, Linker linker, std::uint32_t rays);

} // namespace limn
