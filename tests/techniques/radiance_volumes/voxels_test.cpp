// SPDX-License-Identifier: MIT
#include "engine/techniques/radiance_volumes/voxels.h"

#include "engine/math/sampling.h"
#include "engine/techniques/radiance_volumes/shadow_cone.h"
#include "engine/techniques/radiance_volumes/shown_voxels.h"
#include "engine/trace/trace_scene.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

namespace limn::voxels_test {
namespace {

/// A volume of `side` voxels along a side, solid where `solid` says so.
template <class Solid>
VoxelVolume volumeOf(std::uint32_t side, const Solid& solid) {
    VoxelVolume volume;
    volume.lattice.size = glm::uvec3(side);
    volume.solid = CellBits(volume.lattice.cells());
    for (std::uint32_t c = 0; c < volume.lattice.cells(); ++c)
        if (solid(glm::ivec3(volume.lattice.place(c))))
            volume.solid.words[c / 64] |= std::uint64_t(1) << (c % 64);
    averageVoxels(volume);
    return volume;
}

Scene ballInARoom() {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::box(glm::vec3(-2, -1.4f, -1.8f), glm::vec3(2, 1.5f, 1.7f), true));
    b.add(simple::sphere(0.7f, 3, false));
    return b.build();
}

TEST(Voxels, HoldEverySurfacePointAndNothingFarFromThem) {
    const Scene scene = ballInARoom();
    const TraceScene trace(scene);
    const VoxelVolume volume = voxelsOf(scene, 64);
    const DirectionSet directions(10000, true, 1);
    for (std::uint32_t i = 0; i < directions.count; ++i) {
        const glm::vec3 from = glm::vec3(1.2f, 0.9f, -1.1f) * (i % 2 == 0 ? 1.f : -1.f);
        const Hit hit = trace.closestHit({from, directions[i]});
        ASSERT_TRUE(hit);
        EXPECT_TRUE(volume.solid.test(volume.lattice.index(volume.lattice.at(hit.position))));
    }
    // Two voxels off any surface: the ball's distance is |p| - 0.7, the walls' is along axes.
    std::size_t empty = 0;
    for (std::uint32_t c = 0; c < volume.lattice.cells(); ++c) {
        const glm::vec3 p = volume.lattice.centre(volume.lattice.place(c));
        const glm::vec3 below = p - scene.bounds.lower, above = scene.bounds.upper - p;
        const float wall = std::min({std::abs(below.x), std::abs(below.y), std::abs(below.z),
                                     std::abs(above.x), std::abs(above.y), std::abs(above.z)});
        // The triangles of the ball lie up to 0.02 within the sphere.
        const float ball = std::abs(glm::length(p) - 0.69f) - 0.01f;
        if (std::min(wall, ball) < 2 * volume.lattice.cell)
            continue;
        ++empty;
        EXPECT_FALSE(volume.solid.test(c));
    }
    EXPECT_GT(empty, 10000U);
}

TEST(Voxels, KeepTheShareOfTheirParts) {
    const VoxelVolume volume = voxelsOf(ballInARoom(), 64);
    ASSERT_EQ(volume.levels(), 7U);
    for (std::uint32_t k = 1; k < volume.levels(); ++k) {
        double sum = 0;
        for (const std::uint32_t cell : volume.coarse[k - 1]) {
            sum += opacityByte(cell, kMeanOpacity) / 255.;
            for (int axis = 0; axis < 3; ++axis)
                EXPECT_GE(opacityByte(cell, axis) + k, opacityByte(cell, kMeanOpacity))
                    << "what lies behind each other hides no more than what lies beside it";
        }
        const double full = double(volume.solid.count()) / std::pow(8., k);
        EXPECT_NEAR(sum, full, double(volume.coarse[k - 1].size()) * k * 0.5 / 255);
    }
}

TEST(Voxels, KnowHowFarTheNearestSolidOneIs) {
    const VoxelVolume volume = volumeOf(128, [](glm::ivec3 c) {
        return c == glm::ivec3(30, 40, 50) || c == glm::ivec3(90, 41, 53);
    });
    for (const glm::ivec3 c : {glm::ivec3(30, 40, 50), glm::ivec3(31, 45, 52), glm::ivec3(3, 4, 5),
                               glm::ivec3(88, 120, 10), glm::ivec3(127)}) {
        const glm::ivec3 a = glm::abs(c - glm::ivec3(30, 40, 50)),
                         b = glm::abs(c - glm::ivec3(90, 41, 53));
        const int truth = std::min(std::max({a.x, a.y, a.z}), std::max({b.x, b.y, b.z}));
        EXPECT_EQ(volume.distance[std::size_t((c.z * 128 + c.y) * 128 + c.x)], truth);
    }
    EXPECT_FALSE(isEmptyAbout(volume, {31.2f, 40.5f, 50.5f}, 0.5f));
    EXPECT_TRUE(isEmptyAbout(volume, {35.5f, 40.5f, 50.5f}, 4.4f));
    EXPECT_FALSE(isEmptyAbout(volume, {35.5f, 40.5f, 50.5f}, 4.6f));
    EXPECT_FALSE(isEmptyAbout(volume, {-10.f, 40.5f, 50.5f}, 41));
    EXPECT_TRUE(isEmptyAbout(volume, {-10.f, 40.5f, 50.5f}, 19));
}

TEST(Voxels, FadeByTheRateUntilTheyArrive) {
    const auto volume = [](int x) {
        return volumeOf(16, [x](glm::ivec3 c) { return c.x == x || c.y == 3; });
    };
    const VoxelVolume target = volume(9);
    VoxelVolume shown = volume(5);
    for (int step = 1; step <= 5; ++step) {
        std::optional<VoxelVolume> nearer = nearTarget(shown, target, 0.2f);
        ASSERT_EQ(nearer.has_value(), step < 5);
        if (!nearer)
            break;
        shown = std::move(*nearer);
        for (std::uint32_t c = 0; c < target.lattice.cells(); ++c) {
            const glm::uvec3 cell = target.lattice.place(c);
            const int opacity = cell.y == 3   ? 255
                                : cell.x == 9 ? 51 * step
                                : cell.x == 5 ? 255 - 51 * step
                                              : 0;
            ASSERT_EQ(solidOpacity(shown, c), opacity);
            ASSERT_EQ(shown.distance[c] == 0, opacity > 0);
        }
    }
    EXPECT_FALSE(nearTarget(target, target, 0.2f)) << "at rest";
    EXPECT_FALSE(nearTarget(volume(5), target, 1)) << "at once";
    EXPECT_TRUE(nearTarget(volume(5), target, 1e-6f)) << "by 1 at least";
    EXPECT_FALSE(nearTarget(volumeOf(32, [](glm::ivec3) { return true; }), target, 0.2f))
        << "other voxels";
}

/// A cone along x over `length` voxels.
float cone(const VoxelVolume& volume, ConeShadows shadows, float length, float sine,
           float start = 4) {
    const float middle = float(volume.side()) / 2;
    const glm::vec3 from(start, middle + 0.3f, middle + 0.6f);
    return coneVisibility(volume, shadows, from, from + glm::vec3(length, 0, 0), sine);
}

/// Solid from x = 4 + first on.
VoxelVolume wallOf(int length, int first, int thick) {
    return volumeOf(std::uint32_t(2 * length),
                    [&](glm::ivec3 c) { return c.x >= 4 + first && c.x < 4 + first + thick; });
}

constexpr float kSines[] = {1 / 50.f, 1 / 16.f, 1 / 8.f, 1 / 4.f};

// The wall of the light that is looked at, with a voxel before it and one behind, does not dim it.
TEST(ShadowCones, ReachALightOnItsWall) {
    for (const int length : {16, 32, 64}) {
        const VoxelVolume volume = wallOf(length, length - 1, 2);
        for (const float sine : kSines)
            EXPECT_EQ(cone(volume, ConeShadows::Directional, float(length), sine), 1)
                << length << ' ' << sine;
    }
}

// Half of the light at most passes each of two spheres that a wall is between. Of one voxel, a
// little more does where the radius grows past a voxel there.
TEST(ShadowCones, AreBlockedByAWallMidway) {
    for (const int thick : {1, 2}) {
        float worst = 0;
        for (const int length : {16, 32, 64})
            for (int shift = 0; shift < 2; ++shift) { // against coarser cells
                const VoxelVolume volume = wallOf(length, length / 2 + shift, thick);
                for (const float sine : kSines)
                    worst = std::max(worst,
                                     cone(volume, ConeShadows::Directional, float(length), sine));
            }
        std::printf("wall of %d voxels: up to %.3f pass\n", thick, double(worst));
        EXPECT_LE(worst, thick == 2 ? 0.21f : 0.255f);
    }
}

// A thin cone meets a wall of two voxels of opacity a in three places, between voxels: what passes
// is (1 - a / 2)^2 (1 - a).
TEST(ShadowCones, DarkenAsAWallFadesIn) {
    const VoxelVolume wall = wallOf(16, 8, 2);
    VoxelVolume shown = volumeOf(32, [](glm::ivec3) { return false; });
    float before = 1;
    for (int step = 1; step < 5; ++step) {
        shown = *nearTarget(shown, wall, 0.2f);
        const float a = 0.2f * float(step), v = cone(shown, ConeShadows::Directional, 16, 1 / 50.f);
        EXPECT_NEAR(v, (1 - a / 2) * (1 - a / 2) * (1 - a), 1e-6f);
        EXPECT_LT(v, before);
        before = v;
        // The wall's two voxels lie in one coarser cell: light along x passes both.
        const std::uint32_t coarse = shown.coarse[0][(8 * 16 + 8) * 16 + 6];
        EXPECT_NEAR(float(opacityByte(coarse, 0)) / 255, 1 - (1 - a) * (1 - a), 0.5f / 255 + 1e-6f);
        EXPECT_NEAR(float(opacityByte(coarse, kMeanOpacity)) / 255, a, 0.5f / 255 + 1e-6f);
    }
}

TEST(ShadowCones, AreHalfBlockedByHalfAWall) {
    float lowest = 1, highest = 0;
    for (const int length : {32, 64}) {
        const VoxelVolume volume = volumeOf(std::uint32_t(2 * length), [&](glm::ivec3 c) {
            return c.x >= 4 + length / 2 && c.x < 6 + length / 2 && c.y < length;
        });
        for (const float sine : {1 / 8.f, 1 / 4.f}) {
            const glm::vec3 from(4, length, length);
            const float v = coneVisibility(volume, ConeShadows::Directional, from,
                                           from + glm::vec3(length, 0, 0), sine);
            lowest = std::min(lowest, v);
            highest = std::max(highest, v);
        }
    }
    std::printf("half a wall: %.3f to %.3f pass\n", double(lowest), double(highest));
    EXPECT_GE(lowest, 0.25f);
    EXPECT_LE(highest, 0.56f);
}

// What the published cones get wrong: they are dimmed by the wall of the light that they look at,
// and averages let light through walls.
TEST(ShadowCones, ThatWerePublishedAreDimmedByTheirLightsWallAndLeak) {
    const float dimmed[] = {0.14f, 0.04f, 0.59f, 0.95f};
    for (int k = 0; k < 4; ++k) {
        const int length = 8 << k;
        const VoxelVolume volume = wallOf(std::max(length, 16), length - 1, 2);
        const float v = cone(volume, ConeShadows::Published, float(length), 1 / 16.f, 4.5f);
        std::printf("published, own wall at %d: %.3f\n", length, double(v));
        EXPECT_NEAR(v, dimmed[k], 0.25f) << length;
    }
    const float leaked[] = {0, 0.04f, 0.59f};
    for (int k = 0; k < 3; ++k) {
        const int length = 16 << k;
        const VoxelVolume volume = wallOf(length, length / 2 - 1, 2);
        const float v = cone(volume, ConeShadows::Published, float(length), 1 / 16.f, 4.5f);
        std::printf("published, wall midway of %d: %.3f\n", length, double(v));
        EXPECT_NEAR(v, leaked[k], 0.25f) << length;
    }
}

TEST(ShadowCones, OfNoShadowsAndOfNearLightsSeeAll) {
    const VoxelVolume full = volumeOf(64, [](glm::ivec3) { return true; });
    EXPECT_EQ(cone(full, ConeShadows::None, 30, 0.1f), 1);
    EXPECT_EQ(cone(full, ConeShadows::Directional, 1.9f, 0.1f), 1);
    EXPECT_EQ(cone(full, ConeShadows::Directional, 30, 0.1f), 0);
    EXPECT_EQ(cone(full, ConeShadows::Directional, 0, 0.1f), 1);
}

} // namespace
} // namespace limn::voxels_test
