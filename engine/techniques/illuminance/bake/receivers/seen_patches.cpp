// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/receivers/seen_patches.h"

#include "engine/core/large_pages.h"
#include "engine/core/parallel.h"
#include "engine/lightmap/texel_sides.h"
#include "engine/math/sampling.h"
#include "engine/scene/mesh/input_hash.h"
#include "engine/techniques/illuminance/bake/rays/seen_hits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr std::uint32_t kPicks = 16; ///< maximum number of places of a patch that are compared
constexpr float kMinError = 0.1f;    ///< difference in the share of light that counts as an error

/// The point where a ray of a cache met a surfel's patch.
struct PatchHit {
    std::uint32_t surfel = ~0U; ///< ~0: it met none
    MeshPoint point{};
    bool near = false; ///< from a distance less than the patch's width
};

bool isBack(const SurfelSet& set, std::uint32_t surfel, const Scene& scene) {
    const std::uint32_t instance = set.surfels.instance[surfel];
    return surfel - set.instanceBegin[instance] >=
           set.meshes[scene.instances[instance].mesh].frontCount;
}

WorldPoint placeOf(const Scene& scene, const SurfelSet& set, std::uint32_t surfel,
                   const MeshPoint& point) {
    return worldPoint(scene, scene.instances[set.surfels.instance[surfel]], point,
                      isBack(set, surfel, scene));
}

/// Shares of the irradiance of a bright hemisphere that come from the sky's directions and from
/// those of emissive surfaces.
struct LightShares {
    float sky = 0, lamps = 0;
};

struct PatchHits {
    const TraceScene& trace;
    const SurfelSet& set;
    const OwnerTables& owners;
    const Caches& caches;
    const CachePoints& points;
    std::uint32_t rays;                    ///< number for each cache and each surfel
    std::vector<PatchHit> hits = {};       ///< `rays` per cache
    std::vector<float> ofRay = {};         ///< rayIrradiances() of a lightmap cache
    std::vector<LightShares> shares = {};  ///< of each lightmap cache
    std::vector<std::uint32_t> begin = {}; ///< of surfel s: order[begin[s] … begin[s + 1])
    std::vector<std::uint32_t> order = {}; ///< indices into `hits`

    bool look(const Progress& progress);
    void addLight(const SurfaceHit& hit, float irradiance, LightShares& shares) const;
    void sort();
    std::vector<std::uint32_t> picks(std::uint32_t surfel) const;
    bool isSeen(std::uint32_t surfel, const std::vector<std::uint32_t>& picked) const;
    MeshPoint placeFor(std::uint32_t surfel, const std::vector<std::uint32_t>& picked) const;
};

/// Adds a ray's part of the irradiance to the light that it met, if any.
void PatchHits::addLight(const SurfaceHit& hit, float irradiance, LightShares& sum) const {
    if (!hit) {
        sum.sky += irradiance;
        return;
    }
    const Scene& scene = trace.scene();
    const Instance& instance = scene.instances[hit.instance];
    if (emits(scene.materialOf(instance)) && (hit.frontFace || isTwoSided(scene, instance)))
        sum.lamps += irradiance;
}

bool PatchHits::look(const Progress& progress) {
    resizeLarge(hits, std::size_t(caches.lightmapCount) * rays);
    ofRay = rayIrradiances(rays, CacheKind::Hemisphere);
    shares.resize(caches.lightmapCount);
    const RayGatherer gatherer(trace, set, caches, points, rays, owners);
    return parallelRanges(
        caches.lightmapCount, 64, progress, "caches", [&](std::size_t first, std::size_t last) {
            for (std::size_t c = first; c < last; ++c) {
                const CacheRays directions = gatherer.directions(std::uint32_t(c));
                const bool counts = points.weightOf(c) >= 1;
                for (std::uint32_t r = 0; r < rays; ++r) {
                    const Ray ray = gatherer.ray(directions, std::uint32_t(c), r);
                    const SurfaceHit hit = trace.closestSurface(ray, TraceMask::Static);
                    const RawHit met = gatherer.credit(hit, ray.direction);
                    addLight(hit, ofRay[r], shares[c]);
                    if (hit && counts && !(met & kBack))
                        hits[c * rays + r] = {met,
                                              {hit.triangle, {hit.u, hit.v}},
                                              hit.t * hit.t < set.surfels.area[met]};
                }
            }
        });
}

