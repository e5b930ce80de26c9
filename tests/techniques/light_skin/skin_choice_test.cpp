// SPDX-License-Identifier: MIT
#include "engine/techniques/light_skin/importance.h"

#include "engine/math/luminance.h"
#include "engine/techniques/light_skin/gather_light.h"
#include "engine/techniques/light_skin/lanes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include <glm/geometric.hpp>

namespace limn::skin_choice_test {
namespace {

/// Lights of random flux on a wavy floor, in two views with holes.
VirtualLights randomLights(std::uint32_t side) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> uniform(0, 1);
    VirtualLights lights;
    lights.rows = side;
    lights.columns = 2 * side;
    for (std::uint32_t column = 0; column < 2 * side; ++column)
        for (std::uint32_t row = 0; row < side; ++row) {
            const float flux = uniform(random);
            if (uniform(random) < 0.2f || column == 3)
                continue;
            const glm::vec3 p(float(column) / float(side), 0.1f * uniform(random),
                              float(row) / float(side));
            lights.add(p, glm::normalize(glm::vec3(uniform(random) - 0.5f, 1, 0.1f)),
                       glm::vec3(flux * flux, 0.5f * flux, 0.1f) / float(side * side),
                       1 / float(side * side), column < side ? 0 : 1, column * side + row);
        }
    return lights;
}

ViewSamples samplesAbove() {
    ViewSamples samples;
    for (int i = 0; i < 9; ++i) {
        samples.position.emplace_back(0.3f * float(i % 3), 1.f, 0.4f * float(i / 3));
        samples.normal.emplace_back(0, -1, 0);
    }
    return samples;
}

TEST(SkinChoice, ImportanceIsTheMeanOverViewSamples) {
    const VirtualLights lights = randomLights(16);
    const ViewSamples samples = samplesAbove();
    constexpr float kNearest = 1.05f;
    const std::vector<float> found = importances(lights, samples, kNearest);
    for (std::size_t i = 0; i < lights.size(); ++i) {
        double sum = 0;
        for (std::size_t v = 0; v < samples.size(); ++v) {
            const glm::dvec3 l(samples.position[v] - lights.positionOf(i));
            const glm::dvec3 d = glm::normalize(l);
            sum += std::max(glm::dot(glm::dvec3(lights.normalOf(i)), d), 0.) *
                   std::max(-glm::dot(glm::dvec3(samples.normal[v]), d), 0.) /
                   std::max(double(kNearest * kNearest), glm::dot(l, l));
        }
        const double expected = sum / double(samples.size()) * double(luminance(lights.fluxOf(i)));
        EXPECT_NEAR(double(found[i]), expected, 1e-5 * expected);
    }
    for (const float importance : importances(lights, {}, kNearest))
        EXPECT_EQ(importance, 0);
}

TEST(SkinChoice, SumsRunDownTheColumnsAndAlongThem) {
    const VirtualLights lights = randomLights(16);
    const std::vector<float> values = fluxLuminances(lights);
    const RasterSums sums(lights, values);
    for (std::uint32_t column = 0; column < lights.columns; ++column) {
        double expected = 0;
        for (std::size_t i = 0; i < lights.size(); ++i)
            if (lights.cell[i] / lights.rows <= column)
                expected += double(values[i]);
        EXPECT_NEAR(sums.upToColumn(column), expected, 1e-12);
    }
    // The square's points fall on each light in proportion to its value.
    constexpr int kSide = 600;
    std::vector<int> hits(lights.size(), 0);
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x)
            ++hits[sums.find({(x + 0.5) / kSide, (y + 0.5) / kSide})];
    for (std::size_t i = 0; i < lights.size(); ++i)
        EXPECT_NEAR(double(hits[i]) / (kSide * kSide), double(values[i]) / sums.total(), 3e-4);
    EXPECT_EQ(sums.find({1, 1}), lights.size() - 1);
}

TEST(SkinChoice, ProbabilitiesSumToOne) {
    const VirtualLights lights = randomLights(16);
    const std::vector<float> important = importances(lights, samplesAbove(), 0.3f);
    // Over all shifts each light is drawn N P times, with weight 1 / (N P): its mean weight is 1.
    std::vector<double> mean(lights.size(), 0);
    constexpr int kSide = 64;
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const ChosenLights chosen = chooseLights(
                lights, important,
                {.count = 60, .defence = 0.2f, .shift = {(x + 0.5) / kSide, (y + 0.5) / kSide}});
            for (std::size_t i = 0; i < chosen.light.size(); ++i)
                mean[chosen.light[i]] += double(chosen.weight[i]) / (kSide * kSide);
        }
    double sum = 0;
    for (const double m : mean)
        sum += m / double(lights.size());
    EXPECT_NEAR(sum, 1, 0.02);
}

