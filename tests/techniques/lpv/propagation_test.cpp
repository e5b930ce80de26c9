// SPDX-License-Identifier: MIT
#include "engine/techniques/lpv/propagation.h"

#include "engine/core/parallel.h"
#include "engine/math/sh.h"
#include "engine/techniques/lpv/blockers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace limn::propagation_test {
namespace {

constexpr double kPi = std::numbers::pi;

/// What a surface with normal n and flux [W] injects.
Lobe emitted(glm::vec3 n, float flux) {
    const LobeSample sample{.cell = 0, .normal = n, .weight = glm::vec3(flux / float(kPi))};
    return sumByCell({&sample, 1}, 1)[0].lobe;
}

/// Intensity of the first colour towards d, as the two bands give it.
double intensity(const Lobe& lobe, glm::vec3 d) {
    float y[4];
    shBasis(2, glm::normalize(d), y);
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i)
        sum += double(y[i]) * double(lobe[i].x);
    return sum;
}

/// Irradiance of a surface with normal n in a cell of 1 m.
double irradiance(const Lobe& lobe, glm::vec3 n, double g) {
    return g * std::max(0., intensity(lobe, -n));
}

/// Flux that leaves through all faces of the lattice's cells, border excluded.
double fluxOf(const CellLight& light) {
    double sum = 0;
    const glm::ivec3 size(light.cells.size);
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                sum += double(light.lobe({x, y, z})[0].x) * 2 * std::sqrt(kPi);
    return sum;
}

TEST(Propagation, SolidAnglesOfTheFiveFacesAreThoseOfACube) {
    EXPECT_NEAR(double(kFrontSolidAngle), 4 * std::asin(0.1), 1e-7);
    EXPECT_NEAR(6 * (double(kFrontSolidAngle) + 4 * double(kSideSolidAngle)), 4 * kPi, 2e-6);
}

// In the open a round moves flux and loses none, whatever the lobe, unless it is clamped.
TEST(Propagation, KeepsTheFluxOfUnclampedLobes) {
    for (const float tilt : {0.f, 0.2f, 0.45f}) {
        CellLight from(glm::uvec3(5)), to(glm::uvec3(5));
        Lobe lobe{glm::vec3(1), glm::vec3(tilt), glm::vec3(-tilt / 2), glm::vec3(tilt / 3)};
        from.add({2, 2, 2}, lobe);
        propagateOnce(from, nullptr, to);
        EXPECT_NEAR(fluxOf(to) / fluxOf(from), 1, 1e-6) << tilt;
        EXPECT_EQ(to.lobe({2, 2, 2})[0].x, 0) << "light moves on";
        EXPECT_GT(to.lobe({3, 2, 2})[0].x, 0);
    }
}

TEST(Propagation, MovesLightInTheSixDirectionsAlike) {
    CellLight from(glm::uvec3(9)), to(glm::uvec3(9));
    from.add({4, 4, 4}, {glm::vec3(1), glm::vec3(0), glm::vec3(0), glm::vec3(0)});
    for (int round = 0; round < 3; ++round) {
        propagateOnce(from, nullptr, to);
        std::swap(from, to);
    }
    for (int a = 0; a < 3; ++a)
        for (const int sign : {-1, 1}) {
            glm::ivec3 cell(4), first(4);
            cell[a] += 3 * sign;
            first[0] += 3;
            const Lobe lobe = from.lobe(cell), other = from.lobe(first);
            glm::vec3 d(0);
            d[a] = float(sign);
            EXPECT_GT(lobe[0].x, 0);
            EXPECT_NEAR(lobe[0].x, other[0].x, 1e-7f);
            EXPECT_NEAR(intensity(lobe, d), intensity(other, {1, 0, 0}), 1e-7);
            EXPECT_GT(intensity(lobe, d), intensity(lobe, -d)) << "it goes on outwards";
        }
}

// A cosine lobe is 1/4 + cos / 2 in two bands. It is negative towards the five faces of the
// neighbour behind it, and nowhere else; the clamp adds what is missing there.
TEST(Propagation, TheClampAddsAnEighthToTheLobeOfAPlane) {
    CellLight from(glm::uvec3(3)), to(glm::uvec3(3));
    from.add({1, 1, 1}, emitted({0, 0, 1}, 1));
    propagateOnce(from, nullptr, to);
    const double added = (double(kFrontSolidAngle) * (0.5 - 0.25) +
                          4 * double(kSideSolidAngle) * (1 / std::sqrt(5.) - 0.25)) /
                         kPi;
    EXPECT_NEAR(added, 0.138, 5e-4);
    EXPECT_NEAR(fluxOf(to), 1 + added, 1e-6);
}

