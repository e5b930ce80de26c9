// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/transport/rounded_links.h"

#include "engine/math/packing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace limn::rounded_links_test {
namespace {

std::vector<Link> randomLinks(std::size_t count) {
    std::mt19937 random(7);
    std::normal_distribution<float> axis;
    std::uniform_real_distribution<float> width(0, 2), exponent(-13, 4);
    std::vector<Link> links(count);
    for (Link& link : links) {
        const glm::vec3 d = glm::normalize(glm::vec3(axis(random), axis(random), axis(random)));
        const Oct16 oct = packOct(d);
        link = {std::uint32_t(random()), oct.x, oct.y, floatToHalf(width(random)),
                floatToHalf(std::exp2(exponent(random)))};
    }
    return links;
}

TEST(RoundedLinks, StayWithinTheStatedErrors) {
    const std::vector<Link> links = randomLinks(20000), rounded = roundLinks(links);
    double bias = 0;
    for (std::size_t k = 0; k < links.size(); ++k) {
        const Link &a = links[k], &b = rounded[k];
        EXPECT_EQ(a.node, b.node);
        const glm::vec3 from = unpackOct(a.octX, a.octY), to = unpackOct(b.octX, b.octY);
        EXPECT_LT(glm::length(from - to), 0.25 * 3.14159 / 180);
        const float t = halfToFloat(a.transport), roundedT = halfToFloat(b.transport);
        EXPECT_LE(std::abs(roundedT - t), t / 256 + 0x1p-22f);
        EXPECT_LE(std::abs(halfToFloat(b.u) - halfToFloat(a.u)), halfToFloat(a.u) / 32 + 0x1p-18f);
        EXPECT_LE(halfToFloat(b.u), 2);
        bias += double(roundedT / t - 1);
    }
    EXPECT_NEAR(bias / double(links.size()), 0, 1e-4) << "no light is made or lost";
}

TEST(RoundedLinks, EndsOfTheRangesStayInside) {
    const std::vector<Link> extremes = {{0, 0x7fff, 0x8001, 0x4000, 0x7bff},
                                        {1, 0x8001, 0x7fff, 0, 0}};
    const std::vector<Link> rounded = roundLinks(extremes);
    EXPECT_LT(rounded[0].transport, 0x7c00) << "not infinity";
    EXPECT_EQ(rounded[0].u, 0x4000);
    EXPECT_GT(std::int16_t(rounded[0].octX), 32000);
    EXPECT_LT(std::int16_t(rounded[0].octY), -32000);
    EXPECT_EQ(rounded[1].transport, 0);
    EXPECT_EQ(rounded[1].u, 0);
}

TEST(RoundedLinks, RoundingAgainChangesNothing) {
    const std::vector<Link> once = roundLinks(randomLinks(1000));
    EXPECT_EQ(roundLinks(once), once);
}

} // namespace
} // namespace limn::rounded_links_test
