// SPDX-License-Identifier: MIT
#include "engine/final_lightmap/gather_texels.h"

#include "engine/core/parallel.h"
#include "engine/final_lightmap/fit_input.h"
#include "engine/final_lightmap/texel_lookups.h"
#include "engine/lightmap/plain_lightmap.h"
#include "engine/picture/gather_stages.h"
#include "engine/picture/gathered_light.h"
#include "engine/picture/part_sink.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr std::size_t kMaxHarmonics = kIrradianceBands * kIrradianceBands;

/// Coefficients of the radiance that rays bring, in the two parts that are gathered.
using PartHarmonics = std::array<std::array<glm::vec3, kMaxHarmonics>, kDifferences>;

/// Smallest cosine that irradiance is divided by. Directions are sampled in proportion to it, so
/// that rays along the surface count for much, and have more noise than light.
constexpr float kMinCosine = 0.03f;

/// A sink that adds up harmonics beside irradiance. A ray's irradiance over its cosine is its
/// radiance times its share of the directions. The field's own light at the point is left out.
struct HarmonicSink : PartSink {
    int bands = 1;
    glm::vec3 normal{0};
    PartHarmonics harmonics{};
    glm::vec3 rayDirection{0};
    bool onRay = false;

    void addFrom(glm::vec3 direction, glm::vec3 irradiance, GatherPart part) {
        const float cosine = glm::dot(direction, normal);
        if (bands < 2 || !(cosine > 0))
            return;
        std::array<float, kMaxHarmonics> basis{};
        shBasis(bands, direction, basis.data());
        for (std::size_t i = 0; i < std::size_t(bands * bands); ++i)
            harmonics[part][i] += irradiance * (basis[i] / std::max(cosine, kMinCosine));
    }
    void rayBegins(const EmittedLightSample& sample) {
        PartSink::rayBegins(sample);
        rayDirection = sample.direction;
        onRay = true;
    }
    void rayEnds() {
        PartSink::rayEnds();
        onRay = false;
    }
    void fieldIrradiance(const FieldPoint& point, glm::vec3 weight, GatherPart part) {
        const glm::vec3 light = weight * sampleIrradiance(point);
        add(light, part);
        if (onRay)
            addFrom(rayDirection, light, part);
    }
    void gatheredDirectLight(const SurfacePoint& p, const LightNumbers& numbers, glm::vec3 weight,
                             std::uint32_t via) {
        const glm::vec3 before = sums[Bounced];
        PartSink::gatheredDirectLight(p, numbers, weight, via);
        addFrom(rayDirection, sums[Bounced] - before, Bounced);
    }
    void gatheredEmission(const IncidentLightSample& sample, glm::vec3 light, GatherPart part,
                          std::uint32_t via) {
        PartSink::gatheredEmission(sample, light, part, via);
        addFrom(part == Emitted ? sample.toLight : rayDirection, light, part);
    }
};

/// A surface point of a texel.
struct PointOfTexel {
    Hit hit;
    SurfacePoint surface;
};

struct TexelGather {
    const GatherScene& scene;
    const CutScene& cut;
    const LitTexels& lit;
    const TexelGathering& how;
    GatherStages stages;
    std::size_t coefficients; ///< of harmonics; 0 for irradiance alone

    std::vector<PointOfTexel> pointsOf(std::uint32_t texel) const;
    double meanLight() const;
    GatherSamples take(std::uint32_t texel, const std::vector<PointOfTexel>& points,
                       std::uint32_t begin, std::uint32_t count, const LightGuide* guide,
                       std::vector<RayLight>* learned, PartHarmonics& harmonics) const;
    void subtractField(const std::vector<PointOfTexel>& points, PartHarmonics& mean) const;
};

std::vector<PointOfTexel> TexelGather::pointsOf(std::uint32_t texel) const {
    std::vector<PointOfTexel> points;
    if (lit.open[texel] == Openness::Closed)
        return points;
    const AtlasTexel& t = lit.atlas.texels[texel];
    for (std::uint32_t k = 0; k < t.count; ++k) {
        const Hit hit = hitOf(scene.trace.scene(), cut, lit, {texel, k});
        if (const std::optional<SurfacePoint> p =
                surfacePoint(scene.trace, hit, NormalDetail::Mesh))
            points.push_back({hit, *p});
    }
    return points;
}

