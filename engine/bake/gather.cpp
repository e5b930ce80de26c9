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

    /// Where a ray of the cache starts that leaves on the front (or back) of its surface.
    glm::vec3 start(std::uint32_t cache, bool front) const {
        const glm::vec3 p = caches.position[cache];
        if (caches.kind[cache] == CacheKind::Grid)
            return p;
        const glm::vec3 lift = caches.normal[cache] * trace.epsilonAt(p);
        return front ? p + lift : p - lift;
    }

    void gatherCache(std::uint32_t cache, std::uint32_t rays, std::uint32_t* out) const {
        const CacheRays directions = raysOf(caches, cache, rays);
        const glm::vec3 front = start(cache, true), back = start(cache, false);
        for (std::uint32_t r = 0; r < rays; ++r) {
            const glm::vec3 local = directions.local[r];
            Ray ray;
            ray.origin = local.z < 0 ? back : front;
            ray.direction = directions.toWorld * local;
            out[r] = sender(ray);
        }
    }

    /// Replaces the few chance hits of emissive surfels by a ray at each.
    void aimCache(std::uint32_t cache, std::uint32_t rays, std::uint32_t* sender,
                  std::vector<AimedSample>& aimed) const {
        const auto met = [&](std::uint32_t s) { return s < isEmissive.size() && isEmissive[s]; };
        if (emissive.empty() ||
            std::uint32_t(std::count_if(sender, sender + rays, met)) * 16 >= rays)
            return;
        std::replace_if(sender, sender + rays, met, GatherHits::kAimed);
        for (const std::uint32_t s : emissive)
            aim(cache, s, aimed);
    }

private:
    void aim(std::uint32_t cache, std::uint32_t s, std::vector<AimedSample>& aimed) const {
        const glm::vec3 toSender = set.surfels.position[s] - caches.position[cache];
        const float d2 = glm::dot(toSender, toSender);
        if (!(d2 > 0))
            return;
        const glm::vec3 direction = toSender / std::sqrt(d2);
        const float side = glm::dot(direction, caches.normal[cache]);
        const float cosSender = -glm::dot(direction, set.surfels.normal[s]);
        if (!(cosSender > 0) || (caches.kind[cache] == CacheKind::Hemisphere && !(side > 0)))
            return;
        const glm::vec3 from = start(cache, side > 0);
        const glm::vec3 to = set.surfels.position[s] +
                             set.surfels.normal[s] * trace.epsilonAt(set.surfels.position[s]);
        const float length = glm::length(to - from);
        if (!(length > 0) ||
            trace.occluded({from, (to - from) / length, 0, length}, TraceMask::Static))
            return;
        const float area = set.surfels.area[s];
        const float solidAngle = area * cosSender / (d2 + area / (2 * std::numbers::pi_v<float>));
        aimed.push_back({s, solidAngle / std::numbers::pi_v<float>, direction});
    }
};

} // namespace

CacheRays raysOf(const Caches& caches, std::uint32_t cache, std::uint32_t rays) {
    const CacheKind kind = caches.kind[cache];
    const glm::vec3 axis = kind == CacheKind::Grid ? glm::vec3(0, 0, 1) : caches.normal[cache];
    return {DirectionSet(rays, kind != CacheKind::Hemisphere, cache), basisAround(axis)};
}

bool gather(const TraceScene& trace, const SurfelSet& set, const Caches& caches, std::uint32_t rays,
            const Progress& progress, GatherHits& hits) {
    Gatherer gatherer{trace,
                      set,
                      caches,
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
