// SPDX-License-Identifier: MIT
#include "engine/scene/tone_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace limn::tone_map_test {

TEST(ToneMap, StaysWithinTheDisplayNeverFallsAndKeepsGrey) {
    for (Tonemap curve : {Tonemap::None, Tonemap::Aces, Tonemap::Agx, Tonemap::PbrNeutral}) {
        float last = 0;
        for (float L = 1e-6f; L < 1e12f; L *= 2) {
            const glm::vec3 c = toneMapped(glm::vec3(L), curve);
            EXPECT_TRUE(c.x >= 0 && c.x <= 1 && c.y >= 0 && c.y <= 1 && c.z >= 0 && c.z <= 1);
            EXPECT_NEAR(c.x, c.y, 0.01f);
            EXPECT_GE(c.y, last - 1e-5f) << kTonemapNames[std::size_t(curve)] << " at " << L;
            last = c.y;
        }
        EXPECT_GT(last, 0.95f);
    }
}

TEST(ToneMap, ExposureIsAFactorOfTwoPerStop) {
    const ImageF image{2, 1, {{0.01f, 0.02f, 0.03f}, {0.2f, 0.1f, 0.05f}}};
    ImageF brighter = image;
    for (glm::vec3& p : brighter.rgb)
        p *= 8.f;
    for (Tonemap curve : {Tonemap::None, Tonemap::Aces, Tonemap::Agx, Tonemap::PbrNeutral})
        EXPECT_EQ(toneMappedImage(image, curve, 3).rgba, toneMappedImage(brighter, curve, 0).rgba);
    // 0.5 encodes to 0.7354 of 255.
    EXPECT_EQ(toneMappedImage({1, 1, {glm::vec3(0.25f)}}, Tonemap::None, 1).rgba[0], 188);
}

TEST(ToneMap, InvalidPixelsDoNotSpread) {
    const float inf = std::numeric_limits<float>::infinity();
    for (Tonemap curve : {Tonemap::None, Tonemap::Aces, Tonemap::Agx, Tonemap::PbrNeutral}) {
        const Image image = toneMappedImage(
            {3, 1, {glm::vec3(std::nanf("")), glm::vec3(inf), glm::vec3(0.1f)}}, curve, 0);
        EXPECT_EQ(image.rgba.size(), 12u);
        EXPECT_EQ(image.rgba[3], 255);
        EXPECT_GT(image.rgba[5], 240) << kTonemapNames[std::size_t(curve)];
    }
}

} // namespace limn::tone_map_test
