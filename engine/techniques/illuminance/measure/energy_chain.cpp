// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/measure/energy_chain.h"

#include "engine/core/parallel.h"
#include "engine/lightmap/atlas.h"
#include "engine/measure/seen_points.h"
#include "engine/picture/emitted_light.h"
#include "engine/shading/direct_light.h"
#include "engine/techniques/illuminance/bake/rays/gather.h"
#include "engine/techniques/illuminance/bake/senders/surfel_normals.h"
#include "engine/techniques/illuminance/relight/caches/cache_light.h"
#include "engine/techniques/illuminance/relight/surfel_material.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr std::uint32_t kGrain = 64; ///< pixels or surfels

using Irradiances = std::vector<glm::vec3>;

double sumOf(glm::vec3 v) {
    return double(v.x) + double(v.y) + double(v.z);
}

/// Upper ends of the ranges of SendersAt.
constexpr std::array<float, 6> kDistances = {
    1 / 16.f, 1 / 4.f, 1, 4, 16, std::numeric_limits<float>::infinity()};

/// Sums over the rays that meet surfels within one range of distances.
struct SenderSums {
    double light = 0, excess = 0, squares = 0;
};
using SumsByDistance = std::array<SenderSums, kDistances.size()>;

struct Chain {
    const TraceScene& trace;
    const EnergyBakes& bakes;
    const EnergyOptions& options;
    const Progress& progress;
    const EmittedLightSources& sources;
    const PathContext paths{trace, sources.emitters, sources.sky};
    std::vector<SeenPoint> seen = {}; ///< pixels that see lamps come last
    std::size_t measured = 0;         ///< number before those, or of all where there are no others
    std::vector<std::uint32_t> cacheOfTexel = {};

    void findSeen();
    glm::vec3 truth(const SurfacePoint& p, std::uint32_t seed, std::uint32_t sample) const;
    template <class Light>
    std::optional<Irradiances> atTexels(const Light& light) const;
    std::optional<Irradiances> truthAtTexels() const;
    std::optional<Irradiances> emittedAtTexels() const;
    std::optional<std::vector<glm::vec4>> trueRadiosity() const;
    std::vector<glm::vec4> emittedRadiosity() const;
    std::optional<std::vector<SendersAt>> sendersAt(const std::vector<glm::vec4>& leaves,
                                                    double truth) const;
    Irradiances gathered(const Bake& bake, const std::vector<glm::vec4>& leaves) const;
    Irradiances relit(const std::shared_ptr<const Bake>& bake) const;
    template <class Visit>
    void forEachStart(std::size_t pixel, std::uint32_t salt, const Visit& visit) const;
    void addSender(const RayGatherer& gatherer, const std::vector<glm::vec4>& leaves,
                   const SurfacePoint& from, std::uint32_t seed, std::uint32_t sample,
                   SumsByDistance& sums) const;
    std::uint32_t pickCache(const Bilinear& lookup, float u) const;
    SurfacePoint pointOf(std::uint32_t cache, float u, SurfacePoint p) const;
};

void Chain::findSeen() {
    const LightmapLayout& layout = bakes.bake->lightmap;
    seen = findSeenPoints(trace, options.camera, options.width, options.height, options.seed);
    std::erase_if(seen,
                  [&](const SeenPoint& p) { return layout.instances[p.hit.instance].uv.empty(); });
    const auto lamps = std::ranges::stable_partition(
        seen, [&](const SeenPoint& p) { return p.surface.emission == glm::vec3(0); });
    measured = seen.size() - lamps.size();
    measured = measured > 0 ? measured : seen.size();
    cacheOfTexel.assign(std::size_t(layout.width) * layout.height, ~0U);
    const Caches& caches = bakes.bake->caches;
    for (std::uint32_t c = 0; c < caches.lightmapCount; ++c)
        cacheOfTexel[caches.texel[c]] = c;
}

glm::vec3 Chain::truth(const SurfacePoint& p, std::uint32_t seed, std::uint32_t sample) const {
    std::uint64_t rays = 0;
    return sampleIndirectIrradiance(paths, p, {seed, sample}, rays);
}

/// Picks one of the lookup's caches in proportion to its weight, or one that fills it; ~0 where
/// there is none.
std::uint32_t Chain::pickCache(const Bilinear& lookup, float u) const {
    const Caches& caches = bakes.bake->caches;
    std::uint32_t cache = ~0U;
    for (int k = 0; k < 4 && u >= 0; ++k)
        if (lookup.weight[k] > 0 && cacheOfTexel[lookup.texel[k]] != ~0U) {
            cache = cacheOfTexel[lookup.texel[k]];
            u -= lookup.weight[k];
        }
    if (cache == ~0U || caches.fillBegin[cache] == caches.fillBegin[cache + 1])
        return cache;
    float rest = -u; // the remainder serves as another random number
    rest -= std::floor(rest);
    for (std::uint32_t i = caches.fillBegin[cache]; i < caches.fillBegin[cache + 1]; ++i)
        if ((rest -= caches.fillWeight[i]) < 0)
            return caches.fillSource[i];
    return caches.fillSource[caches.fillBegin[cache]];
}

