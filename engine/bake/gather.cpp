// SPDX-License-Identifier: MIT
#include "engine/bake/gather.h"

#include "engine/bake/cluster_tree.h"
#include "engine/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace limn {

namespace {

std::vector<SurfelOwners> buildOwners(const Scene& scene, const SurfelSet& set) {
    std::vector<SurfelOwners> owners(set.meshes.size());
    for (std::size_t m = 0; m < owners.size(); ++m)
        if (set.meshes[m].size() > 0)
            owners[m] = SurfelOwners(scene.assets->meshes[m], set.meshes[m]);
    return owners;
}

/// Surfels of instances whose material emits, or none where there are so many that rays meet enough
/// of them.
std::vector<std::uint32_t> emissiveSurfels(const Scene& scene, const SurfelSet& set,
                                           std::uint32_t rays) {
    std::vector<std::uint32_t> result;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const glm::vec3 e = scene.materialOf(scene.instances[i]).emission;
        if (!(e.x > 0 || e.y > 0 || e.z > 0))
            continue;
        for (std::uint32_t s = set.instanceBegin[i]; s < set.instanceBegin[i + 1]; ++s)
            result.push_back(s);
    }
    return result.size() <= rays ? result : std::vector<std::uint32_t>();
}

struct Gatherer {
    const TraceScene& trace;
    const SurfelSet& set;
    const Caches& caches;
    const CachePoints& points;
    std::vector<SurfelOwners> owners;
    std::vector<std::uint32_t> emissive;
    std::vector<bool> isEmissive; ///< per surfel; empty without emissive ones

    std::uint32_t sender(const Ray& ray) const {
        const Hit hit = trace.closestHit(ray, TraceMask::Static);
        if (!hit)
            return std::uint32_t(set.surfels.size()) + skyCellOf(ray.direction);
        const Scene& scene = trace.scene();
        const Instance& instance = scene.instances[hit.instance];
        const bool back = !hit.frontFace;
        if (back && !isTwoSided(scene.materialOf(instance)))
            return GatherHits::kBackFace;
        return set.instanceBegin[hit.instance] +
               owners[instance.mesh].at(hit.triangle, hit.u, hit.v, back);
    }

    /// Where a ray starts that leaves a cache's point on the front (or back) of its surface.
    glm::vec3 start(std::uint32_t point, bool front) const {
        const glm::vec3 p = points.position[point];
        const glm::vec3 lift = points.normal[point] * trace.epsilonAt(p);
        return front ? p + lift : p - lift;
    }

    void gatherCache(std::uint32_t cache, std::uint32_t rays, std::uint32_t* out) const {
        const CacheRays directions = raysOf(caches, points, cache, rays);
        const std::uint32_t first = points.begin[cache];
        for (std::uint32_t r = 0; r < rays; ++r) {
            const std::uint32_t k = r % directions.points;
            const glm::vec3 local = directions.local[r];
            Ray ray;
            ray.origin = start(first + k, local.z >= 0);
            ray.direction = directions.toWorld[k] * local;
            out[r] = sender(ray);
        }
        leaveOutBuried(directions.points, rays, out);
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

    /// Replaces the few chance hits of emissive surfels by a ray at each, from the cache's points
    /// in turn.
    void aimCache(std::uint32_t cache, std::uint32_t rays, std::uint32_t* sender,
                  std::vector<AimedSample>& aimed) const {
        const auto met = [&](std::uint32_t s) { return s < isEmissive.size() && isEmissive[s]; };
        if (emissive.empty() ||
            std::uint32_t(std::count_if(sender, sender + rays, met)) * 16 >= rays)
            return;
        std::vector<std::uint32_t> open; // points that are not buried
        for (std::uint32_t k = 0; k < points.begin[cache + 1] - points.begin[cache]; ++k)
            if (sender[k] != GatherHits::kLeftOut)
                open.push_back(points.begin[cache] + k);
        if (open.empty())
            return;
        std::replace_if(sender, sender + rays, met, GatherHits::kAimed);
        for (std::size_t i = 0; i < emissive.size(); ++i)
            aim(caches.kind[cache], open[i % open.size()], emissive[i], aimed);
    }

private:
    void aim(CacheKind kind, std::uint32_t point, std::uint32_t s,
             std::vector<AimedSample>& aimed) const {
        const glm::vec3 toSender = set.surfels.position[s] - points.position[point];
        const float d2 = glm::dot(toSender, toSender);
        if (!(d2 > 0))
            return;
        const glm::vec3 direction = toSender / std::sqrt(d2);
        const float cosTheta = glm::dot(direction, points.normal[point]);
        const float cosSender = -glm::dot(direction, set.surfels.normal[s]);
        if (!(cosSender > 0) || (kind == CacheKind::Hemisphere && !(cosTheta > 0)))
            return;
        const glm::vec3 from = start(point, cosTheta >= 0);
        const glm::vec3 to = set.surfels.position[s] +
                             set.surfels.normal[s] * trace.epsilonAt(set.surfels.position[s]);
        const float length = glm::length(to - from);
        if (!(length > 0) ||
            trace.occluded({from, (to - from) / length, 0, length}, TraceMask::Static))
            return;
        const float area = set.surfels.area[s];
        const float solidAngle = area * cosSender / (d2 + area / (2 * std::numbers::pi_v<float>));
        aimed.push_back({s, solidAngle / std::numbers::pi_v<float>, cosTheta, direction});
    }
};

} // namespace

CacheRays raysOf(const Caches& caches, const CachePoints& points, std::uint32_t cache,
                 std::uint32_t rays) {
    const std::uint32_t first = points.begin[cache], count = points.begin[cache + 1] - first;
    CacheRays result{
        DirectionSet(rays, caches.kind[cache] != CacheKind::Hemisphere, cache), count, {}};
    for (std::uint32_t k = 0; k < count; ++k)
        result.toWorld[k] = basisAround(
            caches.kind[cache] == CacheKind::Grid ? glm::vec3(0, 0, 1) : points.normal[first + k]);
    return result;
}

bool gather(const TraceScene& trace, const SurfelSet& set, const Caches& caches,
            const CachePoints& points, std::uint32_t rays, const Progress& progress,
            GatherHits& hits) {
    Gatherer gatherer{trace,
                      set,
                      caches,
                      points,
                      buildOwners(trace.scene(), set),
                      emissiveSurfels(trace.scene(), set, rays),
                      {}};
    if (!gatherer.emissive.empty())
        gatherer.isEmissive.resize(set.surfels.size());
    for (const std::uint32_t s : gatherer.emissive)
        gatherer.isEmissive[s] = true;
    hits.rays = rays;
    hits.sender.resize(caches.size() * rays);
    std::vector<std::vector<AimedSample>> aimed(caches.size());
    const bool done = parallelRanges(
        caches.size(), 8, progress, "trace", [&](std::size_t begin, std::size_t end) {
            for (std::size_t c = begin; c < end; ++c) {
                gatherer.gatherCache(std::uint32_t(c), rays, hits.sender.data() + c * rays);
                gatherer.aimCache(std::uint32_t(c), rays, hits.sender.data() + c * rays, aimed[c]);
            }
        });
    hits.aimedBegin = {0};
    hits.aimed.clear();
    for (const std::vector<AimedSample>& a : aimed) {
        hits.aimed.insert(hits.aimed.end(), a.begin(), a.end());
        hits.aimedBegin.push_back(std::uint32_t(hits.aimed.size()));
    }
    return done;
}

} // namespace limn
