// SPDX-License-Identifier: MIT
#pragma once

#include "engine/picture/final_gather.h"

#include <optional>

namespace limn {

template <GatherSink Sink>
glm::vec3 FinalGather::walkSample(glm::uvec2 pixel, std::uint32_t s, const LightGuide* guide,
                                  const PartWeights& partWeights, Sink& sink) const {
    const PixelSample sample(m_rays, m_options.seed, pixel.y * m_options.width + pixel.x, s);
    const Hit hit = m_trace.closestHit(sample.ray, TraceMask::Seen);
    const std::optional<SurfacePoint> p = hit ? surfacePoint(m_trace, hit) : std::nullopt;
    if (!p || !(m_options.view == View::Irradiance || sink.reflects(hit.instance)))
        return glm::vec3(0);
    const glm::vec3 weight = weightOf(*p);
    PartWeights weights;
    for (std::uint32_t part = 0; part < kGatherParts; ++part)
        weights[part] = partWeights[part] * weight;
    walkGatheredPoint(*m_gather, hit, *p, sample.gather.seed, s, guide, weights, sink);
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
