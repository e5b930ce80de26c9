// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/rays/gather.h"

#include "engine/core/large_pages.h"
#include "engine/core/parallel.h"
#include "engine/core/process_memory.h"
#include "engine/scene/mesh/input_hash.h"
#include "engine/techniques/illuminance/bake/rays/seen_hits.h"
#include "engine/techniques/illuminance/bake/senders/cluster_tree.h"
#include "engine/trace/rays_together.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <numeric>

#include <glm/geometric.hpp>

namespace limn {

namespace {

/// The surfels of instances whose material emits.
std::vector<std::uint32_t> emissiveSurfels(const Scene& scene, const SurfelSet& set) {
    std::vector<std::uint32_t> result;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        if (!emits(scene.materialOf(scene.instances[i])))
            continue;
        for (std::uint32_t s = set.instanceBegin[i]; s < set.instanceBegin[i + 1]; ++s)
            result.push_back(s);
    }
    return result;
}

/// Origin of the rays that leave a cache's point.
glm::vec3 startOf(const TraceScene& trace, const CachePoints& points, std::uint32_t point) {
    return trace.clearOf(points.position[point], points.normal[point]);
}

struct HitClassifier {
    const TraceScene& trace;
    const SurfelSet& set;
    const Caches& caches;
    const CachePoints& points;
    Linker linker;
    std::vector<std::uint32_t> targets; ///< senders to aim at
    const LampPatches& lamps;
    bool aimedAlready;
    std::vector<bool> isTarget; ///< per sender; empty without targets

    /// Marks hits on backs. All hits of a cache in a solid are marked, since the others, known or
    /// not, do not count.
    static void markBacks(std::uint32_t rays, std::uint32_t* sender) {
        if (isInSolid(sender, rays))
            std::fill_n(sender, rays, kBack);
        std::replace_if(
            sender, sender + rays, [](RawHit hit) { return (hit & kBack) != 0; },
            GatherHits::kBackFace);
    }

    /// Marks the rays of points most of whose rays met backs.
    static void excludePointsInSolids(std::uint32_t count, std::uint32_t rays,
                                      std::uint32_t* sender) {
        for (std::uint32_t k = 0; k < count; ++k) {
            std::uint32_t all = 0, backs = 0;
            for (std::uint32_t r = k; r < rays; r += count) {
                ++all;
                backs += sender[r] == GatherHits::kBackFace ? 1 : 0;
            }
            for (std::uint32_t r = k; 2 * backs > all && r < rays; r += count)
                sender[r] = GatherHits::kExcluded;
        }
    }

    /// Replaces the few chance hits of the targets by a ray at each, from the cache's points in
    /// turn. Returns the rays traced.
    std::uint32_t aimCache(std::uint32_t cache, std::uint32_t rays, std::uint32_t* sender,
                           std::vector<AimedSample>& aimed) const {
        const auto met = [&](std::uint32_t s) { return s < isTarget.size() && isTarget[s]; };
        if (targets.empty() ||
            (linker == Linker::Gather &&
             std::uint32_t(std::count_if(sender, sender + rays, met)) * 8 >= rays))
            return 0;
        std::vector<std::uint32_t> open; // points that are not in a solid
        forEachValidPoint(points, cache, {sender, rays},
                          [&](std::uint32_t point) { open.push_back(point); });
        if (open.empty())
            return 0;
        const auto replaced = [&](std::uint32_t s) { return met(s) && isFar(s, open[0]); };
        std::replace_if(sender, sender + rays, replaced, GatherHits::kAimed);
        if (aimedAlready)
            return 0;
        return aim(caches.kind[cache], chooseSamples(cache, rays, open), aimed);
    }

private:
    /// Whether a point is far enough from a sender to aim at it.
    bool isFar(std::uint32_t sender, std::uint32_t point) const {
        if (linker == Linker::FormFactor || sender >= lamps.extent.size())
            return true;
        const glm::vec3 way = set.surfels.position[sender] - points.position[point];
        const float from = kAimedFrom * lamps.extent[sender];
        return glm::dot(way, way) >= from * from;
    }

