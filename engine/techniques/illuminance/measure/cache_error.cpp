// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/measure/cache_error.h"

#include "engine/core/parallel.h"
#include "engine/math/sampling.h"
#include "engine/math/sh.h"
#include "engine/shading/direct_light.h"
#include "engine/shading/emitters.h"
#include "engine/shading/surface_point.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr std::uint32_t kSets = 4; ///< number of ray sets, whose spread gives the noise

/// Irradiance at one point from one set of rays, and the share of them that met backs.
struct PointGather {
    glm::vec3 irradiance{0};
    float backs = 0;
};

/// Irradiance that emissive surfaces send to a point directly, sampled at as many of their points
/// as there are rays, because gathering would meet a small lamp only by chance.
glm::vec3 emitterIrradiance(const TraceScene& trace, const Emitters& emitters, glm::vec3 origin,
                            glm::vec3 normal, std::uint32_t rays, std::uint32_t seed) {
    glm::vec3 sum{0};
    const glm::vec3 shift{unitFloat(mixBits(3 * seed)), unitFloat(mixBits(3 * seed + 1)),
                          unitFloat(mixBits(3 * seed + 2))};
    for (std::uint32_t r = 0; r < rays; ++r) {
        const glm::vec3 u = glm::fract(
            shift + glm::vec3(radicalInverse(r, 2), radicalInverse(r, 3), radicalInverse(r, 5)));
        const EmitterSample s =
            sampleEmitter(emitters, trace.scene(), origin, u.z, glm::vec2(u.x, u.y));
        const glm::vec3 way = trace.clearOf(s.position, s.normal) - origin;
        const float distance = glm::length(way);
        const float cosTheta = glm::dot(normal, way) / distance;
        if (s.radiance == glm::vec3(0) || !(cosTheta > 0) || !(s.pdf > 0) ||
            trace.occluded({origin, way / distance, 0, distance}, TraceMask::Static))
            continue;
        sum += s.radiance * (cosTheta / s.pdf / float(rays));
    }
    return sum;
}

PointGather gatherPoint(const TraceScene& trace, const Emitters& emitters, glm::vec3 position,
                        glm::vec3 normal, std::uint32_t rays, std::uint32_t seed) {
    const DirectionSet directions(rays, false, seed);
    const glm::mat3 toWorld = basisAround(normal);
    const glm::vec3 origin = trace.clearOf(position, normal);
    PointGather result;
    glm::vec3 emitted{0};
    std::uint32_t lamps = 0; // rays that met one
    std::uint64_t shadowRays = 0;
    for (std::uint32_t r = 0; r < rays; ++r) {
        const glm::vec3 local = directions[r];
        const Hit hit = trace.closestHit({origin, toWorld * local}, TraceMask::Static);
        const float weight = local.z * directions.solidAngle(r);
        if (!hit) {
            result.irradiance += skyRadiance(trace.scene().sky, toWorld * local) * weight;
            continue;
        }
        const auto p = surfacePoint(trace, hit);
        if (!p) {
            result.backs += 1 / float(rays);
            continue;
        }
        result.irradiance += p->albedo * directIrradiance(trace, *p, shadowRays) * (weight / kPi);
        emitted += p->emission * weight;
        lamps += p->emission != glm::vec3(0);
    }
    if (!emitters.empty() && lamps * 16 < rays)
        emitted = emitterIrradiance(trace, emitters, origin, normal, rays, seed);
    result.irradiance += emitted;
    return result;
}

/// Mean over the cache's points that do not lie in walls; std::nullopt where all do.
struct CacheGather {
    bool valid = false;
    glm::vec3 mean{0}, variance{0}; ///< variance of the mean
};

