// SPDX-License-Identifier: MIT
#include "engine/scene/exposure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace limn::exposure_test {
namespace {

ImageF pictureOf(std::vector<float> luminances) {
    ImageF image{std::uint32_t(luminances.size()), 1, {}};
    for (const float l : luminances)
        image.rgb.emplace_back(l);
    return image;
}

TEST(Exposure, SunnySixteenIsEv100OfFifteen) {
    // The rule of thumb for full sun: f/16 and a shutter time of 1 / ISO.
    const CameraExposure camera{16, 100};
    EXPECT_NEAR(ev100Of(exposureOfShutter(camera, 0.01f)), 14.64f, 0.01f);
    // A diffuse white of 100 klux has 1e5 / pi nits, just above that camera's white.
    const float white = 1e5f / 3.14159265f * std::exp2(exposureOfShutter(camera, 0.01f));
    EXPECT_GT(white, 1);
    EXPECT_LT(white, 1.2f);
}

TEST(Exposure, ConversionsAreInverse) {
    const CameraExposure camera{2.8f, 400};
    for (const float ev : {-16.f, -1.f, 0.f, 3.5f, 11.f}) {
        EXPECT_NEAR(exposureOfEv100(ev100Of(ev)), ev, 1e-5f);
        EXPECT_NEAR(exposureOfShutter(camera, shutterOf(camera, ev)), ev, 1e-5f);
    }
    // A stop of sensitivity halves the time, one of the aperture doubles it.
    EXPECT_NEAR(shutterOf({2.8f, 800}, 0), shutterOf(camera, 0) / 2, 1e-5f);
    EXPECT_NEAR(shutterOf({5.6f, 400}, 0), shutterOf(camera, 0) * 4, 1e-5f);
}

TEST(Exposure, MeteringPutsAnEvenPictureAtMiddleGrey) {
    for (const float nits : {1e-3f, 0.18f, 7.f, 3e4f}) {
        const auto ev = meteredExposure(pictureOf(std::vector<float>(100, nits)));
        ASSERT_TRUE(ev);
        EXPECT_NEAR(nits * std::exp2(*ev), kMiddleGrey, 1e-4f);
    }
    EXPECT_EQ(meteredExposure(pictureOf({1e30f})), -kMaxExposureEv);
}

TEST(Exposure, MeteringIgnoresLampsBlackAndInvalidPixels) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinite = std::numeric_limits<float>::infinity();
    std::vector<float> pixels(20, 2.f);
    pixels[3] = 1e9f; // a lamp
    pixels.insert(pixels.end(), {0.f, 0.f, 0.f, nan, infinite, -1.f});
    const auto ev = meteredExposure(pictureOf(pixels));
    ASSERT_TRUE(ev);
    EXPECT_NEAR(*ev, std::log2(kMiddleGrey / 2), 1e-5f);
    EXPECT_FALSE(meteredExposure(pictureOf({0, 0, nan})));
    EXPECT_FALSE(meteredExposure({}));
}

} // namespace
} // namespace limn::exposure_test
