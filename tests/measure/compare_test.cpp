// SPDX-License-Identifier: MIT
#include "engine/measure/compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

using namespace limn;

namespace {

ImageF constantImage(std::uint32_t width, std::uint32_t height, glm::vec3 color) {
    return {width, height, std::vector<glm::vec3>(std::size_t(width) * height, color)};
}

ImageF noiseImage(std::uint32_t width, std::uint32_t height, unsigned seed) {
    std::mt19937 random(seed);
    std::exponential_distribution<float> value(1);
    ImageF image = constantImage(width, height, {});
    for (glm::vec3& p : image.rgb)
        p = {value(random), value(random), value(random)};
    return image;
}

ImageF scaled(ImageF image, float factor) {
    for (glm::vec3& p : image.rgb)
        p *= factor;
    return image;
}

} // namespace

TEST(Compare, EqualImagesHaveNoError) {
    for (const ImageF& image : {noiseImage(37, 23, 1), constantImage(8, 8, glm::vec3(0)),
                                constantImage(1, 1, glm::vec3(3))}) {
        const Result<Comparison> c = compareImages(image, image);
        ASSERT_TRUE(c);
        EXPECT_EQ(c->nrmse, 0);
        EXPECT_EQ(c->relmse, 0);
        EXPECT_EQ(c->bias, 0);
        EXPECT_NEAR(c->ssim, 1, 1e-6);
        EXPECT_EQ(c->flip, 0);
        EXPECT_EQ(c->invalidPixels, 0u);
    }
}

TEST(Compare, KnownOffsetsGiveClosedForms) {
    const ImageF two = constantImage(10, 10, glm::vec3(2));
    const Result<Comparison> c = compareImages(constantImage(10, 10, {2.5f, 2, 2}), two);
    ASSERT_TRUE(c);
    EXPECT_NEAR(c->nrmse, std::sqrt(0.25 / 3) / 2, 1e-9);
    EXPECT_NEAR(c->bias, 0.5 / 3 / 2, 1e-9);
    EXPECT_NEAR(c->relmse, 0.25 / 3 / (4 + 0.01 * 4), 1e-9);
    EXPECT_GT(c->flip, 0);

    const ImageF noise = noiseImage(32, 32, 2);
    const Result<Comparison> brighter = compareImages(scaled(noise, 1.1f), noise);
    ASSERT_TRUE(brighter);
    EXPECT_NEAR(brighter->bias, 0.1, 1e-6);
    EXPECT_LT(brighter->ssim, 1);
    // Exposure belongs to the pair: scaling both changes nothing.
    const Result<Comparison> both = compareImages(scaled(noise, 110), scaled(noise, 100));
    EXPECT_NEAR(both->nrmse, brighter->nrmse, 1e-6);
    EXPECT_NEAR(both->relmse, brighter->relmse, 1e-6);
    EXPECT_NEAR(both->ssim, brighter->ssim, 1e-5);
    EXPECT_NEAR(both->flip, brighter->flip, 1e-4);
}

TEST(Compare, RelMseLeavesOutTheWorstThousandth) {
    const ImageF reference = constantImage(100, 100, glm::vec3(1));
    ImageF test = reference;
    for (std::size_t i = 0; i < 10; ++i) // 10 of 10000: just what is dropped
        test.rgb[i * 997] = glm::vec3(1e6f);
    EXPECT_EQ(compareImages(test, reference)->relmse, 0);
    test.rgb[5] = glm::vec3(1.1f);
    EXPECT_NEAR(compareImages(test, reference)->relmse, 0.01 / 1.01 / 9990, 1e-9);
}

TEST(Compare, InvalidPixelsAreCountedAndLeftOut) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float inf = std::numeric_limits<float>::infinity();
    ImageF reference = noiseImage(40, 30, 3), test = scaled(reference, 1.1f);
    const double bias = compareImages(test, reference)->bias;
    test.rgb[7].y = nan;
    test.rgb[8].x = inf;
    reference.rgb[9].z = -inf;
    const Result<Comparison> c = compareImages(test, reference);
    ASSERT_TRUE(c);
    EXPECT_EQ(c->invalidPixels, 3u);
    EXPECT_NEAR(c->bias, bias, 1e-6);
    for (double v : {c->nrmse, c->relmse, c->ssim, c->flip})
        EXPECT_TRUE(std::isfinite(v));
    EXPECT_EQ(countInvalidPixels(test), 2u);
    EXPECT_EQ(countInvalidPixels(reference), 1u);
    const Result<Comparison> none =
        compareImages(constantImage(4, 4, glm::vec3(nan)), constantImage(4, 4, glm::vec3(1)));
    ASSERT_TRUE(none);
    EXPECT_EQ(none->invalidPixels, 16u);
    EXPECT_EQ(none->nrmse, 0);
}

TEST(Compare, ABlackReferenceMakesTheErrorInfinite) {
    const Result<Comparison> c =
        compareImages(constantImage(8, 8, glm::vec3(1)), constantImage(8, 8, glm::vec3(0)));
    ASSERT_TRUE(c);
    EXPECT_TRUE(std::isinf(c->nrmse));
    EXPECT_TRUE(std::isinf(c->bias));
    EXPECT_GT(c->flip, 0.5);
}

TEST(Compare, DifferentSizesAreAnErrorThatNamesBoth) {
    const Result<Comparison> c =
        compareImages(constantImage(4, 3, glm::vec3(1)), constantImage(5, 7, glm::vec3(1)));
    ASSERT_FALSE(c);
    EXPECT_NE(c.error().message.find("4 x 3"), std::string::npos);
    EXPECT_NE(c.error().message.find("5 x 7"), std::string::npos);
}

TEST(Compare, NoiseLowersSimilarityMoreThanBrightness) {
    const ImageF reference = constantImage(64, 64, glm::vec3(0.5f));
    ImageF noisy = noiseImage(64, 64, 4);
    for (glm::vec3& p : noisy.rgb)
        p = glm::vec3(0.5f) + 0.05f * (p - 1.f);
    EXPECT_GT(compareImages(scaled(reference, 1.1f), reference)->ssim,
              compareImages(noisy, reference)->ssim + 0.1);
}

TEST(Heatmap, IsBlueWhereTooDarkAndOrangeWhereTooBright) {
    ImageF reference = constantImage(4, 1, glm::vec3(1)), test = reference;
    test.rgb[0] = glm::vec3(0.2f);
    test.rgb[1] = glm::vec3(3);
    test.rgb[3].x = std::numeric_limits<float>::quiet_NaN();
    const Image map = errorHeatmap(test, reference);
    ASSERT_EQ(map.rgba.size(), 16u);
    const auto pixel = [&](std::size_t i) { return &map.rgba[4 * i]; };
    EXPECT_GT(pixel(0)[2], pixel(0)[0] + 50);
    EXPECT_GT(pixel(1)[0], pixel(1)[2] + 50);
    EXPECT_EQ(pixel(2)[0], pixel(2)[2]);
    EXPECT_GT(pixel(2)[0], 240);
    EXPECT_EQ(pixel(3)[1], 0);
    EXPECT_EQ(pixel(3)[0], 255);
}