// Two infinite planes N cells apart, one of radiosity 1; all of it would arrive at the other. The
// numbers were computed for the specification by another program.
TEST(Propagation, DiffusesLightBetweenTwoPlanes) {
    const struct {
        int cells;
        double arrives;
    } kCases[] = {{2, 0.636}, {4, 0.399}, {8, 0.229}, {16, 0.124}, {32, 0.064}};
    for (const auto& [cells, arrives] : kCases) {
        const glm::uvec3 size(1, 1, cells);
        CellLight from(size), to(size);
        from.add({0, 0, 0}, emitted({0, 0, 1}, 1));
        const int last = cells - 1;
        double flux = 0;
        for (int round = 0; round < 10 * cells * cells + 100; ++round) {
            for (std::vector<float>& plane : from.plane) // the neighbours at the sides are alike
                for (int z = 0; z < cells; ++z)
                    for (const glm::ivec3 side : {glm::ivec3(-1, 0, z), glm::ivec3(1, 0, z),
                                                  glm::ivec3(0, -1, z), glm::ivec3(0, 1, z)})
                        plane[from.cells.at(side)] = plane[from.cells.at({0, 0, z})];
            const Lobe top = from.lobe({0, 0, last});
            flux += double(kFrontSolidAngle) * std::max(0., intensity(top, {0, 0, 1}));
            for (const glm::vec3 side :
                 {glm::vec3(1, 0, 2), glm::vec3(-1, 0, 2), glm::vec3(0, 1, 2), glm::vec3(0, -1, 2)})
                flux += double(kSideSolidAngle) * std::max(0., intensity(top, side));
            propagateOnce(from, nullptr, to);
            std::swap(from, to);
        }
        EXPECT_NEAR(flux, arrives, 6e-4) << cells << " cells";
    }
}

/// A room of 16^3 cells whose walls have radiosity 1.
CellLight furnace() {
    constexpr int kSize = 16;
    CellLight light(glm::uvec3{kSize});
    for (int axis = 0; axis < 3; ++axis)
        for (const bool upper : {false, true})
            for (int i = 0; i < kSize * kSize; ++i) {
                glm::ivec3 cell(upper ? kSize - 1 : 0);
                cell[(axis + 1) % 3] = i % kSize;
                cell[(axis + 2) % 3] = i / kSize;
                glm::vec3 n(0);
                n[axis] = upper ? -1 : 1;
                light.add(cell, emitted(n, 1));
            }
    return light;
}

// The truth is 1. The numbers were computed for the specification by another program.
TEST(Propagation, AFurnaceConvergesSlowlyAndIsDarkInItsCorners) {
    const CellLight injected = furnace();
    const double arriving = 2 * kPi / 3;
    const auto centre = [](const CellLight& sum, double g) {
        double mean = 0; // the wall's middle lies between four cells
        for (int i = 0; i < 4; ++i)
            mean += intensity(sum.lobe({7 + i % 2, 7 + i / 2, 0}), {0, 0, -1}) / 4;
        return g * mean;
    };
    EXPECT_NEAR(centre(propagate(injected, nullptr, 8), arriving), 0.221, 6e-4);
    const CellLight converged = propagate(injected, nullptr, 670);
    EXPECT_NEAR(centre(converged, arriving), 0.981, 6e-4);
    EXPECT_NEAR(centre(converged, 4), 1.873, 6e-4);
    EXPECT_NEAR(irradiance(converged.lobe({0, 0, 0}), {0, 0, 1}, arriving), 0.809, 6e-4);
    CellLight once(injected.cells.size);
    propagateOnce(injected, nullptr, once);
    double leaving = fluxOf(once); // and what the walls' cells send out of the room
    const float q = 1 / std::sqrt(5.f);
    for (int axis = 0; axis < 3; ++axis)
        for (const float sign : {-1.f, 1.f})
            for (int i = 0; i < 256; ++i) {
                glm::ivec3 cell(sign > 0 ? 15 : 0);
                cell[(axis + 1) % 3] = i % 16;
                cell[(axis + 2) % 3] = i / 16;
                const Lobe lobe = injected.lobe(cell);
                glm::vec3 d(0);
                d[axis] = sign;
                leaving += double(kFrontSolidAngle) * std::max(0., intensity(lobe, d));
                for (int side = 0; side < 4; ++side) {
                    glm::vec3 towards = 2.f * q * d;
                    towards[(axis + 1 + side % 2) % 3] = side < 2 ? q : -q;
                    leaving += double(kSideSolidAngle) * std::max(0., intensity(lobe, towards));
                }
            }
    EXPECT_NEAR(leaving / fluxOf(injected), 1.111, 6e-4) << "the clamp adds energy";
}

