// SPDX-License-Identifier: MIT
#include "engine/measure/compare.h"

#include <glm/common.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace limn::compare_test {
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

/// One bit of a pixel's x as +1 or -1. Rows of different bits are orthogonal to each other and to a
/// constant over any multiple of 2^(bit + 1) pixels.
float walsh(std::size_t x, int bit) {
    return (x >> bit & 1) != 0 ? 1.f : -1.f;
}

/// Pictures of mean 1 whose errors and noise are orthogonal, exactly.
struct OrthogonalNoise {
    ImageF test = constantImage(256, 100, glm::vec3(1)), first = test, second = test;

    OrthogonalNoise(float error, float offset, float noise) {
        for (std::size_t i = 0; i < test.rgb.size(); ++i) {
            test.rgb[i] += offset + error * walsh(i, 0);
            first.rgb[i] += noise * walsh(i, 1);
            second.rgb[i] += noise * walsh(i, 2);
        }
    }
};

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

TEST(Compare, TheWorstPercentIsLeftOut) {
    ImageF reference = constantImage(100, 50, glm::vec3(2)), test = reference;
    for (glm::vec3& p : test.rgb)
        p += 0.5f;
    for (std::size_t i = 0; i < 50; ++i) // just what is dropped
        test.rgb[i * 97] = glm::vec3(1000, 2, 2);
    const Result<Comparison> c = compareImages(test, reference);
    ASSERT_TRUE(c);
    EXPECT_NEAR(c->nrmseTrimmed, 0.25, 1e-9);
    EXPECT_NEAR(c->nrmse, std::sqrt(0.99 * 0.25 + 0.01 * 998 * 998 / 3) / 2, 1e-6);
    test.rgb[1] = glm::vec3(1000, 2, 2); // one more stays
    EXPECT_NEAR(compareImages(test, reference)->nrmseTrimmed,
                std::sqrt((4949 * 0.25 + 998.0 * 998 / 3) / 4950) / 2, 1e-6);
    EXPECT_EQ(c->referenceNoise, 0);
}

TEST(Compare, TwoReferencesGiveTheErrorWithoutTheirNoise) {
    const double error = 0.125, offset = 0.03125, noise = 0.5; // sums of these are exact
    const OrthogonalNoise p{float(error), float(offset), float(noise)};
    const Result<Comparison> one = compareImages(p.test, p.first);
    const Result<Comparison> two = compareImages(p.test, p.first, p.second);
    ASSERT_TRUE(one && two);
    const double truth = std::sqrt(error * error + offset * offset);
    EXPECT_NEAR(two->nrmse, truth, 1e-12);
    EXPECT_NEAR(two->bias, offset, 1e-12);
    EXPECT_NEAR(two->referenceNoise, noise / std::sqrt(2), 1e-12);
    EXPECT_NEAR(one->nrmse, std::sqrt(truth * truth + noise * noise), 1e-12);
    // All else is against the mean of both.
    const Result<Comparison> mean = compareImages(p.test, meanImage(p.first, p.second));
    EXPECT_EQ(two->relmse, mean->relmse);
    EXPECT_EQ(two->flip, mean->flip);
    const Result<Comparison> swapped = compareImages(p.test, p.second, p.first);
    EXPECT_EQ(two->nrmse, swapped->nrmse);
    EXPECT_EQ(two->nrmseTrimmed, swapped->nrmseTrimmed);
}

