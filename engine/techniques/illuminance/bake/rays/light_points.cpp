// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/rays/light_points.h"

#include "engine/core/parallel.h"
#include "engine/lightmap/texel_points.h"
#include "engine/math/morton.h"
#include "engine/math/sampling.h"
#include "engine/scene/mesh/triangle_geometry.h"
#include "engine/techniques/illuminance/bake/rays/seen_hits.h"
#include "engine/techniques/illuminance/bake/senders/surfel_normals.h"
#include "engine/trace/clear_along.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include <glm/geometric.hpp>

namespace limn {

namespace {

/// One of the rays of a cache; ~0: none.
struct CacheRay {
    std::uint32_t cache = ~0U, ray = 0;
};
using CandidateRays = std::array<CacheRay, kLightCandidates>;

/// Chooses kLightCandidates of the rays that met each surfel by systematic sampling of their
/// weights, one ray several times where there are few.
std::vector<CandidateRays> chooseRays(const GatherHits& hits, const CachePoints& points,
                                      const Caches& caches, std::size_t surfels) {
    const SumsOfSenders sums = sumOverCaches(
        std::uint32_t(caches.size()), std::uint32_t(surfels),
        [&](std::uint32_t begin, std::uint32_t end, std::span<double> sum) {
            forEachSeenHit(hits, points, caches, begin, end,
                           [&](std::uint32_t, std::uint32_t, std::uint32_t sender, double weight) {
                               if (sender < surfels)
                                   sum[sender] += weight;
                           });
        });
    const std::span<const double> all = sums.before(SumsOfSenders::kParts);
    std::vector<CandidateRays> chosen(surfels);
    const auto choose = [&](std::uint32_t part) {
        const std::span<const double> before = sums.before(part);
        std::vector<double> sum(before.begin(), before.end());
        std::vector<std::uint32_t> found(surfels);
        std::vector<float> shift(surfels);
        const auto isChosen = [&](std::uint32_t sender, std::uint32_t k) {
            return k < kLightCandidates && (double(k) + double(shift[sender])) * all[sender] <
                                               sum[sender] * kLightCandidates;
        };
        for (std::uint32_t s = 0; s < surfels; ++s) {
            shift[s] = unitFloat(mixBits(s));
            while (isChosen(s, found[s])) // by the parts before
                ++found[s];
        }
        forEachSeenHit(hits, points, caches, sums.begin(part), sums.begin(part + 1),
                       [&](std::uint32_t c, std::uint32_t r, std::uint32_t sender, double weight) {
                           if (sender >= surfels)
                               return;
                           sum[sender] += weight;
                           for (; isChosen(sender, found[sender]); ++found[sender])
                               chosen[sender][found[sender]] = {c, r};
                       });
    };
    parallelRanges(SumsOfSenders::kParts, 1, [&](std::size_t first, std::size_t last) {
        for (auto part = std::uint32_t(first); part < last; ++part)
            choose(part);
    });
    return chosen;
}

struct LitPoint {
    glm::vec3 position{0}, normal{0};
    std::uint32_t order = 0; ///< along a Morton curve
};

/// Heights above the surface at which walls are looked for: closely above it, where a segment
/// passes below what covers one of its ends, and higher up, where it passes over steps [patches'
/// width].
constexpr std::array<float, 2> kHeights = {0.05f, 0.5f};

/// The centre of a surfel, and that point raised by each of kHeights.
struct SurfelCentre {
    LitPoint point;
    std::array<glm::vec3, kHeights.size()> raised;
};

/// Chooses the light points of one surfel after another. `rays` counts those traced.
struct Finder {
    const TraceScene& trace;
    const Surfels& surfels;
    const RayGatherer& gatherer;
    std::uint64_t rays = 0;

