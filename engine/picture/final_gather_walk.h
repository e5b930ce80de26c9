// SPDX-License-Identifier: MIT
#pragma once

#include "engine/picture/final_gather.h"

#include <algorithm>
#include <optional>

namespace limn {

/// Minimum distance of a surface at which the field is read, in widths of its texels. Where a ray
/// meets a nearer one, a path continues it, because light from so near varies too much for texels.
inline constexpr float kMinTexels = 4;

/// Limits of such a path, as in a gap between surfaces: the field is read all the same where the
/// product of the albedos after the first hit's is below kMinReflected, and at the last of
/// kMaxGatherBounces.
inline constexpr float kMinReflected = 0.03f;
inline constexpr std::uint32_t kMaxGatherBounces = 64;

template <GatherSink Sink>
void FinalGather::walkBounced(EmittedLightSample met, const Sampler& sampler, glm::vec3 weight,
                              Sink& sink) const {
    const std::uint32_t via = met.hit.instance;
    float reflected = 1;
    for (std::uint32_t bounce = 1; met.point && sink.reflects(met.hit.instance); ++bounce) {
        const glm::vec3 albedo = met.point->albedo;
        weight *= albedo / glm::pi<float>();
        reflected *= bounce > 1 ? std::max({albedo.x, albedo.y, albedo.z}) : 1;
        const Sampler light{mixBits(sampler.seed, kOnLightDimension + bounce), sampler.index};
        sink.gatheredDirectLight(*met.point, {light.pair(0).x, light.pair(1)}, weight, via);
        if (reflected < kMinReflected || bounce == kMaxGatherBounces ||
            !(met.hit.t < kMinTexels * m_widths[met.hit.instance])) {
            sink.fieldIrradiance(pointOf(m_field, met.hit, *met.point), weight, Bounced);
            return;
        }
        met = sampleEmittedLight(m_trace, m_sources, *met.point,
                                 {mixBits(sampler.seed, bounce), sampler.index});
        for (const IncidentLightSample& f : met.samples)
            if (f.irradiance != glm::vec3(0))
                sink.gatheredEmission(f, weight * f.irradiance, Bounced, via);
        weight *= met.weight;
    }
}

template <GatherSink Sink>
glm::vec3 FinalGather::walkSample(glm::uvec2 pixel, std::uint32_t s, const LightGuide* guide,
                                  const PartWeights& partWeights, Sink& sink) const {
    const PixelSample sample(m_rays, m_options.seed, pixel.y * m_options.width + pixel.x, s);
    const Hit hit = m_trace.closestHit(sample.ray);
    const std::optional<SurfacePoint> p = hit ? surfacePoint(m_trace, hit) : std::nullopt;
    if (!p || !(m_options.view == View::Irradiance || sink.reflects(hit.instance)))
        return glm::vec3(0);
    const glm::vec3 weight = weightOf(*p);
    PartWeights weights;
    for (std::uint32_t part = 0; part < kGatherParts; ++part)
        weights[part] = partWeights[part] * weight;
    const FieldPoint here = pointOf(m_field, hit, *p),
                     emittedHere = pointOf(emittedField(), hit, *p);
    if (partWeights[Shown] != glm::vec3(0)) // of the pixel itself alone
        sink.fieldIrradiance(here, weights[Shown], Shown);
    sink.fieldIrradiance(emittedHere, -weights[Emitted], Emitted);
    sink.fieldIrradiance(emittedHere, weights[Bounced], Bounced);
    sink.fieldIrradiance(here, -weights[Bounced], Bounced);
    const std::uint32_t rays = m_options.gatherRays;
    for (std::uint32_t k = 0; k < rays; ++k) {
        const Sampler sampler{sample.gather.seed, s * rays + k};
        const EmittedLightSample light = sampleEmittedLight(m_trace, m_sources, *p, sampler, guide);
        const auto arrives = [&](const IncidentLightSample& f) {
            if (f.irradiance != glm::vec3(0))
                sink.gatheredEmission(f, weights[Emitted] / float(rays) * f.irradiance, Emitted,
                                      f.instance);
        };
        arrives(light.samples[0]);
        arrives(light.samples[1]);
        sink.rayBegins(light);
        arrives(light.samples[2]);
        if (light.weight > 0 && light.hit)
            walkBounced(light, sampler, light.weight / float(rays) * weights[Bounced], sink);
        sink.rayEnds();
    }
    return weight;
}

template <GatherSink Sink>
void FinalGather::walkPixel(const GatherTile& tile, glm::uvec2 pixel,
                            const PartWeights& partWeights, Sink& sink) const {
    if (partWeights == PartWeights{})
        return;
    const std::uint32_t p = (pixel.y - tile.y) * kGatherTile + pixel.x - tile.x,
                        first = tile.firstStage[p].count, second = tile.secondStage[p].count;
    const auto weightsOfOne = [&](bool inSecondStage) {
        PartWeights each;
        for (std::uint32_t part = 0; part < kGatherParts; ++part) {
            const double w = tile.secondStageWeight[part][p];
            each[part] = float(inSecondStage ? w / second : (1 - w) / first) * partWeights[part];
        }
        return each;
    };
    for (std::uint32_t s = 0; s < first; ++s)
        walkSample(pixel, s, nullptr, weightsOfOne(false), sink);
    for (std::uint32_t s = 0; s < second; ++s)
        walkSample(pixel, first + s, &tile.guide, weightsOfOne(true), sink);
}

template <GatherSink Sink>
void FinalGather::walk(std::uint32_t x, std::uint32_t y, Sink& sink) const {
    const PixelRect window = windowAround({x, y}, kGatherRadius, picture()),
                    near = windowAround({x, y}, kNearRadius, picture());
    const glm::uvec2 begin = window.begin / kGatherTile * kGatherTile;
    const auto upTo = [](std::uint32_t end) {
        return (end + kGatherTile - 1) / kGatherTile * kGatherTile;
    };
    GatheredLight light({begin, glm::min({upTo(window.end.x), upTo(window.end.y)}, picture().end)});
    std::vector<GatherTile> tiles;
    for (std::uint32_t j = begin.y; j < light.rect.end.y; j += kGatherTile)
        for (std::uint32_t i = begin.x; i < light.rect.end.x; i += kGatherTile)
            light.set(tiles.emplace_back(tileOf(i, j)));
    std::array<ShrunkDifference, kDifferences> shrunk;
    for (const GatherPart part : {Emitted, Bounced})
        shrunk[part] = shrinkDifference(light, part, {x, y});
    const std::uint32_t columns = (light.rect.end.x - begin.x + kGatherTile - 1) / kGatherTile;
    const glm::vec3 weight = light.at({x, y}).weight;
    window.forEach([&](glm::uvec2 pixel) {
        const bool isNear = near.contains(pixel), isItself = pixel == glm::uvec2(x, y);
        PartWeights partWeights{};
        for (const GatherPart part : {Emitted, Bounced})
            partWeights[part] = shrunk[part].factorOf(isNear, isItself, weight);
        partWeights[Shown] = glm::vec3(isItself ? 1 : 0);
        const glm::uvec2 tile = (pixel - begin) / kGatherTile;
        walkPixel(tiles[tile.y * columns + tile.x], pixel, partWeights, sink);
    });
}

} // namespace limn