/// Picks one of the cache's points, with the pixel's shading normal, since the caches' harmonics
/// give irradiance for any normal. Own caches, which fill some texels, use their middle as the only
/// point.
SurfacePoint Chain::pointOf(std::uint32_t cache, float u, SurfacePoint p) const {
    const CachePoints& points = bakes.senders.lightmap;
    if (cache + 1 >= points.begin.size()) {
        p.position = bakes.bake->caches.position[cache];
        p.geometricNormal = bakes.bake->caches.normal[cache];
        return p;
    }
    const std::uint32_t first = points.begin[cache], count = points.begin[cache + 1] - first,
                        k = first + std::min(std::uint32_t(u * float(count)), count - 1);
    p.position = points.position[k];
    p.geometricNormal = points.normal[k];
    return p;
}

/// Calls visit(point, seed, sample) for each path of a pixel: with a random point of one of the
/// caches that it looks up, and the numbers of a Sampler whose first dimension chose that.
template <class Visit>
void Chain::forEachStart(std::size_t pixel, std::uint32_t salt, const Visit& visit) const {
    const Bilinear lookup = bilinearAt(bakes.bake->lightmap, trace.scene(), seen[pixel].hit);
    const std::uint32_t seed = mixBits(options.seed + salt, std::uint32_t(pixel));
    for (std::uint32_t s = 0; s < options.paths; ++s) {
        const glm::vec2 u = Sampler{seed, s}.pair(0);
        if (const std::uint32_t cache = pickCache(lookup, u.x); cache != ~0U)
            visit(pointOf(cache, u.y, seen[pixel].surface), seed, s);
    }
}

/// Mean of light(point, seed, sample) over the points of the caches that each pixel looks up.
template <class Light>
std::optional<Irradiances> Chain::atTexels(const Light& light) const {
    Irradiances result(seen.size());
    const bool done = parallelRanges(
        seen.size(), kGrain, progress, "texels", [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                forEachStart(i, 17,
                             [&](const SurfacePoint& p, std::uint32_t seed, std::uint32_t sample) {
                                 result[i] += light(p, seed, sample) / float(options.paths);
                             });
        });
    return done ? std::optional(std::move(result)) : std::nullopt;
}

std::optional<Irradiances> Chain::truthAtTexels() const {
    return atTexels([&](const SurfacePoint& p, std::uint32_t seed, std::uint32_t sample) {
        return truth(p, seed, sample);
    });
}

/// Light straight from emissive surfaces at the points of the caches.
std::optional<Irradiances> Chain::emittedAtTexels() const {
    return atTexels([&](const SurfacePoint& p, std::uint32_t seed, std::uint32_t sample) {
        glm::vec3 E(0);
        for (const IncidentLightSample& light :
             sampleEmittedLight(trace, sources, p, {mixBits(seed), sample}).samples)
            if (light.instance != ~0U) // not the sky
                E += light.irradiance;
        return E;
    });
}

/// Mean direct irradiance at the surfel's light points.
glm::vec3 directAt(const TraceScene& trace, const Surfels& s, std::size_t surfel,
                   std::uint64_t& rays) {
    const std::uint32_t each = s.litAtEach();
    glm::vec3 E(0);
    for (std::size_t k = surfel * each; k < (surfel + 1) * each; ++k) {
        SurfacePoint p;
        p.position = s.litAt()[k];
        p.normal = p.geometricNormal = s.litNormals()[k];
        E += directIrradiance(trace, p, rays) / float(each);
    }
    return E;
}