    /// One sample of each target that is far. From more than maxLampsAimed(rays) emissive ones,
    /// systematic sampling chooses as many with probability in proportion to their unoccluded
    /// transport; each sample is scaled by the inverse of its probability, so the sum is unbiased.
    std::vector<AimedSample> chooseSamples(std::uint32_t cache, std::uint32_t rays,
                                           const std::vector<std::uint32_t>& open) const {
        const std::uint32_t maximum = maxLampsAimed(rays);
        std::vector<AimedSample> all;
        for (std::size_t i = 0; i < targets.size(); ++i)
            if (isFar(targets[i], open[0]))
                all.push_back({targets[i], open[i % open.size()]});
        if (linker == Linker::FormFactor || all.size() <= maximum)
            return all;
        std::vector<double> cumulative;
        double sum = 0;
        for (const AimedSample& sample : all)
            cumulative.push_back(
                sum += double(solidAngleOf(set.surfels, lamps, points, caches.kind[cache], sample)
                                  .transport));
        std::vector<AimedSample> chosen;
        const double step = sum / maximum,
                     start = double(unitFloat(mixBits(points.seed[cache] + 1))) * step;
        for (std::size_t i = 0, k = 0; k < maximum && i < all.size(); ++i) {
            std::uint32_t hits = 0;
            for (; k < maximum && start + double(k) * step < cumulative[i]; ++k)
                ++hits;
            const double share = cumulative[i] - (i > 0 ? cumulative[i - 1] : 0);
            if (hits > 0 && share > 0)
                chosen.push_back({all[i].sender, all[i].point, float(hits * step / share)});
        }
        return chosen;
    }

    /// Adds the samples that are in sight. Returns the number of rays traced: none where sender and
    /// point do not face each other.
    std::uint32_t aim(CacheKind kind, const std::vector<AimedSample>& samples,
                      std::vector<AimedSample>& aimed) const {
        RaysTogether<AimedSample> rays(trace, TraceMask::Static);
        const auto open = [&](const AimedSample& sample) { aimed.push_back(sample); };
        for (const AimedSample& sample : samples) {
            const SubtendedSolidAngle subtended =
                solidAngleOf(set.surfels, lamps, points, kind, sample);
            if (subtended.transport > 0)
                rays.add(rayTo(sample, subtended.direction), sample, open);
        }
        rays.flush(open);
        return std::uint32_t(rays.traced());
    }

    /// The ray of a sample whose sender lies along `direction`.
    Ray rayTo(const AimedSample& sample, glm::vec3 direction) const {
        const glm::vec3 from = startOf(trace, points, sample.point);
        if (sample.sender >= set.surfels.size())
            return {from, direction};
        const WorldPoint target = targetOf(set.surfels, lamps, points, sample);
        return rayBetween(from, trace.clearOf(target.position, target.normal));
    }
};

/// The senders that caches aim at.
std::vector<std::uint32_t> aimTargets(const Scene& scene, const SurfelSet& set, Linker linker) {
    if (linker == Linker::Gather)
        return emissiveSurfels(scene, set);
    std::vector<std::uint32_t> all(set.surfels.size() + kSkyCells);
    std::iota(all.begin(), all.end(), 0U);
    return all;
}

/// Moves each cache's aimed samples into one array. Memory is freed on the way, so that the two
/// copies hardly coexist.
void joinAimed(std::vector<std::vector<AimedSample>>& aimed, GatherHits& hits) {
    std::size_t all = 0;
    for (const std::vector<AimedSample>& a : aimed)
        all += a.size();
    hits.aimed.clear();
    reserveLarge(hits.aimed, all);
    hits.aimedBegin = {0};
    constexpr std::size_t kParts = 8;
    std::size_t next = all / kParts;
    for (std::vector<AimedSample>& a : aimed) {
        hits.aimed.insert(hits.aimed.end(), a.begin(), a.end());
        hits.aimedBegin.push_back(std::uint32_t(hits.aimed.size()));
        a = {};
        if (hits.aimed.size() > next) {
            releaseFreedMemory();
            next += all / kParts + 1;
        }
    }
}

/// Index of the k-th probe's ray.
std::uint32_t probeRay(std::uint32_t k, std::uint32_t rays) {
    return std::uint32_t(std::uint64_t(k) * rays / kProbes);
}

} // namespace

