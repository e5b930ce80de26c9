// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/transport/gather.h"

#include "engine/core/parallel.h"
#include "engine/core/process_memory.h"
#include "engine/scene/mesh/input_hash.h"
#include "engine/techniques/illuminance/bake/senders/cluster_tree.h"
#include "engine/techniques/illuminance/bake/transport/seen_hits.h"

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

struct Finisher {
    const TraceScene& trace;
    const SurfelSet& set;
    const Caches& caches;
    const CachePoints& points;
    Linker linker;
    std::vector<std::uint32_t> targets; ///< senders to aim at
    const std::vector<float>& extents;  ///< lampExtents() of the surfels
    bool aimedAlready;
    std::vector<bool> isTarget; ///< per sender; empty without targets

    /// Marks hits on backs; in a buried cache all hits, since the others do not count, known or
    /// not.
    static void markBacks(std::uint32_t rays, std::uint32_t* sender) {
        if (isBuried(sender, rays))
            std::fill_n(sender, rays, kBack);
        std::replace_if(
            sender, sender + rays, [](RawHit hit) { return (hit & kBack) != 0; },
            GatherHits::kBackFace);
    }

    /// Marks the rays of points most of whose rays met backs.
    static void leaveOutBuried(std::uint32_t count, std::uint32_t rays, std::uint32_t* sender) {
        for (std::uint32_t k = 0; k < count; ++k) {
            std::uint32_t all = 0, backs = 0;
            for (std::uint32_t r = k; r < rays; r += count) {
                ++all;
                backs += sender[r] == GatherHits::kBackFace ? 1 : 0;
            }
            for (std::uint32_t r = k; 2 * backs > all && r < rays; r += count)
                sender[r] = GatherHits::kLeftOut;
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
        std::vector<std::uint32_t> open; // points that are not buried
        forEachOpenPoint(points, cache, {sender, rays},
                         [&](std::uint32_t point) { open.push_back(point); });
        if (open.empty())
            return 0;
        std::uint32_t traced = 0;
        const auto replaced = [&](std::uint32_t s) { return met(s) && isFar(s, open[0]); };
        std::replace_if(sender, sender + rays, replaced, GatherHits::kAimed);
        if (aimedAlready)
            return 0;
        for (const AimedSample& sample : chooseSamples(cache, open))
            traced += aim(caches.kind[cache], sample, aimed) ? 1 : 0;
        return traced;
    }

private:
    /// Whether a ray at the middle of a sender tells how much of it is in sight from a point.
    bool isFar(std::uint32_t sender, std::uint32_t point) const {
        if (linker == Linker::FormFactor || sender >= extents.size())
            return true;
        const glm::vec3 way = set.surfels.position[sender] - points.position[point];
        const float from = kAimedFrom * extents[sender];
        return glm::dot(way, way) >= from * from;
    }

    /// One sample of each target that is far. From more than kMaxAimed emissive ones, systematic
    /// sampling chooses kMaxAimed with probability in proportion to their unoccluded transport;
    /// each sample is scaled by the inverse of its probability, so the sum is unbiased.
    std::vector<AimedSample> chooseSamples(std::uint32_t cache,
                                           const std::vector<std::uint32_t>& open) const {
        std::vector<AimedSample> all;
        for (std::size_t i = 0; i < targets.size(); ++i)
            if (isFar(targets[i], open[0]))
                all.push_back({targets[i], open[i % open.size()]});
        if (linker == Linker::FormFactor || all.size() <= kMaxAimed)
            return all;
        std::vector<double> worth;
        double sum = 0;
        for (const AimedSample& sample : all)
            worth.push_back(
                sum += double(viewOf(set.surfels, points, caches.kind[cache], sample).transport));
        std::vector<AimedSample> chosen;
        const double step = sum / kMaxAimed,
                     start = double(unitFloat(mixBits(points.seed[cache] + 1))) * step;
        for (std::size_t i = 0, k = 0; k < kMaxAimed && i < all.size(); ++i) {
            std::uint32_t hits = 0;
            for (; k < kMaxAimed && start + double(k) * step < worth[i]; ++k)
                ++hits;
            const double own = worth[i] - (i > 0 ? worth[i - 1] : 0);
            if (hits > 0 && own > 0)
                chosen.push_back({all[i].sender, all[i].point, float(hits * step / own)});
        }
        return chosen;
    }

    /// Returns false where the two do not face each other; no ray is traced then.
    bool aim(CacheKind kind, const AimedSample& sample, std::vector<AimedSample>& aimed) const {
        const SenderView view = viewOf(set.surfels, points, kind, sample);
        if (!(view.transport > 0))
            return false;
        const glm::vec3 from = startOf(trace, points, sample.point);
        const std::uint32_t s = sample.sender;
        const bool hidden =
            s >= set.surfels.size()
                ? trace.occluded({from, view.direction}, TraceMask::Static)
                : trace.blocked(from, trace.clearOf(set.surfels.position[s], set.surfels.normal[s]),
                                TraceMask::Static);
        if (!hidden)
            aimed.push_back(sample);
        return true;
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
    hits.aimed.reserve(all);
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

bool isBuried(const RawHit* hits, std::uint32_t rays) {
    if (rays < 2 * kProbes)
        return false;
    for (std::uint32_t k = 0; k < kProbes; ++k)
        if (!(hits[probeRay(k, rays)] & kBack))
            return false;
    return true;
}

CacheRays raysOf(const Caches& caches, const CachePoints& points, std::uint32_t cache,
                 std::uint32_t rays) {
    const std::uint32_t first = points.begin[cache], count = points.begin[cache + 1] - first;
    CacheRays result{
        DirectionSet(rays, caches.kind[cache] != CacheKind::Hemisphere, points.seed[cache]),
        count,
        {}};
    for (std::uint32_t k = 0; k < count; ++k)
        result.toWorld[k] = basisAround(
            caches.kind[cache] == CacheKind::Grid ? glm::vec3(0, 0, 1) : points.normal[first + k]);
    return result;
}

Ray RayGatherer::ray(const CacheRays& directions, std::uint32_t cache, std::uint32_t r) const {
    const std::uint32_t k = r % directions.points;
    return {startOf(m_trace, m_points, m_points.begin[cache] + k), directions[r]};
}

RawHit RayGatherer::credit(const Hit& hit, glm::vec3 direction) const {
    if (!hit)
        return std::uint32_t(m_set.surfels.size()) + skyCellOf(direction);
    const Scene& scene = m_trace.scene();
    const Instance& instance = scene.instances[hit.instance];
    const bool back = !hit.frontFace, passes = back && !isTwoSided(scene.materialOf(instance));
    const std::uint32_t surfel =
        m_owners.at(hit.instance, hit.triangle, hit.u, hit.v, back && !passes);
    return passes ? surfel | kBack : surfel;
}

std::uint32_t RayGatherer::traceCache(std::uint32_t cache, RawHit* out) const {
    std::fill_n(out, m_rays, kUntraced);
    std::uint32_t probes = 0;
    if (m_rays >= 2 * kProbes) {
        const CacheRays rays = directions(cache);
        for (; probes < kProbes; ++probes) {
            const std::uint32_t r = probeRay(probes, m_rays);
            out[r] = trace(ray(rays, cache, r));
        }
    }
    return probes + traceRest(cache, out);
}

std::uint32_t RayGatherer::traceRest(std::uint32_t cache, RawHit* hits) const {
    if (isBuried(hits, m_rays))
        return 0;
    std::uint32_t traced = 0;
    const CacheRays rays = directions(cache);
    for (std::uint32_t r = 0; r < m_rays; ++r)
        if (hits[r] == kUntraced) {
            hits[r] = trace(ray(rays, cache, r));
            ++traced;
        }
    return traced;
}

SenderView viewOf(const Surfels& surfels, const CachePoints& points, CacheKind kind,
                  const AimedSample& sample) {
    constexpr float kPi = std::numbers::pi_v<float>;
    const std::uint32_t s = sample.sender;
    SenderView view;
    if (s >= surfels.size()) {
        view.direction = skyCellDirection(s - std::uint32_t(surfels.size()));
        view.transport = sample.scale * 4 / float(kSkyCells);
    } else {
        const glm::vec3 way = surfels.position[s] - points.position[sample.point];
        const float d2 = glm::dot(way, way);
        if (!(d2 > 0))
            return {};
        view.direction = way / std::sqrt(d2);
        const float cosSender = -glm::dot(view.direction, surfels.normal[s]);
        if (!(cosSender > 0))
            return {};
        view.transport =
            sample.scale * surfels.area[s] * cosSender / (d2 + surfels.area[s] / (2 * kPi)) / kPi;
    }
    view.cosTheta = glm::dot(view.direction, points.normal[sample.point]);
    return kind == CacheKind::Hemisphere && !(view.cosTheta > 0) ? SenderView{} : view;
}

std::uint32_t maxAimed(const Scene& scene, const SurfelSet& set, Linker linker) {
    const auto targets = std::uint32_t(aimTargets(scene, set, linker).size());
    return linker == Linker::Gather ? std::min(targets, kMaxAimed) : targets;
}

bool finishHits(const TraceScene& trace, const SurfelSet& set, const Caches& caches,
                const CachePoints& points, Linker linker, const std::vector<float>& extents,
                const Progress& progress, GatherHits& hits, std::uint64_t& aimedRays) {
    Finisher finisher{trace,   set,
                      caches,  points,
                      linker,  aimTargets(trace.scene(), set, linker),
                      extents, !hits.aimedBegin.empty(),
                      {}};
    if (!finisher.targets.empty())
        finisher.isTarget.resize(set.surfels.size() + kSkyCells);
    for (const std::uint32_t s : finisher.targets)
        finisher.isTarget[s] = true;
    std::vector<std::vector<AimedSample>> aimed(caches.size());
    std::atomic<std::uint64_t> traced = 0;
    const Progress quiet{.report = {}, .cancel = progress.cancel};
    const std::size_t grain = std::clamp<std::size_t>(65536 / (finisher.targets.size() + 1), 1, 64);
    const bool done = parallelRanges(
        caches.size(), grain, linker == Linker::Gather ? quiet : progress, "trace",
        [&](std::size_t begin, std::size_t end) {
            std::vector<AimedSample> found;
            for (std::size_t c = begin; c < end; ++c) {
                const auto cache = std::uint32_t(c);
                std::uint32_t* sender = hits.sender.data() + c * hits.rays;
                found.clear();
                finisher.markBacks(hits.rays, sender);
                finisher.leaveOutBuried(points.begin[c + 1] - points.begin[c], hits.rays, sender);
                traced += finisher.aimCache(cache, hits.rays, sender, found);
                aimed[c] = found; // a copy has no spare capacity
            }
        });
    aimedRays += traced;
    if (finisher.aimedAlready)
        return done;
    joinAimed(aimed, hits);
    return done;
}

} // namespace limn
