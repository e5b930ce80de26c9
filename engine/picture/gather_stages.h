// SPDX-License-Identifier: MIT
#pragma once

#include "engine/picture/gather_tile.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace limn {

/// How many samples the pixels of a tile get.
struct GatherStages {
    std::uint32_t firstCount = 0;    ///< samples of a pixel in the first stage, > 1
    std::uint32_t raysPerSample = 0; ///< > 0
    double meanLight = 0;            ///< mean grey of the field's light in the whole picture
};

/// The number of second-stage samples of a pixel whose first-stage samples have this variance. A
/// pixel whose first stage has a standard error of an eighth of the mean light gets as many samples
/// again, and others in proportion. So samples are taken in proportion to standard deviations,
/// which reduces variance most for a given number.
/// Neyman. On the Two Different Aspects of the Representative Method. 1934
std::uint32_t secondStageCount(const GatherStages& stages, double variance);

/// Takes the samples of all pixels of a tile whose place and size are set, in both stages, and
/// weighs them. take(i, j, begin, count, guide, learned) returns samples [begin, begin + count) of
/// pixel (i, j) of the tile; `guide` is null in the first stage, in which it adds the rays to
/// `learned`, which is null in the second.
template <class Take>
void takeStages(GatherTile& tile, const GatherStages& stages, const Take& take) {
    std::array<std::vector<RayLight>, 2> learned; // each by every other pixel
    const std::uint32_t count = stages.firstCount;
    const auto forEachPixel = [&](const auto& body) {
        for (std::uint32_t j = 0; j < tile.height; ++j)
            for (std::uint32_t i = 0; i < tile.width; ++i)
                body(i, j, j * kGatherTile + i);
    };
    forEachPixel([&](std::uint32_t i, std::uint32_t j, std::uint32_t p) {
        tile.firstStage[p] =
            take(i, j, 0U, count, static_cast<const LightGuide*>(nullptr), &learned[(i + j) % 2]);
    });
    tile.guide = learnGuide(learned[0], learned[1]);
    forEachPixel([&](std::uint32_t i, std::uint32_t j, std::uint32_t p) {
        const std::uint32_t more = secondStageCount(stages, varianceAround(tile, i, j));
        tile.secondStage[p] =
            take(i, j, count, more, &tile.guide, static_cast<std::vector<RayLight>*>(nullptr));
    });
    weighStages(tile);
}

} // namespace limn