/// Radiosity of the tree's leaves if surfels receive the path-traced light: direct light at their
/// light points, all other light at their places.
std::optional<std::vector<glm::vec4>> Chain::trueRadiosity() const {
    const Bake& bake = *bakes.bake;
    const Surfels& s = bake.surfels;
    std::vector<glm::vec3> albedo, emitted;
    surfelMaterials(s, trace.scene(), albedo, emitted);
    std::vector<glm::vec4> leaves(bake.tree.leaves());
    const bool done = parallelRanges(
        s.size(), kGrain, progress, "surfels", [&](std::size_t begin, std::size_t end) {
            std::uint64_t rays = 0;
            for (std::size_t i = begin; i < end; ++i) {
                SurfacePoint p;
                p.position = s.position[i];
                p.normal = s.normal[i];
                p.geometricNormal = geometricNormal(trace.scene(), s, std::uint32_t(i));
                glm::vec3 E = directAt(trace, s, i, rays);
                for (std::uint32_t k = 0; k < options.paths; ++k)
                    E += truth(p, mixBits(options.seed + 29, std::uint32_t(i)), k) /
                         float(options.paths);
                leaves[i] = withLuma(albedo[i] * E + emitted[i]);
            }
        });
    const std::vector<glm::vec3> sky = skyRadiosity(bake.tree, trace.scene().sky);
    for (std::size_t c = 0; c < sky.size(); ++c)
        leaves[s.size() + c] = withLuma(sky[c]);
    return done ? std::optional(std::move(leaves)) : std::nullopt;
}

/// Radiosity of the tree's leaves by emission alone.
std::vector<glm::vec4> Chain::emittedRadiosity() const {
    std::vector<glm::vec3> albedo, emitted;
    surfelMaterials(bakes.bake->surfels, trace.scene(), albedo, emitted);
    std::vector<glm::vec4> leaves(bakes.bake->tree.leaves());
    std::ranges::transform(emitted, leaves.begin(), [](glm::vec3 e) { return withLuma(e); });
    return leaves;
}

/// Adds what a random ray from `from` meets. `leaves`: of trueRadiosity().
void Chain::addSender(const RayGatherer& gatherer, const std::vector<glm::vec4>& leaves,
                      const SurfacePoint& from, std::uint32_t seed, std::uint32_t sample,
                      SumsByDistance& sums) const {
    const glm::vec3 direction = sampleCosineHemisphere(from.normal, Sampler{seed, sample}.pair(1));
    if (!(glm::dot(direction, from.geometricNormal) > 0))
        return;
    const Hit hit = trace.closestHit(
        {trace.clearOf(from.position, from.geometricNormal), direction}, TraceMask::Static);
    const std::optional<SurfacePoint> met = hit ? surfacePoint(trace, hit) : std::nullopt;
    if (!met)
        return;
    std::uint64_t rays = 0;
    const glm::vec3 E = directIrradiance(trace, *met, rays) + truth(*met, seed, sample);
    const RawHit surfel = gatherer.credit(hit, direction);
    const double light = sumOf(met->albedo * E + std::numbers::pi_v<float> * met->emission),
                 excess = sumOf(glm::vec3(leaves[surfel])) - light;
    const float distance = hit.t / std::sqrt(bakes.bake->surfels.area[surfel]);
    SenderSums& bin =
        sums[std::size_t(std::ranges::upper_bound(kDistances, distance) - kDistances.begin())];
    bin.light += light;
    bin.excess += excess;
    bin.squares += excess * excess;
}

/// Traces one ray for each path of each pixel. `truth`: the reference's irradiance, summed over
/// pixels and colours.
std::optional<std::vector<SendersAt>> Chain::sendersAt(const std::vector<glm::vec4>& leaves,
                                                       double truth) const {
    const BakedSenders& senders = bakes.senders;
    const RayGatherer gatherer(trace, senders.set, bakes.bake->caches, senders.lightmap, 1,
                               senders.owners);
    std::vector<SumsByDistance> blocks((measured + kGrain - 1) / kGrain);
    const auto addPixel = [&](std::size_t i) {
        forEachStart(i, 41, [&](const SurfacePoint& p, std::uint32_t seed, std::uint32_t sample) {
            addSender(gatherer, leaves, p, seed, sample, blocks[i / kGrain]);
        });
    };
    const bool done = parallelRanges(
        blocks.size(), 1, progress, "senders", [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin * kGrain; i < std::min(end * kGrain, measured); ++i)
                addPixel(i);
        });
    if (!done)
        return std::nullopt;
    const double scale = 1 / (double(options.paths) * std::max(truth, 1e-300));
    std::vector<SendersAt> result;
    for (std::size_t k = 0; k < kDistances.size(); ++k) {
        SenderSums sum;
        for (const SumsByDistance& block : blocks) {
            sum.light += block[k].light;
            sum.excess += block[k].excess;
            sum.squares += block[k].squares;
        }
        result.push_back({k > 0 ? kDistances[k - 1] : 0, kDistances[k], sum.light * scale,
                          sum.excess * scale, std::sqrt(sum.squares) * scale});
    }
    return result;
}

