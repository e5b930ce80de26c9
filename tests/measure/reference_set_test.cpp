// SPDX-License-Identifier: MIT
#include "engine/measure/reference_set.h"

#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <random>

namespace limn::reference_set_test {
namespace {

using namespace simple;

/// References of a grey 1 with normal noise, independent from part to part.
ReferenceSet noisySet(std::uint32_t width, float noise, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<float> normal(1, noise);
    ReferenceSet set;
    for (ImageF& part : set.parts) {
        part = {width, width, std::vector<glm::vec3>(std::size_t(width) * width)};
        for (glm::vec3& p : part.rgb)
            p = glm::vec3(normal(random));
    }
    return set;
}

TEST(ReferenceSet, TheErrorWithoutTheWorstPercentIsFreeOfNoise) {
    const ReferenceSet set = noisySet(200, 0.5f, 7);
    ImageF test{200, 200, std::vector<glm::vec3>(40000, glm::vec3(1.2f))};
    for (std::size_t i = 0; i < 400; ++i)
        test.rgb[i * 99] = glm::vec3(31); // 1 %: just what is left out
    const Result<Comparison> c = compareImages(test, set);
    ASSERT_TRUE(c);
    // Products of two parts scatter by 0.5^2 + 2 * 0.2 * 0.5: the mean of 40000, by 0.002.
    EXPECT_NEAR(c->nrmseTrimmed, 0.2, 4 * 0.002 / (2 * 0.2));
    EXPECT_NEAR(c->nrmse, std::sqrt(0.99 * 0.04 + 0.01 * 900), 0.01);
    const Result<Comparison> two = compareImages(test, set.first(), set.second());
    EXPECT_EQ(two->nrmse, c->nrmse);
    EXPECT_EQ(two->bias, c->bias);
}

TEST(ReferenceSet, NoiseDoesNotChooseWhatItMeasures) {
    const ReferenceSet set = noisySet(200, 1, 8);
    const ImageF test{200, 200, std::vector<glm::vec3>(40000, glm::vec3(1.2f))}; // an error of 0.2
    // Products of two parts scatter by 1.04: the mean over two halves of 40000, by 0.0037.
    EXPECT_NEAR(compareImages(test, set)->nrmseTrimmed, 0.2, 4 * 0.0037 / (2 * 0.2));
    // Sorted by what is then averaged, the largest noise is what is left out.
    EXPECT_LT(compareImages(test, set.first(), set.second())->nrmseTrimmed, 0.16);
}

TEST(ReferenceSet, RefiningHalvesTheVariance) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(quad({-2, 0, -2}, {0, 0, 4}, {4, 0, 0}));
    b.add(quad({-1, 1, -1}, {0, 0, 2}, {2, 0, 0}));
    b.scene.sky.radiance = glm::vec3(1);
    const TraceScene trace(b.build());
    ReferenceOptions options;
    options.view = View::Irradiance;
    options.camera.eye = {0, 3, 4};
    options.camera.target = {0, 0, 0};
    options.width = 48;
    options.height = 32;
    options.samplesPerPixel = 4;
    float fraction = 0;
    auto set = renderReferenceSet(trace, options, {.report = [&](const char*, float now) {
                                      // Threads that finish at once may report out of order.
                                      EXPECT_GT(now, fraction - 0.2f) << "of all four parts";
                                      fraction = std::max(fraction, now);
                                  }});
    ASSERT_TRUE(set);
    EXPECT_GT(fraction, 0.8f);
    const Comparison before = *compareImages(set->first(), set->first(), set->second());
    ASSERT_TRUE(refine(*set, trace, options));
    EXPECT_EQ(set->samplesPerPixel, 8u);
    EXPECT_EQ(set->passes, 2u);
    const Comparison after = *compareImages(set->first(), set->first(), set->second());
    EXPECT_NEAR(after.referenceNoise / before.referenceNoise, std::sqrt(0.5), 0.07);
    for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t c = 0; c < a; ++c)
            EXPECT_NE(set->parts[a], set->parts[c]);
    const std::atomic<bool> cancel = true;
    EXPECT_FALSE(refine(*set, trace, options, {.report = {}, .cancel = &cancel}));
    EXPECT_EQ(set->samplesPerPixel, 8u);
}

TEST(ReferenceSet, FiguresAreSureWhenTheirErrorsAreAQuarter) {
    Comparison c;
    c.nrmse = 0.4;
    c.bias = -0.2;
    c.nrmseNoise = 0.099;
    c.biasNoise = 0.049;
    EXPECT_TRUE(isSure(c));
    c.nrmseNoise = 0.101;
    EXPECT_FALSE(isSure(c));
    c.nrmseNoise = 0;
    c.biasNoise = 0.051;
    EXPECT_FALSE(isSure(c));
    c.bias = 0; // below 2 % nobody cares how much it is
    c.biasNoise = 0.0049;
    EXPECT_TRUE(isSure(c));
}

} // namespace
} // namespace limn::reference_set_test
