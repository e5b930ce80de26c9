// SPDX-License-Identifier: MIT
#include "engine/picture/gathered_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace limn::gathered_light_test {
namespace {

constexpr std::uint32_t kWidth = 40, kHeight = 30;

/// A picture whose pixels' weight, and bounced light without noise, are functions of the pixel.
template <class Weight, class Irradiance>
GatheredLight picture(double noise, const Weight& weight, const Irradiance& irradiance) {
    GatheredLight light({{0, 0}, {kWidth, kHeight}});
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    light.rect.forEach([&](glm::uvec2 pixel) {
        GatheredPixel& p = light.pixels[light.rect.numberOf(pixel)];
        p.weight = weight(pixel);
        const double error = normal(random) * noise;
        p.difference[Bounced] = p.weight * (irradiance(pixel) + float(error));
        const double grey = double(p.weight.x + p.weight.y + p.weight.z) / 3;
        p.variance[Bounced] = float(noise * noise * grey * grey);
    });
    return light;
}

glm::vec3 white(glm::uvec2 /*pixel*/) {
    return glm::vec3(1);
}

/// Root of the mean squared error of the first colour in the pixels that are selected.
template <class Irradiance, class Selects>
double error(const GatheredLight& light, const Irradiance& irradiance, const Selects& selects) {
    ImageF image{kWidth, kHeight, std::vector<glm::vec3>(kWidth * kHeight)};
    addGathered(image, light, light.rect);
    double squared = 0, count = 0;
    light.rect.forEach([&](glm::uvec2 pixel) {
        if (!selects(pixel))
            return;
        const glm::vec3 right = irradiance(pixel) * light.at(pixel).weight;
        squared += std::pow(double(image.rgb[light.rect.numberOf(pixel)].x - right.x), 2);
        ++count;
    });
    return std::sqrt(squared / count);
}
bool all(glm::uvec2 /*pixel*/) {
    return true;
}

TEST(GatheredLight, KeepsAllThatHasNoNoise) {
    const auto steep = [](glm::uvec2 pixel) {
        return glm::vec3(float(pixel.x * pixel.x), float(pixel.y), float((pixel.x ^ pixel.y) & 1));
    };
    EXPECT_LT(error(picture(0, white, steep), steep, all), 1e-3);
}

TEST(GatheredLight, KeepsTheMeanOfWhatIsEvenInNoise) {
    const auto none = [](glm::uvec2) { return glm::vec3(0); };
    EXPECT_LT(error(picture(1, white, none), none, all), 0.25);
    for (const float value : {0.5f, 5.f}) {
        const auto even = [&](glm::uvec2) { return glm::vec3(value); };
        EXPECT_LT(error(picture(1, white, even), even, all), 0.3) << value;
    }
}

/// Where pixels cannot tell a spot from noise, the pixels near them can.
TEST(GatheredLight, KeepsTheMeanOfWhatIsNear) {
    const auto spots = [](glm::uvec2 pixel) {
        return glm::vec3(pixel.x % 12 < 4 && pixel.y % 12 < 4 ? 4 : 0);
    };
    const auto inMiddle = [](glm::uvec2 pixel) {
        return pixel.x % 12 > 0 && pixel.x % 12 < 3 && pixel.y % 12 > 0 && pixel.y % 12 < 3;
    };
    EXPECT_LT(error(picture(1.5, white, spots), spots, inMiddle), 0.75 * 1.5);
}

TEST(GatheredLight, KeepsEdges) {
    const auto edge = [](glm::uvec2 pixel) { return glm::vec3(pixel.x < 20 ? 0 : 10); };
    const GatheredLight light = picture(1, white, edge);
    EXPECT_LT(error(light, edge, [](glm::uvec2 pixel) { return pixel.x == 19 || pixel.x == 20; }),
              1.25);
}

/// Irradiance is what surfaces share. Their albedo, and where there is none, stay sharp.
TEST(GatheredLight, TakesTheMeanOfIrradiance) {
    const auto squares = [](glm::uvec2 pixel) {
        return (pixel.x / 3 + pixel.y / 3) % 2 > 0 ? glm::vec3(0.9f, 0.1f, 0.5f) : glm::vec3(0.05f);
    };
    const auto even = [](glm::uvec2) { return glm::vec3(3); };
    const GatheredLight textured = picture(1, squares, even);
    const auto dark = [](glm::uvec2 pixel) { return (pixel.x / 3 + pixel.y / 3) % 2 == 0; };
    EXPECT_LT(error(textured, even, dark), 0.3 * 0.05);
    EXPECT_LT(error(textured, even, all), 0.3 * 0.9);

    const auto covered = [](glm::uvec2 pixel) { return glm::vec3(pixel.x < 20 ? 1 : 0); };
    const GatheredLight half = picture(1, covered, even);
    EXPECT_EQ(error(half, even, [](glm::uvec2 pixel) { return pixel.x >= 20; }), 0);
    EXPECT_LT(error(half, even, [](glm::uvec2 pixel) { return pixel.x == 19; }), 0.5);
}

/// Links each pixel of a rectangle within that to the next ones.
void linkAll(GatheredLight& light, const PixelRect& rect) {
    light.links.resize(light.pixels.size());
    rect.forEach([&](glm::uvec2 p) {
        SharingLinks& links = light.links[light.rect.numberOf(p)];
        const std::array<bool, 4> inside{p.x + 1 < rect.end.x, p.y + 1 < rect.end.y,
                                         p.x > rect.begin.x, p.y > rect.begin.y};
        for (std::size_t way = 0; way < 4; ++way)
            if (inside[way])
                links.next[way] = std::uint32_t(
                    light.rect.numberOf(glm::uvec2(glm::ivec2(p) + SharingLinks::kSteps[way])));
    });
}

/// Half of a picture may lie elsewhere, and be turned.
TEST(GatheredLight, SharesNoiseAcrossASeam) {
    const auto slope = [](glm::uvec2 pixel) { return glm::vec3(0.3f * float(pixel.x)); };
    const GatheredLight whole = picture(1, white, slope);
    constexpr std::uint32_t kCut = 20;
    GatheredLight halves({{0, 0}, {kCut + kHeight, kHeight}});
    const auto placeOf = [](glm::uvec2 p) {
        return p.x < kCut ? p : glm::uvec2(kCut + kHeight - 1 - p.y, p.x - kCut);
    };
    whole.rect.forEach(
        [&](glm::uvec2 p) { halves.pixels[halves.rect.numberOf(placeOf(p))] = whole.at(p); });
    linkAll(halves, {{0, 0}, {kCut, kHeight}});
    linkAll(halves, {{kCut, 0}, {kCut + kHeight, kWidth - kCut}});
    for (std::uint32_t y = 0; y < kHeight; ++y) {
        const auto a = std::uint32_t(halves.rect.numberOf({kCut - 1, y})),
                   b = std::uint32_t(halves.rect.numberOf(placeOf({kCut, y})));
        halves.links[a].next[0] = b;
        halves.links[a].turn[0] = 1;
        halves.links[b].next[3] = a;
        halves.links[b].turn[3] = 3;
    }
    whole.rect.forEach([&](glm::uvec2 p) {
        const float expected = shrinkDifference(whole, Bounced, p).lightIn(whole.at(p), Bounced).x;
        EXPECT_NEAR(shrinkDifference(halves, Bounced, placeOf(p)).lightIn(whole.at(p), Bounced).x,
                    expected, 1e-4f)
            << p.x << ' ' << p.y;
    });
}

/// A pixel that several links lead to counts once.
TEST(GatheredLight, SharesNoiseWithEachPixelOnce) {
    GatheredLight light({{0, 0}, {5, 5}});
    linkAll(light, {{0, 0}, {4, 5}});
    for (std::uint32_t y = 0; y < 5; ++y)
        light.links[light.rect.numberOf({3, y})].next[0] = 4;
    const SharingWindow window = sharingWindow(light, {3, 2});
    EXPECT_EQ(std::ranges::count(window.pixel, 4U), 1);
    EXPECT_EQ(std::ranges::count(window.pixel, SharingLinks::kNone), 49 - 20 - 1);
}

TEST(GatheredLight, IsTheSumOfPixelsTimesTheirFactors) {
    const auto wavy = [](glm::uvec2 pixel) {
        return 2.f + glm::vec3(std::sin(0.5f * float(pixel.x)), std::cos(float(pixel.y)), 0);
    };
    const auto weight = [](glm::uvec2 pixel) {
        return 0.1f * glm::vec3(float(pixel.x % 3), float(pixel.y % 5), 3);
    };
    const GatheredLight light = picture(0.5, weight, wavy);
    for (const glm::uvec2 pixel : {glm::uvec2(0, 0), glm::uvec2(20, 9), glm::uvec2(39, 29)}) {
        const ShrunkDifference shrunk = shrinkDifference(light, Bounced, pixel);
        glm::vec3 sum(0);
        windowAround(pixel, kGatherRadius, light.rect).forEach([&](glm::uvec2 q) {
            const bool isNear = std::max(std::abs(int(q.x) - int(pixel.x)),
                                         std::abs(int(q.y) - int(pixel.y))) <= int(kNearRadius);
            sum += shrunk.factorOf(isNear, q == pixel, light.at(pixel).weight) *
                   light.at(q).difference[Bounced];
        });
        const glm::vec3 whole = shrunk.lightIn(light.at(pixel), Bounced);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(sum[c], whole[c], 1e-5f);
    }
}

} // namespace
} // namespace limn::gathered_light_test
