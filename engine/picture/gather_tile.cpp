// SPDX-License-Identifier: MIT
#include "engine/picture/gather_tile.h"

#include "engine/shading/surface_point.h"

#include <algorithm>

namespace limn {

/// Upper limit of secondStageEfficiency().
static constexpr double kMaxEfficiency = 100;

double greyOf(glm::vec3 light) {
    return double(channelSum(light)) / 3;
}

void GatherSums::add(glm::vec3 value, bool inFirstHalf) {
    const double g = greyOf(value);
    sum += glm::dvec3(value);
    squared += g * g;
    firstHalf += inFirstHalf ? g : 0;
}

double GatherSums::variance(std::uint32_t count) const {
    if (count < 2)
        return 0;
    const double mean = grey() / count;
    return std::max(squared / count - mean * mean, 0.0) * count / (count - 1);
}

double GatherSums::varianceByHalves(std::uint32_t count) const {
    if (count < 2)
        return 0;
    const std::uint32_t half = count / 2;
    const double difference = firstHalf / half - (grey() - firstHalf) / (count - half);
    return difference * difference / 4;
}

template <class Part>
static double varianceAround(const GatherTile& tile, std::uint32_t i, std::uint32_t j,
                             const Part& partOf) {
    double variance = 0;
    for (const GatherSamples& samples : tile.firstStage)
        variance += partOf(samples).variance(samples.count) / (tile.width * tile.height);
    int pixels = 1;
    for (std::uint32_t y = j - std::min(j, 1U); y <= std::min(j + 1, tile.height - 1); ++y)
        for (std::uint32_t x = i - std::min(i, 1U); x <= std::min(i + 1, tile.width - 1); ++x) {
            const GatherSamples& samples = tile.firstStage[y * kGatherTile + x];
            variance += partOf(samples).variance(samples.count);
            ++pixels;
        }
    return variance / pixels;
}

double varianceAround(const GatherTile& tile, std::uint32_t i, std::uint32_t j) {
    return varianceAround(tile, i, j, [](const GatherSamples& s) { return s.all; });
}

glm::dvec3 GatherTile::meanOf(std::uint32_t p, GatherPart part) const {
    const double w = secondStageWeight[part][p];
    glm::dvec3 mean = (1 - w) / firstStage[p].count * firstStage[p].parts[part].sum;
    if (secondStage[p].count > 0)
        mean += w / secondStage[p].count * secondStage[p].parts[part].sum;
    return mean;
}

/// Ratio of the variance of pixels' means to what it would be if samples were independent. It is
/// below 1 where they are stratified.
static double stratification(const std::array<GatherSamples, kGatherPixels>& samples,
                             GatherPart part) {
    double independent = 0, byHalves = 0;
    for (const GatherSamples& s : samples)
        if (s.count > 0) {
            independent += s.parts[part].variance(s.count) / s.count;
            byHalves += s.parts[part].varianceByHalves(s.count);
        }
    return independent > 0 ? std::min(byHalves / independent, 1.0) : 1;
}

/// The number of first-stage samples that a second-stage sample is worth in a part: the ratio of
/// their variances. The guide makes it more where the part's light comes from few directions, and
/// less where it comes from all.
static double secondStageEfficiency(const GatherTile& tile, GatherPart part) {
    if (part == Shown || !(tile.guide.probability() > 0)) // both stages are sampled alike
        return 1;
    double firstVariance = 0, secondVariance = 0;
    for (std::uint32_t p = 0; p < kGatherPixels; ++p)
        if (tile.secondStage[p].count > 0) {
            firstVariance += tile.firstStage[p].parts[part].variance(tile.firstStage[p].count);
            secondVariance += tile.secondStage[p].parts[part].variance(tile.secondStage[p].count);
        }
    firstVariance *= stratification(tile.firstStage, part);
    secondVariance *= stratification(tile.secondStage, part);
    return secondVariance > 0 ? std::min(firstVariance / secondVariance, kMaxEfficiency) : 1;
}

/// Sets the variance of a difference's means. `efficiency`: secondStageEfficiency().
static void setVariance(GatherTile& tile, GatherPart part, double efficiency) {
    const double ratio = stratification(tile.firstStage, part);
    for (std::uint32_t j = 0; j < tile.height; ++j)
        for (std::uint32_t i = 0; i < tile.width; ++i) {
            const std::uint32_t p = j * kGatherTile + i;
            tile.variance[part][p] =
                ratio *
                varianceAround(tile, i, j, [&](const GatherSamples& s) { return s.parts[part]; }) /
                (tile.firstStage[p].count + efficiency * tile.secondStage[p].count);
        }
}

void weighStages(GatherTile& tile) {
    for (const GatherPart part : {Emitted, Bounced, Shown}) {
        const double efficiency = secondStageEfficiency(tile, part);
        for (std::uint32_t p = 0; p < kGatherPixels; ++p) {
            const double second = efficiency * tile.secondStage[p].count;
            tile.secondStageWeight[part][p] =
                second > 0 ? second / (second + tile.firstStage[p].count) : 0;
        }
        if (part != Shown)
            setVariance(tile, part, efficiency);
    }
}

} // namespace limn