/// Sorts the hits that count by surfel, then by cache.
void PatchHits::sort() {
    const std::size_t count = set.surfels.size();
    std::vector<bool> seenFromAfar(count);
    for (const PatchHit& s : hits)
        if (s.surfel != ~0U && !s.near)
            seenFromAfar[s.surfel] = true;
    const auto counts = [&](const PatchHit& s) {
        return s.surfel != ~0U && (!s.near || !seenFromAfar[s.surfel]);
    };
    begin.assign(count + 1, 0);
    for (const PatchHit& s : hits)
        if (counts(s))
            ++begin[s.surfel + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    order.resize(begin.back());
    std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
    for (std::uint32_t i = 0; i < hits.size(); ++i)
        if (counts(hits[i]))
            order[next[hits[i].surfel]++] = i;
}

/// Picks at most kPicks of a surfel's hits, spread evenly over the caches.
std::vector<std::uint32_t> PatchHits::picks(std::uint32_t surfel) const {
    const std::uint32_t all = begin[surfel + 1] - begin[surfel], count = std::min(all, kPicks);
    std::vector<std::uint32_t> result(count);
    for (std::uint32_t k = 0; k < count; ++k)
        result[k] =
            order[begin[surfel] + std::uint32_t(std::uint64_t(2 * k + 1) * all / (2 * count))];
    return result;
}

/// Whether at least half of a few of the caches that see the surfel's patch also see the surfel's
/// own position.
bool PatchHits::isSeen(std::uint32_t surfel, const std::vector<std::uint32_t>& picked) const {
    constexpr std::size_t kAsked = 4;
    const glm::vec3 place = trace.clearOf(set.surfels.position[surfel], set.surfels.normal[surfel]);
    std::size_t asked = 0, hidden = 0;
    for (std::size_t k = 0; k < picked.size();
         k += std::max<std::size_t>(picked.size() / kAsked, 1)) {
        const std::uint32_t cache = picked[k] / rays, first = points.begin[cache],
                            point = first + picked[k] % rays % (points.begin[cache + 1] - first);
        hidden += trace.blocked(trace.clearOf(points.position[point], points.normal[point]), place,
                                TraceMask::Static);
        ++asked;
    }
    return 2 * hidden <= asked;
}

/// The place of a surfel: its own, or the picked point closest to the others. Distances are
/// measured as in the search for owners (NearestPoint).
MeshPoint PatchHits::placeFor(std::uint32_t surfel,
                              const std::vector<std::uint32_t>& picked) const {
    const Surfels& s = set.surfels;
    const MeshPoint place{s.triangle[surfel], s.barycentric[surfel]};
    if (picked.size() < 2)
        return place;
    std::vector<WorldPoint> places;
    for (const std::uint32_t i : picked)
        places.push_back(placeOf(trace.scene(), set, surfel, hits[i].point));
    const auto sumTo = [&](glm::vec3 p, glm::vec3 n) {
        float sum = 0;
        for (const WorldPoint& o : places)
            sum += std::sqrt(std::max(glm::dot(o.position - p, o.position - p) +
                                          16 * s.area[surfel] * (1 - glm::dot(o.normal, n)),
                                      0.f));
        return sum;
    };
    const float n = float(picked.size());
    float minMean = isSeen(surfel, picked) ? sumTo(s.position[surfel], s.normal[surfel]) / n
                                           : std::numeric_limits<float>::max();
    MeshPoint best = place;
    for (std::size_t k = 0; k < picked.size(); ++k)
        if (const float mean = sumTo(places[k].position, places[k].normal) / (n - 1);
            mean < minMean) {
            minMean = mean;
            best = hits[picked[k]].point;
        }
    return best;
}

/// Shares of light that a surfel has.
LightShares sharesAt(const PatchHits& patchHits, const Surfels& moved, std::uint32_t s) {
    const DirectionSet directions =
        gatherDirections(patchHits.rays, CacheKind::Hemisphere, mixBits(s + 1));
    const glm::mat3 toWorld = basisAround(moved.normal[s]);
    const glm::vec3 from = patchHits.trace.clearOf(moved.position[s], moved.normal[s]);
    LightShares shares;
    for (std::uint32_t r = 0; r < patchHits.rays; ++r)
        patchHits.addLight(
            patchHits.trace.closestSurface({from, toWorld * directions[r]}, TraceMask::Static),
            patchHits.ofRay[r], shares);
    return shares;
}

/// Texels of the atlas that belong to no cache.
std::vector<std::uint32_t> freeTexels(const LightmapLayout& layout, const Caches& caches) {
    std::vector<bool> used(std::size_t(layout.width) * layout.height);
    for (std::uint32_t c = 0; c < caches.lightmapCount; ++c)
        used[caches.texel[c]] = true;
    std::vector<std::uint32_t> result;
    for (std::uint32_t t = 0; t < used.size(); ++t)
        if (!used[t])
            result.push_back(t);
    return result;
}

/// Error of the caches of a surfel: the share of the sky, or of lamps where that differs by more,
/// that the surfel sees minus the share that they see, times the number of rays that see the
/// surfel.
float cacheError(const PatchHits& patchHits, const Surfels& moved, std::uint32_t s) {
    LightShares read;
    float sum = 0;
    for (int k = 0; k < 4; ++k)
        if (const float weight = moved.cacheWeight[s][k]; weight > 0) {
            const LightShares& shares = patchHits.shares[moved.cache[s][k]];
            read.sky += weight * shares.sky;
            read.lamps += weight * shares.lamps;
            sum += weight;
        }
    const std::uint32_t seen = patchHits.begin[s + 1] - patchHits.begin[s];
    if (seen == 0 || !(sum > 0))
        return 0;
    const LightShares visible = sharesAt(patchHits, moved, s);
    const float sky = visible.sky - read.sky, lamps = visible.lamps - read.lamps,
                larger = std::abs(lamps) > std::abs(sky) ? lamps : sky;
    return std::abs(larger) < kMinError ? 0 : larger * float(seen);
}

/// What the surfels of a group have in common: one side of one instance, since a cache has its
/// points there, their strongest cache, and how they face and err. Surfels of several instances
/// may read one cache where texels are coarser than objects.
struct GroupKey {
    std::uint32_t instance;
    bool back;
    std::uint32_t cache, axis;
    bool negative; ///< the axis along which they face points the other way
    bool brighter; ///< than their cache

    auto operator<=>(const GroupKey&) const = default;
};

/// A group of surfels that are close together, face alike, and whose caches err in the same
/// way.
struct ErrorGroup {
    GroupKey key{};
    double error = 0; ///< sum of the absolute errors, > 0
    std::vector<std::uint32_t> surfels;
};

GroupKey groupKey(const PatchHits& patchHits, const Surfels& s, std::uint32_t surfel,
                  bool brighter) {
    const glm::vec4 w = s.cacheWeight[surfel];
    const glm::vec3 n = s.normal[surfel], a = glm::abs(n);
    int cache = 0, axis = 0;
    for (int k = 1; k < 4; ++k)
        cache = w[k] > w[cache] ? k : cache;
    for (int k = 1; k < 3; ++k)
        axis = a[k] > a[axis] ? k : axis;
    return {s.instance[surfel],
            isBack(patchHits.set, surfel, patchHits.trace.scene()),
            s.cache[surfel][cache],
            std::uint32_t(axis),
            n[axis] < 0,
            brighter};
}

/// At most `maximum` groups, those of the largest errors, sorted by key.
std::vector<ErrorGroup> largestGroups(const PatchHits& patchHits, const Surfels& moved,
                                      const std::vector<float>& errors, std::size_t maximum) {
    std::vector<ErrorGroup> groups;
    std::map<GroupKey, std::size_t> indexOf;
    for (std::uint32_t s = 0; s < errors.size(); ++s) {
        if (errors[s] == 0)
            continue;
        const GroupKey key = groupKey(patchHits, moved, s, errors[s] > 0);
        const auto [entry, isNew] = indexOf.emplace(key, groups.size());
        if (isNew)
            groups.push_back({.key = key});
        ErrorGroup& group = groups[entry->second];
        group.error += double(std::abs(errors[s]));
        group.surfels.push_back(s);
    }
    std::ranges::sort(groups, [](const ErrorGroup& a, const ErrorGroup& b) {
        return a.error != b.error ? a.error > b.error : a.key < b.key;
    });
    groups.resize(std::min(groups.size(), maximum));
    std::ranges::sort(groups, {}, &ErrorGroup::key);
    return groups;
}

/// Makes a surfel cache over seen points of the surfels' patches that face as the first surfel
/// does. Of these it takes the points visible from a place a little above the surfel, which lie on
/// its side of a wall; if none is visible, it takes them all.
SurfelCache makeSurfelCache(const PatchHits& patchHits, const Surfels& moved,
                            const std::vector<std::uint32_t>& surfels) {
    constexpr float kAlike = 0.9f, kAbove = 0.05f; // [patches' width]
    const Scene& scene = patchHits.trace.scene();
    const std::uint32_t first = surfels.front();
    SurfelCache cache{moved.instance[first], isBack(patchHits.set, first, scene) ? 1U : 0U, 0, {}};
    const auto add = [&](std::uint32_t s, const MeshPoint& point, bool inSight) {
        const WorldPoint p = placeOf(scene, patchHits.set, s, point);
        const float above = kAbove * std::sqrt(moved.area[s]);
        if (cache.count < AtlasTexel::kMaxPoints &&
            glm::dot(p.normal, moved.normal[first]) > kAlike &&
            !(inSight && patchHits.trace.blocked(p.position + above * p.normal,
                                                 moved.position[s] + above * moved.normal[s],
                                                 TraceMask::Static)))
            cache.points[cache.count++] = point;
    };
    std::vector<std::vector<std::uint32_t>> picked;
    for (const std::uint32_t s : surfels)
        picked.push_back(patchHits.picks(s));
    for (const bool inSight : {true, false})
        for (std::size_t k = 0; k < kPicks && (inSight || cache.count == 0); ++k) // in turn
            for (std::size_t i = 0; i < surfels.size(); ++i)
                if (k < picked[i].size())
                    add(surfels[i], patchHits.hits[picked[i][k]].point, inSight);
    if (cache.count == 0)
        cache.points[cache.count++] = {moved.triangle[first], moved.barycentric[first]};
    return cache;
}

} // namespace