GatheringCache cacheAbove() {
    return {.position = {0.7f, 0.9f, 0.4f}, .normal = glm::normalize(glm::vec3(0.2f, -1, 0.1f))};
}

double irradiance(const VirtualLights& lights, const ChosenLights& chosen) {
    return double(
        luminance(gatherLight(gatheringLights(lights, chosen, 1), cacheAbove()).diffuse.light));
}

/// Mean, deviation and rms error of the irradiance over shifts of the points, as shares of that of
/// all lights.
struct Statistics {
    double mean = 0, deviation = 0, error = 0;
};
Statistics overShifts(const VirtualLights& lights, std::uint32_t count, float defence, int shifts) {
    const double truth = irradiance(lights, allLights(lights));
    const std::vector<float> important = importances(lights, samplesAbove(), 0.3f);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(0, 1);
    double sum = 0, squares = 0, errors = 0;
    for (int k = 0; k < shifts; ++k) {
        const glm::dvec2 shift(uniform(random), uniform(random));
        const double e =
            irradiance(lights, chooseLights(lights, important, {count, defence, shift})) / truth;
        sum += e;
        squares += e * e;
        errors += (e - 1) * (e - 1);
    }
    const double mean = sum / shifts;
    return {mean, std::sqrt(std::max(squares / shifts - mean * mean, 0.)),
            std::sqrt(errors / shifts)};
}

TEST(SkinChoice, OfManyShiftsHasTheMeanOfAllLights) {
    const VirtualLights lights = randomLights(32);
    for (const float defence : {0.1f, 0.5f, 1.f}) {
        const Statistics s = overShifts(lights, 64, defence, 1000);
        std::printf("defence %g: mean %.5f, deviation %.4f\n", double(defence), s.mean,
                    s.deviation);
        EXPECT_NEAR(s.mean, 1, 3 * s.deviation / std::sqrt(1000.));
        EXPECT_GT(s.deviation, 0);
    }
}

TEST(SkinChoice, ErrsLessWithMoreLights) {
    const VirtualLights lights = randomLights(48);
    std::vector<double> errors;
    for (const std::uint32_t count : {32U, 128U, 512U}) {
        errors.push_back(overShifts(lights, count, 0.1f, 200).error);
        std::printf("N = %u: rms error %.5f\n", count, errors.back());
    }
    // Random draws err as N^-1/2; these points do no worse.
    EXPECT_LT(errors[1], 0.6 * errors[0]);
    EXPECT_LT(errors[2], 0.6 * errors[1]);
}

TEST(SkinChoice, OfNothingImportantIsDarkOrByFlux) {
    const VirtualLights lights = randomLights(16);
    const std::vector<float> none(lights.size(), 0.f);
    EXPECT_TRUE(chooseLights(lights, none, {.count = 50, .defence = 0}).light.empty());
    const ChosenLights byFlux = chooseLights(lights, none, {.count = 50, .defence = 0.1f});
    EXPECT_FALSE(byFlux.light.empty());
    for (const float weight : byFlux.weight)
        EXPECT_TRUE(std::isfinite(weight) && weight > 0);
    VirtualLights black = lights;
    for (auto& flux : black.flux)
        std::ranges::fill(flux, 0.f);
    EXPECT_TRUE(chooseLights(black, none, {.count = 50}).light.empty());
    EXPECT_TRUE(chooseLights({}, {}, {.count = 50}).light.empty());
}

TEST(SkinChoice, OfMoreThanThereAreTakesAll) {
    const VirtualLights lights = randomLights(8);
    const ChosenLights chosen = chooseLights(lights, importances(lights, samplesAbove(), 0.3f),
                                             {.count = std::uint32_t(lights.size())});
    EXPECT_EQ(chosen.light, allLights(lights).light);
    EXPECT_EQ(chosen.weight, allLights(lights).weight);
}

TEST(SkinChoice, PowersOfLobesAreExact) {
    for (const float exponent : {0.5f, 1.7f, 25.f, 250.f})
        for (float x = 0; x <= 1.00001f; x += 0.0037f) {
            const float found = powerOf(Lanes{} + x, exponent)[2];
            const double expected = std::pow(double(x), double(exponent));
            EXPECT_NEAR(double(found), expected, 3e-7 * (1 + double(exponent)) * expected + 1e-37)
                << x << " to the " << exponent;
        }
}

} // namespace
} // namespace limn::skin_choice_test