bool isInSolid(const RawHit* hits, std::uint32_t rays) {
    if (rays < 2 * kProbes)
        return false;
    for (std::uint32_t k = 0; k < kProbes; ++k)
        if (!(hits[probeRay(k, rays)] & kBack))
            return false;
    return true;
}

Ray RayGatherer::ray(const CacheRays& directions, std::uint32_t cache, std::uint32_t r) const {
    const std::uint32_t k = r % directions.points;
    return {startOf(m_trace, m_points, m_points.begin[cache] + k), directions[r]};
}

RayGatherer::Place RayGatherer::placeOf(const SurfaceHit& hit, glm::vec3 direction) const {
    if (!hit)
        return {~0U, {skyCellOf(direction), 0}, false, false};
    const Scene& scene = m_trace.scene();
    const Instance& instance = scene.instances[hit.instance];
    const bool twoSided = isTwoSided(scene, instance);
    return {hit.instance, m_owners.tableOf(instance.mesh).cellAt(hit.triangle, hit.u, hit.v),
            !hit.frontFace && twoSided, !hit.frontFace && !twoSided};
}

RawHit RayGatherer::resolve(const Place& place) const {
    if (place.instance == ~0U)
        return std::uint32_t(m_set.surfels.size()) + place.cell.cell;
    const std::uint32_t surfel = m_owners.ofCell(place.instance, place.cell, place.back);
    return place.passed ? surfel | kBack : surfel;
}

void RayGatherer::traceSome(std::uint32_t cache, const CacheRays& rays,
                            std::span<const std::uint32_t> which, RawHit* hits) const {
    std::array<Place, kProbes> met;
    std::array<glm::vec3, AtlasTexel::kMaxPoints> from;
    for (std::uint32_t k = 0; k < rays.points; ++k)
        from[k] = startOf(m_trace, m_points, m_points.begin[cache] + k);
    for (std::size_t done = 0; done < which.size();) {
        const auto some = which.subspan(done, std::min(met.size(), which.size() - done));
        for (std::size_t i = 0; i < some.size(); ++i) {
            const glm::vec3 direction = rays[some[i]];
            met[i] = placeOf(
                m_trace.closestSurface({from[some[i] % rays.points], direction}, TraceMask::Static),
                direction);
        }
        // The owners lie far apart in memory. Asked for together, they arrive together.
        for (std::size_t i = 0; i < some.size(); ++i)
            hits[some[i]] = resolve(met[i]);
        done += some.size();
    }
}

std::uint32_t RayGatherer::traceCache(std::uint32_t cache, RawHit* out) const {
    std::fill_n(out, m_rays, kUntraced);
    if (m_rays < 2 * kProbes)
        return traceRest(cache, out);
    std::array<std::uint32_t, kProbes> probes;
    for (std::uint32_t k = 0; k < kProbes; ++k)
        probes[k] = probeRay(k, m_rays);
    traceSome(cache, directions(cache), probes, out);
    return kProbes + traceRest(cache, out);
}

std::uint32_t RayGatherer::traceRest(std::uint32_t cache, RawHit* hits) const {
    if (isInSolid(hits, m_rays))
        return 0;
    std::vector<std::uint32_t> rest;
    rest.reserve(m_rays);
    for (std::uint32_t r = 0; r < m_rays; ++r)
        if (hits[r] == kUntraced)
            rest.push_back(r);
    traceSome(cache, directions(cache), rest, hits);
    return std::uint32_t(rest.size());
}

WorldPoint targetOf(const Surfels& surfels, const LampPatches& lamps, const CachePoints& points,
                    const AimedSample& sample) {
    constexpr std::uint32_t kTries = 4; // more only where hardly any of the patch faces the start
    const std::uint32_t s = sample.sender;
    const std::span<const WorldPoint> patch = lamps.of(s);
    if (patch.empty())
        return {surfels.position[s], surfels.normal[s]};
    const glm::vec3 start = points.position[sample.point];
    std::uint32_t k = mixBits(sample.point ^ mixBits(s + 1)) % lamps.each;
    for (std::uint32_t tried = 1;
         tried < kTries && !(glm::dot(start - patch[k].position, patch[k].normal) > 0); ++tried)
        k = (k + lamps.each / kTries) % lamps.each;
    return patch[k];
}