/// A lattice of 5^3 cells of 1 m with a full wall across it at z = 2, in front of which is +z.
FaceBlockers wall(bool twoSided) {
    std::vector<SurfacePiece> pieces;
    for (int i = 0; i < 24 * 24; ++i) // beyond the edge, so that border corners are full, too
        pieces.push_back({.position = glm::vec3(float(i % 24) * 0.25f - 0.375f,
                                                float(i / 24) * 0.25f - 0.375f, 2),
                          .normal = glm::vec3(0, 0, 1),
                          .area = 1 / 16.f,
                          .twoSided = twoSided});
    return blockersOf(pieces, {glm::vec3(0), 1, glm::uvec3(5)});
}

// In two bands a full wall blocks 1/4 + cos / 2: from the front, 3/4 of what meets it head on, and
// 0.697 of what goes on to a face at the side. From behind it blocks nothing.
TEST(Propagation, AFullWallBlocksThreeQuartersHeadOnAndNothingFromBehind) {
    const FaceBlockers blockers = wall(false);
    const auto passed = [&](int from, const Lobe& lobe) {
        CellLight light(glm::uvec3(5)), open(glm::uvec3(5)), blocked(glm::uvec3(5));
        light.add({2, 2, from}, lobe);
        propagateOnce(light, nullptr, open);
        propagateOnce(light, &blockers, blocked);
        const glm::ivec3 beyond(2, 2, from == 2 ? 1 : 2);
        // The first axis belongs to the side faces alone; the mean is of all five.
        struct Shares {
            double all, mean;
        };
        return Shares{double(blocked.lobe(beyond)[2].x) / double(open.lobe(beyond)[2].x),
                      double(blocked.lobe(beyond)[0].x) / double(open.lobe(beyond)[0].x)};
    };
    const Lobe even{glm::vec3(1), glm::vec3(0), glm::vec3(0), glm::vec3(0)};
    const double side = 0.75 - 1 / std::sqrt(5.); // 0.303
    const double front = double(kFrontSolidAngle), sides = 4 * double(kSideSolidAngle);
    const auto [ahead, mean] = passed(2, even);
    EXPECT_NEAR(ahead, 0.25, 1e-5);
    EXPECT_NEAR(mean, (0.25 * front + side * sides) / (front + sides), 1e-5);
    EXPECT_NEAR(side, 0.303, 5e-4);
    EXPECT_NEAR(passed(1, even).mean, 1, 1e-6) << "from behind";
}

TEST(Propagation, AWallWithTwoSidesBlocksHalfInEveryDirection) {
    const FaceBlockers blockers = wall(true);
    CellLight light(glm::uvec3(5)), open(glm::uvec3(5)), blocked(glm::uvec3(5));
    light.add({2, 2, 1}, {glm::vec3(1), glm::vec3(0), glm::vec3(0), glm::vec3(0)});
    propagateOnce(light, nullptr, open);
    propagateOnce(light, &blockers, blocked);
    EXPECT_NEAR(blocked.lobe({2, 2, 2})[0].x / open.lobe({2, 2, 2})[0].x, 0.5, 1e-5);
}

TEST(Propagation, IgnoresBlockersInTheFirstRound) {
    const FaceBlockers blockers = wall(true);
    CellLight light(glm::uvec3(5));
    light.add({2, 2, 2}, emitted({0, 0, 1}, 1));
    const CellLight open = propagate(light, nullptr, 1), blocked = propagate(light, &blockers, 1);
    EXPECT_EQ(open.plane, blocked.plane);
    EXPECT_NE(propagate(light, nullptr, 2).plane, propagate(light, &blockers, 2).plane);
}

TEST(Propagation, IsTheSameForAnyNumberOfThreads) {
    const CellLight injected = furnace();
    const CellLight many = propagate(injected, nullptr, 20);
    const ThreadLimit one(1);
    EXPECT_EQ(propagate(injected, nullptr, 20).plane, many.plane);
}

} // namespace
} // namespace limn::propagation_test
