// SPDX-License-Identifier: MIT
#include "engine/lattice/lattice.h"

#include "engine/lattice/cell_lobes.h"
#include "engine/math/sampling.h"
#include "engine/math/sh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace limn::lattice_test {
namespace {

TEST(Lattice, FillsTheLongestSideAndIsCubicAndCentred) {
    const Bounds box{glm::vec3(-1, 2, 5), glm::vec3(7, 6.5f, 6)};
    const Lattice lattice = latticeOver(box, 16);
    EXPECT_EQ(lattice.size, glm::uvec3(16, 9, 2));
    EXPECT_FLOAT_EQ(lattice.cell, 0.5f);
    EXPECT_EQ(lattice.bounds().lower, box.lower);
    EXPECT_EQ(lattice.bounds().upper, box.upper);
    const Lattice uneven = latticeOver({glm::vec3(0), glm::vec3(10, 3.1f, 0)}, 10);
    EXPECT_EQ(uneven.size, glm::uvec3(10, 4, 2));
    EXPECT_NEAR(uneven.lower.y, -0.45f, 1e-5f) << "half of what it is longer";
    EXPECT_NEAR(uneven.lower.z, -1, 1e-5f) << "a plane lies between two layers";
}

TEST(Lattice, FindsTheCellOfAPointAndTheClosestOutside) {
    const Lattice lattice{glm::vec3(1, 0, 0), 0.5f, glm::uvec3(4, 3, 2)};
    for (std::uint32_t i = 0; i < lattice.cells(); ++i) {
        EXPECT_EQ(lattice.index(lattice.place(i)), i);
        EXPECT_EQ(lattice.at(lattice.centre(lattice.place(i))), lattice.place(i));
    }
    EXPECT_EQ(lattice.at(glm::vec3(-9, 0.6f, 99)), glm::uvec3(0, 1, 1));
    const Lattice corners = cornersOf(lattice);
    EXPECT_EQ(corners.size, glm::uvec3(5, 4, 3));
    EXPECT_EQ(corners.centre(glm::uvec3(0)), lattice.lower);
    EXPECT_EQ(corners.centre(glm::uvec3(4, 3, 2)), lattice.bounds().upper);
}

TEST(Lattice, OfAPointHasCells) {
    const Lattice lattice = latticeOver({glm::vec3(3), glm::vec3(3)}, 8);
    EXPECT_EQ(lattice.cell, 1);
    EXPECT_EQ(lattice.size, glm::uvec3(2));
}

/// Value of a lobe's first colour in a direction.
float valueOf(const Lobe& lobe, glm::vec3 d) {
    float y[4], sum = 0;
    shBasis(2, d, y);
    for (std::size_t i = 0; i < 4; ++i)
        sum += y[i] * lobe[i].x;
    return sum;
}

// (Phi / pi) times a clamped cosine holds the flux Phi; two bands of it are 1/4 + cos / 2.
TEST(CellLobes, AreTwoBandsOfAClampedCosine) {
    const glm::vec3 n = glm::normalize(glm::vec3(1, -2, 3));
    const LobeSample one{.cell = 0, .normal = n, .weight = glm::vec3(1)};
    const auto sums = sumByCell({&one, 1}, 1);
    ASSERT_EQ(sums.size(), 1U);
    const DirectionSet directions(20000, true, 0);
    double flux = 0;
    for (std::uint32_t i = 0; i < directions.count; ++i) {
        const float value = valueOf(sums[0].lobe, directions[i]);
        EXPECT_NEAR(value, 0.25f + 0.5f * glm::dot(n, directions[i]), 1e-6f);
        flux += double(value * directions.solidAngle(i));
    }
    EXPECT_NEAR(flux, std::numbers::pi, 1e-5);
}

TEST(CellLobes, AreSummedByCellInTheOrderOfCells) {
    std::vector<LobeSample> samples;
    const DirectionSet directions(1000, true, 1);
    for (std::uint32_t i = 0; i < directions.count; ++i)
        samples.push_back({mixBits(i) % 7 * 3, directions[i], glm::vec3(float(i), 1, 0)});
    const auto sums = sumByCell(samples, 20);
    ASSERT_EQ(sums.size(), 7U);
    for (std::size_t k = 0; k < sums.size(); ++k) {
        EXPECT_EQ(sums[k].cell, 3 * k);
        glm::dvec3 weight(0), slope(0);
        for (const LobeSample& s : samples)
            if (s.cell == sums[k].cell) {
                weight += glm::dvec3(s.weight);
                slope += glm::dvec3(s.normal) * double(s.weight.x);
            }
        EXPECT_NEAR(sums[k].lobe[0].x, weight.x * std::sqrt(std::numbers::pi) / 2, 1e-6 * weight.x);
        EXPECT_NEAR(sums[k].lobe[1].x, slope.y * std::sqrt(std::numbers::pi / 3), 1e-6 * weight.x);
        EXPECT_NEAR(sums[k].lobe[2].x, slope.z * std::sqrt(std::numbers::pi / 3), 1e-6 * weight.x);
        EXPECT_NEAR(sums[k].lobe[3].x, slope.x * std::sqrt(std::numbers::pi / 3), 1e-6 * weight.x);
    }
    EXPECT_TRUE(sumByCell({}, 20).empty());
    // Few samples in many cells are sorted instead, with the same bits.
    const auto sorted = sumByCell(samples, 1 << 20);
    ASSERT_EQ(sorted.size(), sums.size());
    for (std::size_t k = 0; k < sums.size(); ++k) {
        EXPECT_EQ(sorted[k].cell, sums[k].cell);
        EXPECT_EQ(sorted[k].lobe, sums[k].lobe);
    }
}

} // namespace
} // namespace limn::lattice_test