/// Mean grey of the field's irradiance over some of the texels.
double TexelGather::meanLight() const {
    constexpr std::size_t kTexels = 4096;
    const std::size_t step = std::max<std::size_t>(lit.open.size() / kTexels, 1);
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t t = 0; t < lit.open.size(); t += step) {
        const Hit hit = hitOf(scene.trace.scene(), cut, lit, {std::uint32_t(t), 0});
        const std::optional<SurfacePoint> p = surfacePoint(scene.trace, hit, NormalDetail::Mesh);
        if (lit.open[t] == Openness::Closed || !p)
            continue;
        sum += greyOf(
            sampleIrradiance(fieldPoint(scene.field, scene.layout, scene.trace.scene(), hit, *p)));
        ++count;
    }
    return count > 0 ? sum / double(count) : 0;
}

GatherSamples TexelGather::take(std::uint32_t texel, const std::vector<PointOfTexel>& points,
                                std::uint32_t begin, std::uint32_t count, const LightGuide* guide,
                                std::vector<RayLight>* learned, PartHarmonics& harmonics) const {
    GatherSamples taken;
    taken.count = count;
    if (points.empty())
        return taken;
    PartWeights weights;
    weights.fill(glm::vec3(1));
    weights[Shown] = glm::vec3(0);
    for (std::uint32_t s = 0; s < count; ++s) {
        const PointOfTexel& p = points[(begin + s) % points.size()];
        HarmonicSink sink{{scene.trace, learned}, int(how.bands), p.surface.normal};
        walkGatheredPoint(scene, p.hit, p.surface, mixBits(how.seed, texel), begin + s, guide,
                          weights, sink);
        taken.weight += glm::dvec3(1);
        const bool half = s < count / 2;
        for (const GatherPart part : {Emitted, Bounced}) {
            taken.parts[part].add(sink.sums[part], half);
            for (std::size_t i = 0; i < coefficients; ++i)
                harmonics[part][i] += sink.harmonics[part][i];
        }
        taken.all.add(sink.sums[Emitted] + sink.sums[Bounced], half);
    }
    return taken;
}

/// Takes the field's coefficients from means of gathered ones: the mean over the points.
void TexelGather::subtractField(const std::vector<PointOfTexel>& points,
                                PartHarmonics& mean) const {
    const float share = 1 / float(points.size());
    for (const PointOfTexel& p : points) {
        const Scene& s = scene.trace.scene();
        const FieldPoint here = fieldPoint(scene.field, scene.layout, s, p.hit, p.surface),
                         emitted = fieldPoint(scene.emitted, scene.layout, s, p.hit, p.surface);
        const auto all = fieldCoefficients(here), direct = fieldCoefficients(emitted);
        for (std::size_t i = 0; i < coefficients; ++i) {
            mean[Emitted][i] -= share * direct[i];
            mean[Bounced][i] -= share * (all[i] - direct[i]);
        }
    }
}

/// The weighted sum of the harmonics of the texels that share noise with one at `place`, as
/// ShrunkDifference has it for irradiance: calls add(number of the place, factor). Harmonics have
/// more noise, so that none is taken from a single texel.
template <class Add>
void addShrunk(const GatheredLight& light, ShrunkDifference shrunk, glm::uvec2 place,
               const Add& add) {
    shrunk.pixelFactor = 0;
    constexpr glm::uvec2 kMiddle = SharingWindow::kMiddle;
    const PixelRect near = windowAround(kMiddle, kNearRadius, SharingWindow::kPlaces);
    sharingWindow(light, place)
        .forEach(kMiddle, kGatherRadius, [&](glm::uvec2 q, std::uint32_t number) {
            add(number, shrunk.factorOf(near.contains(q), q == kMiddle, light.at(place).weight));
        });
}

} // namespace