TEST(Compare, TwoReferencesOfRandomNoiseMeetAKnownError) {
    ImageF test = constantImage(256, 256, glm::vec3(1)), first = test, second = test;
    const ImageF a = noiseImage(256, 256, 11), b = noiseImage(256, 256, 12); // mean 1, variance 1
    double truth = 0;
    for (std::size_t i = 0; i < test.rgb.size(); ++i) {
        const float e = 0.25f * std::sin(0.37f * float(i));
        truth += double(e) * double(e) / double(test.rgb.size());
        test.rgb[i] += e;
        first.rgb[i] = a.rgb[i];
        second.rgb[i] = b.rgb[i];
    }
    truth = std::sqrt(truth);
    const Result<Comparison> two = compareImages(test, first, second);
    ASSERT_TRUE(two);
    // The product of both noises has a standard deviation of 1 per channel, that of an error and a
    // noise up to 0.35: the mean over 3 * 65536
    // channels then has one below 0.0024. The derivative of a square is 2 truth.
    EXPECT_NEAR(two->nrmse, truth, 4 * 0.0024 / (2 * truth));
    EXPECT_NEAR(two->referenceNoise, std::sqrt(0.5), 0.01);
    EXPECT_GT(compareImages(test, first)->nrmse, 1);
    EXPECT_GT(compareImages(test, meanImage(first, second))->nrmse, 0.7);
}

TEST(Compare, SaysHowSureItsFiguresAre) {
    // Many pairs of references of normal noise: the spread of what they give is what each says.
    constexpr int kPairs = 60;
    constexpr float kNoise = 0.3f;
    ImageF test = constantImage(64, 64, glm::vec3(1.1f));
    std::mt19937 random(5);
    std::normal_distribution<float> normal(0, kNoise);
    double sum[2] = {}, squares[2] = {}, said[2] = {};
    for (int k = 0; k < kPairs; ++k) {
        ImageF r[2] = {test, test};
        for (ImageF& image : r)
            for (glm::vec3& p : image.rgb)
                p = glm::vec3(1 + normal(random)); // grey: channels share their noise
        const Result<Comparison> c = compareImages(test, r[0], r[1]);
        const double value[2] = {c->nrmse, c->bias}, noise[2] = {c->nrmseNoise, c->biasNoise};
        for (int i = 0; i < 2; ++i) {
            sum[i] += value[i] / kPairs;
            squares[i] += value[i] * value[i] / kPairs;
            said[i] += noise[i] / kPairs;
        }
    }
    for (int i = 0; i < 2; ++i) // a spread of 60 numbers is known to 9 %
        EXPECT_NEAR(std::sqrt(squares[i] - sum[i] * sum[i]) / said[i], 1, 0.27);
    EXPECT_NEAR(said[1], double(kNoise) / std::sqrt(2) / 64, 2e-4);
}

TEST(Compare, NoiseWithoutAnErrorIsNone) {
    OrthogonalNoise p(0, 0, 0.5f);
    EXPECT_EQ(compareImages(p.test, p.first, p.second)->nrmse, 0);
    // Noise that is opposite makes the estimate of the square negative.
    for (std::size_t i = 0; i < p.test.rgb.size(); ++i)
        p.second.rgb[i] = 2.f - p.first.rgb[i];
    const Result<Comparison> c = compareImages(p.test, p.first, p.second);
    EXPECT_EQ(c->nrmse, 0);
    EXPECT_EQ(c->nrmseTrimmed, 0);
    EXPECT_EQ(c->bias, 0);
}

TEST(Compare, BackgroundCountsAsPixelsWithoutAnError) {
    // As with one reference: pixels where nothing is are 0 in all pictures.
    ImageF test = constantImage(10, 10, glm::vec3(0)), first = test;
    for (std::size_t i = 0; i < 50; ++i) {
        first.rgb[i] = glm::vec3(2);
        test.rgb[i] = glm::vec3(3);
    }
    const double expected = std::sqrt(0.5); // rms of half ones, over a mean of 1
    EXPECT_NEAR(compareImages(test, first)->nrmse, expected, 1e-9);
    EXPECT_NEAR(compareImages(test, first, first)->nrmse, expected, 1e-9);
}