SeenPatches findSeenPatches(const TraceScene& trace, const SurfelSet& set,
                            const OwnerTables& owners, const Atlas& atlas, const Caches& caches,
                            const CachePoints& points, std::uint32_t rays,
                            const Progress& progress) {
    SeenPatches result;
    PatchHits patchHits{trace, set, owners, caches, points, rays};
    if (!patchHits.look(progress))
        return result;
    patchHits.sort();
    const std::size_t count = set.surfels.size();
    result.place.resize(count);
    parallelRanges(count, 256, [&](std::size_t first, std::size_t last) {
        for (std::size_t s = first; s < last; ++s)
            result.place[s] =
                patchHits.placeFor(std::uint32_t(s), patchHits.picks(std::uint32_t(s)));
    });
    SurfelSet moved = set;
    moveSurfels(trace.scene(), result.place, moved);
    const SideLookup lookup(trace, atlas);
    connectSurfels(lookup, trace.scene(), atlas.layout, caches, moved.surfels);
    result.cache = moved.surfels.cache;
    result.cacheWeight = moved.surfels.cacheWeight;
    std::vector<float> errors(count);
    parallelRanges(count, 256, [&](std::size_t first, std::size_t last) {
        for (std::size_t s = first; s < last; ++s)
            errors[s] = cacheError(patchHits, moved.surfels, std::uint32_t(s));
    });
    result.surfelCache.assign(count, ~0U);
    for (const ErrorGroup& group :
         largestGroups(patchHits, moved.surfels, errors,
                       std::min(std::size_t(caches.lightmapCount / kCachesPerSurfelCache),
                                freeTexels(atlas.layout, caches).size()))) {
        for (const std::uint32_t s : group.surfels)
            result.surfelCache[s] = std::uint32_t(result.surfelCaches.size());
        result.surfelCaches.push_back(makeSurfelCache(patchHits, moved.surfels, group.surfels));
    }
    result.rays = std::uint64_t(caches.lightmapCount) * rays + lookup.rays();
    for (std::size_t s = 0; s < count; ++s)
        result.rays += patchHits.begin[s] < patchHits.begin[s + 1] ? rays : 0;
    return result;
}