Irradiances Chain::gathered(const Bake& bake, const std::vector<glm::vec4>& leaves) const {
    const int bands = std::min(int(bake.settings.bands), kIrradianceBands);
    const auto n = std::size_t(bands * bands);
    std::vector<glm::vec4> radiosity = leaves;
    radiosity.resize(bake.tree.size());
    pullRadiosity(bake.tree, radiosity);
    std::vector<glm::vec3> sh(bake.caches.size() * n);
    const CacheRuns all = runsOf(0, bake.caches.lightmapCount);
    const std::vector<std::uint32_t> ends = allLinks(bake.caches);
    lightCaches(bake.caches, ends, radiosity, {bands, bands}, all, sh,
                firstHalfs(bake.caches, bands));
    continueCaches(bake.caches, bands, all, sh);
    fillInvalidCaches(bake.caches, bands, all, sh);
    IndirectField field;
    field.continues = true;
    field.bands = std::uint32_t(bands);
    field.lightmapWidth = bake.lightmap.width;
    field.lightmapHeight = bake.lightmap.height;
    const std::size_t texels = std::size_t(field.lightmapWidth) * field.lightmapHeight;
    field.lightmap.resize(texels * n);
    for (std::size_t c = 0; c < bake.caches.lightmapCount; ++c)
        for (std::size_t i = 0; i < n; ++i)
            field.lightmap[i * texels + bake.caches.texel[c]] = glm::vec4(sh[c * n + i], 0);
    return lookUpIrradiance(field, bake.lightmap, trace.scene(), seen);
}

Irradiances Chain::relit(const std::shared_ptr<const Bake>& bake) const {
    Relighter relighter(bake);
    for (int call = 0; call < 64; ++call)
        if (relighter.relight(trace.scene(), trace, 64, progress).converged)
            break;
    return lookUpIrradiance(relighter.field(), bake->lightmap, trace.scene(), seen);
}

/// Compares a part of the pixels.
EnergyStep compareStep(std::string name, std::span<const glm::vec3> E,
                       std::span<const glm::vec3> truth) {
    double sum = 0, sumTruth = 0, squares = 0;
    for (std::size_t i = 0; i < E.size(); ++i) {
        const glm::vec3 d = E[i] - truth[i];
        sum += sumOf(E[i]);
        sumTruth += sumOf(truth[i]);
        squares += double(glm::dot(d, d));
    }
    const double values = 3 * double(std::max<std::size_t>(E.size(), 1)), mean = sumTruth / values;
    if (!(mean > 0))
        return {std::move(name), 0, 0};
    return {std::move(name), sum / sumTruth, std::sqrt(squares / values) / mean};
}

} // namespace

EnergyChain measureEnergyChain(const TraceScene& trace, const EnergyBakes& bakes,
                               const EnergyOptions& options, const Progress& progress) {
    const EmittedLightSources sources = findEmittedLightSources(trace);
    Chain chain{trace, bakes, options, progress, sources};
    chain.findSeen();
    EnergyChain result;
    result.pixels = chain.seen.size();
    const auto reference = [&](std::uint32_t seed) {
        return traceIrradiance(chain.paths, chain.seen, options.paths, seed, progress);
    };
    const auto first = reference(options.seed + 1), second = reference(options.seed + 2),
               texels = chain.truthAtTexels(), emitted = chain.emittedAtTexels();
    const auto leaves = chain.trueRadiosity();
    if (!first || !second || !texels || !emitted || !leaves)
        return result;
    Irradiances truth(first->size());
    for (std::size_t i = 0; i < truth.size(); ++i)
        truth[i] = ((*first)[i] + (*second)[i]) / 2.f;
    const auto seen = [&](const Irradiances& E) { return std::span(E).first(chain.measured); };
    const auto lamps = [&](const Irradiances& E) { return std::span(E).subspan(chain.measured); };
    const std::span<const glm::vec3> judged = seen(truth);
    const auto senders = chain.sendersAt(
        *leaves, std::transform_reduce(judged.begin(), judged.end(), 0., std::plus<>(), sumOf));
    if (!senders)
        return result;
    result.senders = *senders;
    result.noise = std::abs(compareStep("", seen(*first), judged).energy - 1);
    result.lamps = chain.seen.size() - chain.measured;
    const auto add = [&](const char* name, const Irradiances& E) {
        result.steps.push_back(compareStep(name, seen(E), judged));
        if (result.lamps > 0)
            result.onLamps.push_back(compareStep(name, lamps(E), lamps(truth)));
    };
    add("reference", *first);
    add("texels", *texels);
    add("surfels", chain.gathered(*bakes.uncut, *leaves));
    add("cut", chain.gathered(*bakes.bake, *leaves));
    add("bounces, uncut", chain.relit(bakes.uncut));
    add("bounces", chain.relit(bakes.bake));
    const Irradiances linked = chain.gathered(*bakes.bake, chain.emittedRadiosity());
    result.emitters = compareStep("emitters", seen(linked), seen(*emitted));
    result.complete = true;
    return result;
}

} // namespace limn
