// SPDX-License-Identifier: MIT
#include "engine/picture/gather_tile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace limn::gather_tile_test {
namespace {

std::mt19937& random() {
    static std::mt19937 numbers(1);
    return numbers;
}
float uniform() {
    return std::uniform_real_distribution<float>()(random());
}

/// Samples of Emitted whose mean is 1.
template <class Sample>
GatherSamples samplesOf(std::uint32_t count, const Sample& sample) {
    GatherSamples samples;
    samples.count = count;
    for (std::uint32_t s = 0; s < count; ++s)
        samples.parts[Emitted].add(glm::vec3(sample(s)), s < count / 2);
    return samples;
}

/// Means over some tiles whose second stage was guided, so that its variance may be another.
struct Measured {
    double secondStageWeight = 0;
    double variance = 0; ///< as the tiles know it
    double error = 0;    ///< squared
};
template <class First, class Second>
Measured measured(const First& first, const Second& second) {
    constexpr std::uint32_t kTiles = 32;
    Measured mean;
    for (std::uint32_t t = 0; t < kTiles; ++t) {
        GatherTile tile{.width = kGatherTile, .height = kGatherTile};
        tile.guide.add({0, 1, 0}, 1);
        tile.guide.finish(0.5f);
        for (std::uint32_t p = 0; p < kGatherPixels; ++p) {
            tile.firstStage[p] = samplesOf(32, first);
            tile.secondStage[p] = samplesOf(128, second);
        }
        weighStages(tile);
        mean.secondStageWeight += tile.secondStageWeight[Emitted][0] / kTiles;
        for (std::uint32_t p = 0; p < kGatherPixels; ++p) {
            mean.variance += tile.variance[Emitted][p] / (kTiles * kGatherPixels);
            mean.error += std::pow(tile.meanOf(p, Emitted).x - 1, 2) / (kTiles * kGatherPixels);
        }
    }
    return mean;
}

float independent(std::uint32_t /*sample*/) {
    return 2 * uniform();
}
/// One in each sixteenth of the range, in either half of 32 samples.
float stratified(std::uint32_t sample) {
    return (float(sample % 16) + uniform()) / 8;
}

TEST(GatherTile, KnowsItsVariance) {
    const Measured mean = measured(independent, independent);
    EXPECT_NEAR(mean.secondStageWeight, 0.8, 0.02);
    const double expected = 1. / 3 / 160; // variance of one sample over their number
    EXPECT_NEAR(mean.variance, expected, 0.15 * expected);
    EXPECT_NEAR(mean.error, expected, 0.15 * expected);
}

TEST(GatherTile, CountsTheSecondStageByItsVariance) {
    const Measured mean =
        measured(independent, [](std::uint32_t) { return uniform() < 0.05f ? 20.f : 0.f; });
    // 1/3 against 19: a sample of the second stage is worth a fifty-seventh of one of the first.
    EXPECT_NEAR(mean.secondStageWeight, 128. / (128 + 57 * 32), 0.02);
    EXPECT_NEAR(mean.error, mean.variance, 0.15 * mean.variance);
}

/// Few stratified samples have less variance than many independent ones.
TEST(GatherTile, KnowsWhichSamplesAreStratified) {
    const Measured mean = measured(stratified, independent);
    EXPECT_LT(mean.secondStageWeight, 0.1);
    EXPECT_NEAR(mean.error, mean.variance, 0.15 * mean.variance);
    EXPECT_GT(measured(independent, stratified).secondStageWeight, 0.99);
}

} // namespace
} // namespace limn::gather_tile_test