void placeSeen(const Scene& scene, const SeenPatches& seen, SurfelSet& set) {
    moveSurfels(scene, seen.place, set);
    set.surfels.cache = seen.cache;
    set.surfels.cacheWeight = seen.cacheWeight;
}

void moveSurfels(const Scene& scene, const std::vector<MeshPoint>& place, SurfelSet& set) {
    Surfels& s = set.surfels;
    for (std::uint32_t i = 0; i < s.size(); ++i) {
        if (s.triangle[i] == place[i].triangle && s.barycentric[i] == place[i].barycentric)
            continue;
        const WorldPoint point = placeOf(scene, set, i, place[i]);
        s.position[i] = point.position;
        s.normal[i] = point.normal;
        s.triangle[i] = place[i].triangle;
        s.barycentric[i] = place[i].barycentric;
    }
}

void addSurfelCaches(const Scene& scene, const LightmapLayout& layout, const SeenPatches& seen,
                     Surfels& surfels, Caches& caches, CachePoints& points) {
    const std::vector<std::uint32_t> texels = freeTexels(layout, caches);
    const std::uint32_t first = caches.lightmapCount;
    for (std::size_t i = 0; i < seen.surfelCaches.size(); ++i) {
        const SurfelCache& cache = seen.surfelCaches[i];
        addSurfaceCache(scene,
                        {texels[i], cache.instance, cache.back, 0, cache.count, cache.points},
                        caches, points);
    }
    for (std::size_t s = 0; s < surfels.size(); ++s)
        if (seen.surfelCache[s] != ~0U) {
            surfels.cache[s] = glm::uvec4(first + seen.surfelCache[s], ~0U, ~0U, ~0U);
            surfels.cacheWeight[s] = glm::vec4(1, 0, 0, 0);
        }
}

} // namespace limn
