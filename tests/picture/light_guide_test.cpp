// SPDX-License-Identifier: MIT
#include "engine/picture/light_guide.h"

#include "engine/shading/sampler.h"

#include <gtest/gtest.h>

#include <vector>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace limn::light_guide_test {
namespace {

constexpr double kPi = glm::pi<double>();
const glm::vec3 kSun = glm::normalize(glm::vec3(0.3f, 0.9f, 0.2f)),
                kOtherSun = glm::normalize(glm::vec3(-0.7f, 0.6f, 0));

/// Rays that follow the cosine about +Y, which find radiance `of` a direction.
template <class Radiance>
std::vector<RayLight> raysOf(std::uint32_t seed, const Radiance& radiance) {
    std::vector<RayLight> rays;
    for (std::uint32_t k = 0; k < 8192; ++k) {
        const glm::vec3 d = sampleCosineHemisphere({0, 1, 0}, Sampler{seed, k}.pair(0));
        rays.push_back({d, d.y / glm::pi<float>(), radiance(d)});
    }
    return rays;
}
auto patchAt(glm::vec3 sun) {
    return [sun](glm::vec3 d) { return glm::dot(d, sun) > 0.98f ? 100.f : 0.5f; };
}

// The mean of 1 / pdf over samples is the solid angle of the cells with light: each 1/512 of 4 pi.
TEST(LightGuide, InversePdfAveragesToTheSolidAngleOfItsCells) {
    LightGuide guide;
    guide.add({0, 1, 0}, 1);
    guide.add(glm::normalize(glm::vec3(1, 0.2f, 0.1f)), 3);
    guide.add(glm::normalize(glm::vec3(-1, -0.2f, 0.1f)), 0.5f);
    guide.finish(0.5f);
    double solidAngle = 0, first = 0;
    constexpr std::uint32_t kSamples = 1 << 14;
    for (std::uint32_t k = 0; k < kSamples; ++k) {
        const glm::vec3 d = guide.sample(Sampler{1, k}.pair(0));
        ASSERT_NEAR(glm::length(d), 1, 1e-5f);
        ASSERT_GT(guide.pdf(d), 0);
        solidAngle += 1 / double(guide.pdf(d)) / kSamples;
        first += d.x > 0 && d.y < 0.5f ? 1. / kSamples : 0;
    }
    EXPECT_NEAR(solidAngle, 3 * 4 * kPi / 512, 0.02 * solidAngle);
    EXPECT_NEAR(first, 3 / 4.5, 0.01);
    EXPECT_EQ(guide.pdf({0, -1, 0}), 0);
    EXPECT_EQ(guide.probability(), 0.5f);
}

TEST(LearnGuide, AimsAtWhatBothHalvesHaveFound) {
    const LightGuide guide = learnGuide(raysOf(1, patchAt(kSun)), raysOf(2, patchAt(kSun)));
    EXPECT_EQ(guide.probability(), 0.75f);
    EXPECT_GT(guide.pdf(kSun), 10 * guide.pdf(kOtherSun));
}

/// Pixels that are close to a patch of light see it in different directions.
TEST(LearnGuide, DoesNotAimWhereHalvesDisagree) {
    EXPECT_EQ(learnGuide(raysOf(1, patchAt(kSun)), raysOf(2, patchAt(kOtherSun))).probability(), 0);
}

TEST(LearnGuide, DoesNotAimAtWhatFewRaysHaveFound) {
    std::uint32_t ray = 0;
    const auto rare = [&](glm::vec3) { return ray++ % 2048 == 0 ? 1000.f : 0.5f; };
    const std::vector<RayLight> half = raysOf(1, rare), otherHalf = raysOf(2, rare);
    EXPECT_EQ(learnGuide(half, otherHalf).probability(), 0);
}

/// Rays that follow the cosine then have no noise.
TEST(LearnGuide, DoesNotAimWhereLightIsEven) {
    const auto even = [](glm::vec3) { return 2.f; };
    EXPECT_EQ(learnGuide(raysOf(1, even), raysOf(2, even)).probability(), 0);
    const auto dark = [](glm::vec3) { return 0.f; };
    EXPECT_EQ(learnGuide(raysOf(1, dark), raysOf(2, dark)).probability(), 0);
    EXPECT_EQ(learnGuide({}, {}).probability(), 0);
}

} // namespace
} // namespace limn::light_guide_test
