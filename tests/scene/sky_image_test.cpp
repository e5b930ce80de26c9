// SPDX-License-Identifier: MIT
#include "engine/scene/sky_image.h"

#include <cmath>
#include <numbers>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace limn::sky_image_test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::uint32_t kBands = 16, kSectors = 16;

/// Noise over three decades, with one pixel as bright as a sun.
ImageF noise(std::uint32_t width, std::uint32_t height) {
    std::mt19937 random(4);
    std::uniform_real_distribution<float> unit(0, 1);
    ImageF image{width, height, std::vector<glm::vec3>(std::size_t(width) * height)};
    for (glm::vec3& p : image.rgb)
        p = {std::pow(10.f, 3 * unit(random)), unit(random), 0.5f};
    image.rgb[image.rgb.size() / 3].y = 5e4f;
    return image;
}

/// Radiance integrated over the sphere: each pixel by its solid angle.
glm::dvec3 flux(const ImageF& image) {
    glm::dvec3 sum(0);
    for (std::uint32_t y = 0; y < image.height; ++y) {
        const double solidAngle =
            2 * kPi / image.width *
            (std::cos(kPi * y / image.height) - std::cos(kPi * (y + 1) / image.height));
        for (std::uint32_t x = 0; x < image.width; ++x)
            sum += solidAngle * glm::dvec3(image.rgb[std::size_t(y) * image.width + x]);
    }
    return sum;
}

TEST(SkyImage, LooksUpTheDirectionsItNames) {
    // Two rows of four columns: the upper half is red 1 to 4 from left to right.
    ImageF image{4, 2, {}};
    for (int i = 0; i < 8; ++i)
        image.rgb.push_back({float(i + 1), 0, 0});
    const auto at = [&](glm::vec3 d, float rotation = 0) {
        return skyRadiance(image, rotation, glm::normalize(d)).x;
    };
    EXPECT_EQ(at({-0.1f, 1, -2}), 2); // left of the middle, above the horizon
    EXPECT_EQ(at({0.1f, 1, -2}), 3);
    EXPECT_EQ(at({2, 1, 0.1f}), 4); // past +X
    EXPECT_EQ(at({0.1f, 1, 2}), 4);
    EXPECT_EQ(at({-0.1f, 1, 2}), 1);
    EXPECT_EQ(at({0.1f, -1, -2}), 7);
    // A quarter turn from +Z towards +X brings what was seen towards -Z to -X.
    EXPECT_EQ(at({-2, 1, 0.1f}, float(kPi / 2)), 2);
    EXPECT_EQ(at({-2, 1, -0.1f}, float(kPi / 2)), 3);
}

TEST(SkyImage, AConstantImageIsAConstantSky) {
    const glm::vec3 L(0.25f, 3, 7e3f);
    for (const std::uint32_t width : {1u, 5u, 64u, 100u})
        for (const float rotation : {0.f, 0.3f, -2.f, 50.f}) {
            const ImageF image{width, 7, std::vector<glm::vec3>(std::size_t(width) * 7, L)};
            for (const glm::vec3 c : skyCellRadiance(skyBands(image, kBands), kSectors, rotation))
                EXPECT_LT(glm::length(c / L - 1.f), 1e-5f);
        }
}

TEST(SkyImage, CellsSendAllThatTheImageSendsHoweverItIsTurned) {
    for (const auto& [width, height] :
         {std::pair(256u, 128u), std::pair(97u, 31u), std::pair(7u, 3u), std::pair(1u, 1u)}) {
        const ImageF image = noise(width, height);
        const SkyBands bands = skyBands(image, kBands);
        for (const float rotation : {0.f, 0.01f, 1.f, -3.f}) {
            glm::dvec3 sum(0);
            for (const glm::vec3 c : skyCellRadiance(bands, kSectors, rotation))
                sum += glm::dvec3(c) * (4 * kPi / (kBands * kSectors));
            EXPECT_LT(glm::length(sum / flux(image) - 1.0), 1e-5) << width << " x " << height;
        }
    }
}

TEST(SkyImage, ATurnByOneSectorMovesTheCellsByOne) {
    const SkyBands bands = skyBands(noise(64, 32), kBands);
    const auto still = skyCellRadiance(bands, kSectors, 0);
    const auto turned = skyCellRadiance(bands, kSectors, float(2 * kPi / kSectors));
    for (std::uint32_t b = 0; b < kBands; ++b)
        for (std::uint32_t s = 0; s < kSectors; ++s)
            EXPECT_LT(
                glm::length(turned[b * kSectors + s] / still[b * kSectors + (s + 1) % kSectors] -
                            1.f),
                1e-3f)
                << b << ", " << s;
}

TEST(SkyImage, ACellIsTheMeanOfTheDirectionsInIt) {
    const ImageF image = noise(50, 20);
    for (const float rotation : {0.f, 0.7f}) {
        const auto cells = skyCellRadiance(skyBands(image, 4), 8, rotation);
        for (std::uint32_t cell = 0; cell < 32; ++cell) {
            constexpr int kSteps = 400;
            glm::dvec3 sum(0);
            for (int y = 0; y < kSteps; ++y)
                for (int x = 0; x < kSteps; ++x) {
                    const double height = (cell / 8 + (y + 0.5) / kSteps) / 4 * 2 - 1;
                    const double angle = ((cell % 8 + (x + 0.5) / kSteps) / 8 - 0.5) * 2 * kPi;
                    const double r = std::sqrt(1 - height * height);
                    sum += glm::dvec3(skyRadiance(
                        image, rotation,
                        {float(r * std::cos(angle)), float(height), float(r * std::sin(angle))}));
                }
            const glm::vec3 mean(sum / double(kSteps * kSteps));
            EXPECT_LT(glm::length(cells[cell] / mean - 1.f), 0.02f) << cell;
        }
    }
}

} // namespace
} // namespace limn::sky_image_test