SubtendedSolidAngle solidAngleOf(const Surfels& surfels, const LampPatches& lamps,
                                 const CachePoints& points, CacheKind kind,
                                 const AimedSample& sample) {
    constexpr float kPi = std::numbers::pi_v<float>;
    const std::uint32_t s = sample.sender;
    SubtendedSolidAngle subtended;
    if (s >= surfels.size()) {
        subtended.direction = skyCellDirection(s - std::uint32_t(surfels.size()));
        subtended.transport = sample.scale * 4 / float(kSkyCells);
    } else {
        const WorldPoint target = targetOf(surfels, lamps, points, sample);
        const glm::vec3 way = target.position - points.position[sample.point];
        const float d2 = glm::dot(way, way);
        if (!(d2 > 0))
            return {};
        subtended.direction = way / std::sqrt(d2);
        const bool isPoint = lamps.of(s).empty();
        const float cosSender =
            -glm::dot(subtended.direction, isPoint ? target.normal : lamps.normalOf(s));
        if (!(cosSender > 0))
            return {};
        const float facing = surfels.area[s] * cosSender;
        const float solidAngle =
            isPoint ? facing / (d2 + surfels.area[s] / (2 * kPi)) : std::min(facing / d2, 2 * kPi);
        subtended.transport = sample.scale * solidAngle / kPi;
    }
    subtended.cosTheta = glm::dot(subtended.direction, points.normal[sample.point]);
    return kind == CacheKind::Hemisphere && !(subtended.cosTheta > 0) ? SubtendedSolidAngle{}
                                                                      : subtended;
}

std::uint32_t maxAimed(const Scene& scene, const SurfelSet& set, Linker linker,
                       std::uint32_t rays) {
    const auto targets = std::uint32_t(aimTargets(scene, set, linker).size());
    return linker == Linker::Gather ? std::min(targets, maxLampsAimed(rays)) : targets;
}

bool classifyHits(const TraceScene& trace, const SurfelSet& set, const Caches& caches,
                  const CachePoints& points, Linker linker, const Progress& progress,
                  GatherHits& hits, std::uint64_t& aimedRays) {
    HitClassifier classifier{trace,      set,
                             caches,     points,
                             linker,     aimTargets(trace.scene(), set, linker),
                             hits.lamps, !hits.aimedBegin.empty(),
                             {}};
    if (!classifier.targets.empty())
        classifier.isTarget.resize(set.surfels.size() + kSkyCells);
    for (const std::uint32_t s : classifier.targets)
        classifier.isTarget[s] = true;
    std::vector<std::vector<AimedSample>> aimed(caches.size());
    std::atomic<std::uint64_t> traced = 0;
    const Progress quiet{.report = {}, .cancel = progress.cancel};
    const std::size_t grain =
        std::clamp<std::size_t>(65536 / (classifier.targets.size() + 1), 1, 64);
    const bool done =
        parallelRanges(caches.size(), grain, linker == Linker::Gather ? quiet : progress, "trace",
                       [&](std::size_t begin, std::size_t end) {
                           std::vector<AimedSample> found;
                           for (std::size_t c = begin; c < end; ++c) {
                               const auto cache = std::uint32_t(c);
                               std::uint32_t* sender = hits.sender.data() + c * hits.rays;
                               found.clear();
                               classifier.markBacks(hits.rays, sender);
                               classifier.excludePointsInSolids(
                                   points.begin[c + 1] - points.begin[c], hits.rays, sender);
                               traced += classifier.aimCache(cache, hits.rays, sender, found);
                               aimed[c] = found; // a copy has no spare capacity
                           }
                       });
    aimedRays += traced;
    if (classifier.aimedAlready)
        return done;
    joinAimed(aimed, hits);
    return done;
}

} // namespace limn