TEST(Compare, PixelsThatAreInvalidInEitherReferenceAreLeftOut) {
    OrthogonalNoise p(0.125f, 0, 0.5f);
    p.second.rgb[3].x = std::numeric_limits<float>::quiet_NaN();
    p.first.rgb[4].y = std::numeric_limits<float>::infinity();
    const Result<Comparison> c = compareImages(p.test, p.first, p.second);
    ASSERT_TRUE(c);
    EXPECT_EQ(c->invalidPixels, 2u);
    EXPECT_TRUE(std::isfinite(c->nrmse) && std::isfinite(c->referenceNoise));
    EXPECT_NEAR(c->nrmse, 0.125, 1e-3);
    const Result<Comparison> sizes =
        compareImages(p.test, p.first, constantImage(5, 7, glm::vec3(1)));
    ASSERT_FALSE(sizes);
    EXPECT_NE(sizes.error().message.find("5 x 7"), std::string::npos);
}

TEST(Compare, NoiseLowersSimilarityMoreThanBrightness) {
    const ImageF reference = constantImage(64, 64, glm::vec3(0.5f));
    ImageF noisy = noiseImage(64, 64, 4);
    for (glm::vec3& p : noisy.rgb)
        p = glm::vec3(0.5f) + 0.05f * (p - 1.f);
    EXPECT_GT(compareImages(scaled(reference, 1.1f), reference)->ssim,
              compareImages(noisy, reference)->ssim + 0.1);
}

TEST(Heatmap, ShowsFlipOfEachPixelFromVioletToYellow) {
    ImageF reference = constantImage(64, 32, glm::vec3(0.4f)), test = reference;
    for (std::uint32_t y = 0; y < 32; ++y)
        for (std::uint32_t x = 0; x < 32; ++x)
            test.rgb[y * 64 + x] = {4, 0, 0};
    test.rgb[5 * 64 + 60].y = std::numeric_limits<float>::infinity();
    const Image map = flipHeatmap(test, reference);
    ASSERT_EQ(map.rgba.size(), 64u * 32 * 4);
    const auto pixel = [&](std::size_t x, std::size_t y) { return &map.rgba[4 * (y * 64 + x)]; };
    const std::uint8_t* wrong = pixel(4, 16);
    const std::uint8_t* equal = pixel(60, 30);
    EXPECT_EQ(glm::ivec3(equal[0], equal[1], equal[2]), glm::ivec3(0x44, 0x01, 0x54));
    EXPECT_GT(wrong[1], 120) << "red for grey is far towards yellow";
    EXPECT_EQ(glm::ivec3(pixel(60, 5)[0], pixel(60, 5)[1], pixel(60, 5)[2]),
              glm::ivec3(255, 0, 255));
}

TEST(Heatmap, ShowsTheSquaredErrorOfEachPixelInDecades) {
    const ImageF reference = constantImage(5, 1, glm::vec3(1));
    ImageF test = reference;
    // The denominator is 1 + 0.01.
    for (std::size_t i = 0; i < 4; ++i)
        test.rgb[i] += glm::vec3(float(std::sqrt(1.01 * std::pow(10., -2 * double(i)))));
    test.rgb[4].y = std::numeric_limits<float>::infinity();
    const Image map = squaredErrorHeatmap(test, reference);
    ASSERT_EQ(map.rgba.size(), 20u);
    const auto color = [&](std::size_t i) {
        return glm::ivec3(map.rgba[4 * i], map.rgba[4 * i + 1], map.rgba[4 * i + 2]);
    };
    // Ends and middle of viridis.
    const glm::ivec3 violet(0x44, 0x01, 0x54), green(0x21, 0x91, 0x8c), yellow(0xfd, 0xe7, 0x25);
    const auto difference = [&](std::size_t i, glm::ivec3 c) {
        const glm::ivec3 d = glm::abs(color(i) - c);
        return std::max({d.x, d.y, d.z});
    };
    EXPECT_LE(difference(0, yellow), 2) << "an error of 1";
    EXPECT_LE(difference(1, green), 2) << "an error of 0.01";
    EXPECT_LE(difference(2, violet), 2) << "an error of 0.0001";
    EXPECT_LE(difference(3, violet), 2) << "a smaller one";
    EXPECT_EQ(color(4), glm::ivec3(255, 0, 255)) << "an infinite one";
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

} // namespace limn::compare_test