CacheGather gatherCache(const TraceScene& trace, const Emitters& emitters,
                        const CachePoints& points, std::uint32_t cache, std::uint32_t rays) {
    const std::uint32_t begin = points.begin[cache], end = points.begin[cache + 1];
    const std::uint32_t each = std::max(1U, rays / kSets / (end - begin));
    glm::vec3 sum[kSets] = {};
    std::uint32_t open = 0;
    for (std::uint32_t p = begin; p < end; ++p) {
        PointGather sets[kSets];
        float backs = 0;
        for (std::uint32_t k = 0; k < kSets; ++k) {
            sets[k] = gatherPoint(trace, emitters, points.position[p], points.normal[p], each,
                                  mixBits(p * kSets + k + 1));
            backs += sets[k].backs / kSets;
        }
        if (backs > 0.5f)
            continue;
        ++open;
        for (std::uint32_t k = 0; k < kSets; ++k)
            sum[k] += sets[k].irradiance;
    }
    CacheGather result;
    if (open == 0)
        return result;
    result.valid = true;
    for (const glm::vec3& s : sum)
        result.mean += s / float(open * kSets);
    for (const glm::vec3& s : sum) {
        const glm::vec3 d = s / float(open) - result.mean;
        result.variance += d * d / float(kSets * (kSets - 1));
    }
    return result;
}

} // namespace

CacheReference referenceIrradiance(const TraceScene& trace, const Caches& caches,
                                   const CachePoints& points, std::uint32_t count,
                                   std::uint32_t rays, const Progress& progress) {
    const std::uint32_t stride =
        std::max(1U, (caches.lightmapCount + count - 1) / std::max(count, 1U));
    const std::size_t taken = (caches.lightmapCount + stride - 1) / stride;
    std::vector<CacheGather> gathered(taken);
    const Emitters emitters = findEmitters(trace);
    if (!parallelRanges(taken, 1, progress, "reference", [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                gathered[i] = gatherCache(trace, emitters, points, std::uint32_t(i) * stride, rays);
        }))
        return {};
    CacheReference result;
    double variance = 0, mean = 0;
    for (std::size_t i = 0; i < taken; ++i) {
        const CacheGather& g = gathered[i];
        if (!g.valid)
            continue;
        result.cache.push_back(std::uint32_t(i) * stride);
        result.irradiance.push_back(g.mean);
        variance += double(g.variance.x) + double(g.variance.y) + double(g.variance.z);
        mean += double(g.mean.x) + double(g.mean.y) + double(g.mean.z);
    }
    const double channels = 3 * double(std::max<std::size_t>(result.cache.size(), 1));
    if (mean > 0)
        result.noise = std::sqrt(variance / channels) / (mean / channels);
    return result;
}

glm::vec3 cacheIrradiance(const Caches& caches, int bands, const std::vector<glm::vec3>& sh,
                          std::uint32_t cache) {
    const std::size_t first = std::size_t(cache) * std::size_t(bands * bands);
    return glm::max(
        shIrradiance(std::min(bands, kIrradianceBands), sh.data() + first, caches.normal[cache]),
        glm::vec3(0));
}

CacheError compareCaches(const CacheReference& reference, const Caches& caches, int bands,
                         const std::vector<glm::vec3>& sh) {
    std::vector<double> squared;
    double mean = 0, meanReference = 0;
    for (std::size_t i = 0; i < reference.cache.size(); ++i) {
        const std::uint32_t c = reference.cache[i];
        const glm::vec3 E = cacheIrradiance(caches, bands, sh, c);
        const glm::vec3 truth = reference.irradiance[i], d = E - truth;
        squared.push_back(double(glm::dot(d, d)));
        mean += double(E.x) + double(E.y) + double(E.z);
        meanReference += double(truth.x) + double(truth.y) + double(truth.z);
    }
    CacheError error;
    if (!(meanReference > 0))
        return error;
    std::sort(squared.begin(), squared.end());
    const double channels = 3 * double(squared.size());
    const double scale = meanReference / channels;
    double sum = 0;
    const std::size_t trimmedCount = squared.size() - squared.size() / 100;
    for (std::size_t i = 0; i < squared.size(); ++i) {
        sum += squared[i];
        if (i + 1 == trimmedCount)
            error.nrmseTrimmed = std::sqrt(sum / (3 * double(trimmedCount))) / scale;
    }
    error.nrmse = std::sqrt(sum / channels) / scale;
    error.bias = mean / meanReference - 1;
    return error;
}

} // namespace limn
