// SPDX-License-Identifier: MIT
#include "engine/bake/gather.h"

#include "engine/bake/cluster_tree.h"
#include "engine/core/parallel.h"

namespace limn {

namespace {

std::vector<SurfelOwners> buildOwners(const Scene& scene, const SurfelSet& set) {
    std::vector<SurfelOwners> owners(set.meshes.size());
    for (std::size_t m = 0; m < owners.size(); ++m)
        if (set.meshes[m].size() > 0)
            owners[m] = SurfelOwners(scene.assets->meshes[m], set.meshes[m]);
    return owners;
}

struct Gatherer {
    const TraceScene& trace;
    const SurfelSet& set;
    const Caches& caches;
    std::vector<SurfelOwners> owners;

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

    void gatherCache(std::uint32_t cache, std::uint32_t rays, std::uint32_t* out) const {
        const CacheRays directions = raysOf(caches, cache, rays);
        const glm::vec3 p = caches.position[cache];
        const glm::vec3 lift = caches.kind[cache] == CacheKind::Grid
                                   ? glm::vec3(0)
                                   : caches.normal[cache] * trace.epsilonAt(p);
        for (std::uint32_t r = 0; r < rays; ++r) {
            const glm::vec3 local = directions.local[r];
            Ray ray;
            ray.origin = local.z < 0 ? p - lift : p + lift;
            ray.direction = directions.toWorld * local;
            out[r] = sender(ray);
        }
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
    const Gatherer gatherer{trace, set, caches, buildOwners(trace.scene(), set)};
    hits.rays = rays;
    hits.sender.resize(caches.size() * rays);
    return parallelRanges(
        caches.size(), 8, progress, "trace", [&](std::size_t begin, std::size_t end) {
            for (std::size_t c = begin; c < end; ++c)
                gatherer.gatherCache(std::uint32_t(c), rays, hits.sender.data() + c * rays);
        });
}

} // namespace limn