    LitPoint pointOf(const CacheRay& source, const LitPoint& centre, std::uint32_t s);
    glm::vec3 raised(const LitPoint& point, std::uint32_t s, float height);
    bool isOnSameSide(const LitPoint& point, const SurfelCentre& centre, std::uint32_t s);
    std::array<LitPoint, kLightPoints> find(const CandidateRays& chosen, std::uint32_t s);
};

/// Where the ray met the surfel's patch; the surfel's centre where there is no ray.
LitPoint Finder::pointOf(const CacheRay& source, const LitPoint& centre, std::uint32_t s) {
    LitPoint point = centre;
    if (source.cache == ~0U)
        return point;
    ++rays;
    const Hit hit =
        trace.closestHit(gatherer.ray(gatherer.directions(source.cache), source.cache, source.ray),
                         TraceMask::Static);
    if (!hit)
        return point;
    const Scene& scene = trace.scene();
    const Instance& instance = scene.instances[hit.instance];
    point.position = hit.position;
    point.normal =
        (hit.frontFace ? 1.f : -1.f) * shadingNormal(scene.meshOf(instance), instance, hit.triangle,
                                                     {hit.u, hit.v}, hit.geometricNormal);
    const float size = 4 * std::sqrt(surfels.area[s]); // of a box around the patch
    point.order = mortonCode((hit.position - surfels.position[s]) / size + 0.5f);
    return point;
}

/// Raises a point by `height` [patches' width], or by half of what is free above it.
glm::vec3 Finder::raised(const LitPoint& point, std::uint32_t s, float height) {
    ++rays;
    return raise(trace, {point.position, point.normal}, height * std::sqrt(surfels.area[s]))
        .position;
}

/// Whether no wall stands between the point and the surfel's centre.
bool Finder::isOnSameSide(const LitPoint& point, const SurfelCentre& centre, std::uint32_t s) {
    constexpr float kAlike = 0.5f; // cosine of 60 degrees
    for (std::size_t k = 0; k < kHeights.size(); ++k) {
        ++rays;
        if (clearAlong(trace, raised(point, s, kHeights[k]), centre.raised[k], [&](const Hit& hit) {
                return hit.instance == surfels.instance[s] &&
                       std::abs(glm::dot(hit.geometricNormal, centre.point.normal)) > kAlike;
            }))
            return true;
    }
    return false;
}

/// One point of each fourth of the candidates along the curve: a random one or, where that is
/// behind a wall, the next one in this fourth.
std::array<LitPoint, kLightPoints> Finder::find(const CandidateRays& chosen, std::uint32_t s) {
    constexpr std::uint32_t kStratum = kLightCandidates / kLightPoints;
    SurfelCentre centre{{surfels.position[s], vertexNormal(trace.scene(), surfels, s)}, {}};
    for (std::size_t k = 0; k < kHeights.size(); ++k)
        centre.raised[k] = raised(centre.point, s, kHeights[k]);
    std::array<LitPoint, kLightCandidates> found;
    std::ranges::transform(chosen, found.begin(), [&](const CacheRay& source) {
        return pointOf(source, centre.point, s);
    });
    std::ranges::stable_sort(found, {}, &LitPoint::order);
    std::array<LitPoint, kLightPoints> result;
    for (std::uint32_t k = 0; k < kLightPoints; ++k) {
        result[k] = centre.point;
        const std::uint32_t first = mixBits(s * kLightPoints + k);
        for (std::uint32_t i = 0; i < kStratum; ++i) {
            const LitPoint& point = found[k * kStratum + (first + i) % kStratum];
            if (!isOnSameSide(point, centre, s))
                continue;
            result[k] = point;
            break;
        }
    }
    return result;
}

} // namespace

LightPoints findLightPoints(const TraceScene& trace, const Surfels& surfels,
                            const RayGatherer& gatherer, const Caches& caches,
                            const CachePoints& points, const GatherHits& hits,
                            const Progress& progress) {
    const std::vector<CandidateRays> chosen = chooseRays(hits, points, caches, surfels.size());
    LightPoints result;
    result.position.resize(surfels.size() * kLightPoints);
    result.normal.resize(result.position.size());
    std::atomic<std::uint64_t> rays = 0;
    const Progress quiet{.report = {}, .cancel = progress.cancel};
    parallelRanges(surfels.size(), 64, quiet, "trace", [&](std::size_t begin, std::size_t end) {
        Finder finder{trace, surfels, gatherer};
        for (auto s = std::uint32_t(begin); s < end; ++s) {
            const std::array<LitPoint, kLightPoints> found = finder.find(chosen[s], s);
            for (std::uint32_t k = 0; k < kLightPoints; ++k) {
                result.position[s * kLightPoints + k] = found[k].position;
                result.normal[s * kLightPoints + k] = found[k].normal;
            }
        }
        rays += finder.rays;
    });
    result.rays = rays;
    return result;
}

} // namespace limn