std::optional<GatheredTexels> gatherTexels(const GatherScene& scene, const CutScene& cut,
                                           const LitTexels& lit, const TexelGathering& how,
                                           const Progress& progress) {
    TexelGather gather{scene,
                       cut,
                       lit,
                       how,
                       {how.samples, scene.raysPerSample, 0},
                       how.bands > 1 ? std::size_t(how.bands) * how.bands : 0};
    gather.stages.meanLight = gather.meanLight();
    const glm::uvec2 size(lit.atlas.layout.width, lit.atlas.layout.height);
    GatheredLight light({{0, 0}, size});
    light.links = lit.links;
    const std::size_t texels = lit.atlas.texels.size(), coefficients = gather.coefficients;
    std::array<std::vector<glm::vec3>, kDifferences> harmonics;
    for (std::vector<glm::vec3>& part : harmonics)
        part.resize(coefficients * texels);
    const glm::uvec2 tiles = (size + kGatherTile - 1U) / kGatherTile;
    std::atomic<std::uint64_t> samples = 0;

    const auto gatherTile = [&](glm::uvec2 corner) {
        GatherTile tile{.x = corner.x,
                        .y = corner.y,
                        .width = std::min(kGatherTile, size.x - corner.x),
                        .height = std::min(kGatherTile, size.y - corner.y)};
        const auto texelOf = [&](std::uint32_t i, std::uint32_t j) {
            return lit.texelAt[std::size_t(corner.y + j) * size.x + corner.x + i];
        };
        std::array<std::vector<PointOfTexel>, kGatherPixels> points;
        for (std::uint32_t j = 0; j < tile.height; ++j)
            for (std::uint32_t i = 0; i < tile.width; ++i)
                if (const std::uint32_t t = texelOf(i, j); t != kNoTexel)
                    points[j * kGatherTile + i] = gather.pointsOf(t);
        std::vector<PartHarmonics> first(kGatherPixels), second(kGatherPixels);
        takeStages(tile, gather.stages,
                   [&](std::uint32_t i, std::uint32_t j, std::uint32_t begin, std::uint32_t count,
                       const LightGuide* guide, std::vector<RayLight>* learned) {
                       const std::uint32_t p = j * kGatherTile + i;
                       return gather.take(texelOf(i, j), points[p], begin, count, guide, learned,
                                          (guide ? second : first)[p]);
                   });
        light.set(tile);
        for (std::uint32_t j = 0; j < tile.height; ++j)
            for (std::uint32_t i = 0; i < tile.width; ++i) {
                const std::uint32_t p = j * kGatherTile + i;
                const GatherSamples &a = tile.firstStage[p], &b = tile.secondStage[p];
                samples += points[p].empty() ? 0 : a.count + b.count;
                if (points[p].empty() || coefficients == 0)
                    continue;
                PartHarmonics mean{};
                for (const GatherPart part : {Emitted, Bounced}) {
                    const double w = tile.secondStageWeight[part][p];
                    for (std::size_t k = 0; k < coefficients; ++k)
                        mean[part][k] =
                            float((1 - w) / a.count) * first[p][part][k] +
                            (b.count > 0 ? float(w / b.count) : 0.f) * second[p][part][k];
                }
                gather.subtractField(points[p], mean);
                for (std::uint32_t part = 0; part < kDifferences; ++part)
                    for (std::size_t k = 0; k < coefficients; ++k)
                        harmonics[part][k * texels + texelOf(i, j)] = mean[part][k];
            }
    };
    const bool done =
        parallelRanges(std::size_t(tiles.x) * tiles.y, 1, progress, "gather",
                       [&](std::size_t begin, std::size_t end) {
                           for (std::size_t t = begin; t < end; ++t)
                               gatherTile(glm::uvec2(t % tiles.x, t / tiles.x) * kGatherTile);
                       });
    if (!done)
        return std::nullopt;

    GatheredTexels result;
    result.samples = samples;
    result.irradiance.resize(texels);
    result.harmonics.resize(coefficients * texels);
    parallelRanges(texels, 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t) {
            if (lit.open[t] == Openness::Closed)
                continue;
            const std::uint32_t number = lit.atlas.texels[t].texel;
            const glm::uvec2 place(number % size.x, number / size.x);
            for (const GatherPart part : {Emitted, Bounced}) {
                const ShrunkDifference shrunk = shrinkDifference(light, part, place);
                result.irradiance[t] += shrunk.lightIn(light.at(place), part);
                if (coefficients == 0)
                    continue;
                addShrunk(light, shrunk, place, [&](std::uint32_t other, glm::vec3 factor) {
                    const std::uint32_t from = lit.texelAt[other];
                    for (std::size_t k = 0; k < coefficients; ++k)
                        result.harmonics[k * texels + t] +=
                            factor * harmonics[part][k * texels + from];
                });
            }
        }
    });
    return result;
}

} // namespace limn
