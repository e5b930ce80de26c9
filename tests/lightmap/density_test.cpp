// SPDX-License-Identifier: MIT
#include "engine/lightmap/density.h"

#include "engine/core/parallel.h"
#include "engine/gallery/gallery.h"
#include "engine/lightmap/atlas.h"
#include "engine/lightmap/charts.h"
#include "engine/techniques/illuminance/bake/senders/surfel_owners.h"
#include "engine/techniques/illuminance/bake/senders/surfels.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace limn::density_test {
namespace {

using namespace simple;

constexpr std::uint32_t kTexels = 24000;

std::vector<MeshCharts> chartsOf(const Scene& scene) {
    std::vector<MeshCharts> charts;
    for (const Mesh& m : scene.assets->meshes)
        charts.push_back(buildCharts(m));
    return charts;
}

BakeDensity densityOf(const Scene& scene) {
    return findDensity(TraceScene(scene), chartsOf(scene), kTexels);
}

/// A room of 5 x 3 x 4 m with a block in it and a window, on a ground of 200 x 200 m, everything
/// times `scale`. Instances: walls from inside, from outside, the block, the ground.
Scene house(float scale, float blockAt = 1) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    Mesh walls = box(glm::vec3(0), glm::vec3(5, 3, 4), true);
    for (glm::vec3& p : walls.positions)
        p *= scale;
    b.add(walls);
    b.add(box(glm::vec3(-0.2f) * scale, glm::vec3(5.2f, 3.2f, 4.2f) * scale, false));
    b.add(box(glm::vec3(blockAt, 0, 1) * scale, glm::vec3(blockAt + 1, 1, 2) * scale, false));
    b.add(quad(glm::vec3(-100, -0.2f, -100) * scale, glm::vec3(0, 0, 200) * scale,
               glm::vec3(200, 0, 0) * scale, 0));
    return b.build();
}

TEST(Density, IsTheSameAllOverAClosedRoom) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(box(glm::vec3(0), glm::vec3(3, 2.5f, 4), true));
    const BakeDensity d = densityOf(b.build());
    for (const float factor : d.texels[0])
        EXPECT_EQ(factor, 1);
    ASSERT_TRUE(d.surfels[0].uniform());
    EXPECT_EQ(d.surfels[0].density[0], 1);
}

TEST(Density, IsOneWhereNothingIsSeen) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(quad({0, 0, 0}, {0, 0, 5}, {5, 0, 0}, 0));
    const BakeDensity d = densityOf(b.build());
    EXPECT_EQ(d.texels[0], std::vector<float>(d.texels[0].size(), 1));
    EXPECT_TRUE(d.surfels[0].uniform());
}

TEST(Density, AWideGroundLeavesItsTexelsAndSurfelsToTheHouse) {
    for (const float scale : {0.01f, 1.f, 30.f}) {
        const Scene scene = house(scale);
        const BakeDensity d = densityOf(scene);
        for (const float factor : d.texels[0])
            EXPECT_EQ(factor, d.texels[0][0]) << scale;
        EXPECT_LE(d.texels[3][0], d.texels[0][0] / 4) << scale; // 1/16 of the texels per area

        const SurfelSet even = placeSurfels(scene, 20000);
        const SurfelSet set = placeSurfels(scene, 20000, d.surfels);
        EXPECT_NEAR(double(set.surfels.size()), 20000, 20);
        const auto inRoom = [&](const SurfelSet& s) { return s.instanceBegin[1]; };
        EXPECT_LT(inRoom(even), 60U); // its share of the area
        EXPECT_GT(inRoom(set), 5000U);
        double area = 0;
        for (std::uint32_t s = set.instanceBegin[3]; s < set.instanceBegin[4]; ++s)
            area += double(set.surfels.area[s]);
        EXPECT_NEAR(area, 40000 * double(scale * scale), 40 * double(scale * scale));
    }
}

// A house of 494 m on a plane of 40 km, which is its floor, too: the floor's part needs too few
// texels to count, but the plane would get half of all.
TEST(Density, AGroundThatWouldWasteTexelsVaries) {
    const GeneratedScene made = generateScene(307);
    const Scene scene = flatten(made.document, made.assets);
    const BakeDensity d = findDensity(TraceScene(scene), chartsOf(scene), 36000);
    ASSERT_EQ(d.varied.size(), 1U);
    EXPECT_EQ(d.varied[0].instance, 2U);
    EXPECT_LE(d.texels[2][0], 1 / 16.f);
    EXPECT_GE(d.texels[1][0], 1);
}

TEST(Density, OfTheGroundFallsWithDistance) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(quad({-100, 0, -100}, {0, 0, 200}, {200, 0, 0}, 0));
    for (const float x : {-4.f, 0.f, 4.f})
        for (const float z : {-4.f, 0.f, 4.f})
            b.add(box({x, 0, z}, {x + 1, 3, z + 1}, false));
    const Scene scene = b.build();
    const MeshDensity d = densityOf(scene).surfels[0];
    ASSERT_FALSE(d.uniform());
    const Mesh& mesh = scene.meshOf(scene.instances[0]);
    int nearby = 0, far = 0;
    for (std::uint32_t t = 0; t < 2; ++t)
        forCells(d.side(t), [&](glm::uvec2 at) {
            const glm::vec2 middle = (glm::vec2(at) + 1 / 3.f) / float(d.side(t));
            const float distance = glm::length(trianglePoint(mesh, t, middle));
            const float density = d.density[d.cell(t, at)];
            if (distance < 6) {
                EXPECT_EQ(density, 1);
                ++nearby;
            } else if (distance > 60) {
                EXPECT_LE(density, 1 / 16.f);
                ++far;
            }
        });
    EXPECT_GT(nearby, 3);
    EXPECT_GT(far, 100);
}

TEST(Density, StaysWhenAnObjectMovesALittle) {
    const BakeDensity before = densityOf(house(1)), after = densityOf(house(1, 1.1f));
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_EQ(before.texels[i], after.texels[i]) << i;
    for (const std::size_t m : {0U, 1U}) // the room's walls, inside and outside
        EXPECT_EQ(before.surfels[m], after.surfels[m]) << m;
}

TEST(Density, IsTheSameAtAnyNumberOfThreads) {
    const Scene scene = house(1);
    const BakeDensity many = densityOf(scene);
    const ThreadLimit limit(1);
    const BakeDensity one = densityOf(scene);
    EXPECT_EQ(one.texels, many.texels);
    EXPECT_EQ(one.surfels, many.surfels);
}

TEST(Density, CellsPartATriangle) {
    MeshDensity d{{0, 3}, {0, 1}, std::vector<float>(65, 1.f)};
    for (std::uint32_t t = 0; t < 2; ++t) {
        double sum = 0;
        forCells(d.side(t), [&](glm::uvec2 at) {
            sum += d.share(t, at);
            EXPECT_EQ(d.cellAt(t, (glm::vec2(at) + 1 / 3.f) / float(d.side(t))), at);
        });
        EXPECT_DOUBLE_EQ(sum, 1);
        for (const glm::vec2 corner : {glm::vec2(1, 0), glm::vec2(0, 1), glm::vec2(0.5f, 0.5f)}) {
            const glm::uvec2 at = d.cellAt(t, corner);
            EXPECT_LT(at.x + at.y, d.side(t));
        }
    }
}

/// A unit square whose first triangle is nine times as dense beyond u = 1/2.
Scene halves(MeshDensity& density) {
    density = {{1, 0}, {0, 4}, {1, 9, 1, 1, 1}};
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 0));
    return b.build();
}

TEST(Density, SurfelsFollowItAndOwnWhatLiesNearest) {
    MeshDensity density;
    const Scene scene = halves(density);
    const Mesh& mesh = scene.assets->meshes[0];
    for (const SurfelPlacement placement :
         {SurfelPlacement::Halton, SurfelPlacement::Random, SurfelPlacement::Relaxed}) {
        const MeshSurfels s = placeSurfels(mesh, 4000, false, placement, density);
        // Area times density: 1/8 * 9 in the dense cell, 7/8 elsewhere.
        double dense = 0, denseArea = 0, area = 0;
        for (std::uint32_t i = 0; i < s.size(); ++i) {
            const bool inside = density.at(s.triangle[i], s.barycentric[i]) > 1;
            dense += inside;
            denseArea += inside ? double(s.areas[i]) : 0;
            area += double(s.areas[i]);
        }
        const double relaxed = placement == SurfelPlacement::Relaxed ? 0.06 : 0.001;
        EXPECT_NEAR(dense / 4000, 9. / 16, relaxed * 9 / 16) << int(placement);
        EXPECT_NEAR(denseArea, 1. / 8, relaxed / 8) << int(placement);
        EXPECT_NEAR(area, 1, 1e-4);

        const SurfelOwners owners(mesh, s);
        int nearest = 0, asked = 0;
        for (std::uint32_t t = 0; t < 2; ++t)
            for (float u = 0.005f; u < 1; u += 0.03f)
                for (float v = 0.005f; u + v < 1; v += 0.03f) {
                    const glm::vec3 p = trianglePoint(mesh, t, {u, v});
                    const auto distance = [&](std::uint32_t i) {
                        return glm::length(s.position[i] - p);
                    };
                    const std::uint32_t own = owners.surfelAt(t, u, v, false);
                    float least = distance(own);
                    for (std::uint32_t i = 0; i < s.size(); ++i)
                        least = std::min(least, distance(i));
                    nearest += distance(own) < least + 0.3f * std::sqrt(s.areas[own]);
                    ++asked;
                }
        EXPECT_GT(asked, 1000);
        EXPECT_GT(nearest, 0.98 * asked) << int(placement);
    }
}

TEST(Density, RelaxedDistancesGoWithItsRoot) {
    MeshDensity density;
    const Scene scene = halves(density);
    const MeshSurfels s =
        placeSurfels(scene.assets->meshes[0], 4000, false, SurfelPlacement::Relaxed, density);
    double sum[2] = {}, count[2] = {};
    const auto dense = [&](std::uint32_t i) {
        return density.at(s.triangle[i], s.barycentric[i]) > 1;
    };
    for (std::uint32_t i = 0; i < s.size(); ++i) {
        float least = 1e30f;
        bool amidst = true; // of its like: the spacing there is 0.024
        for (std::uint32_t j = 0; j < s.size(); ++j)
            if (const float distance = glm::length(s.position[i] - s.position[j]); i != j) {
                least = std::min(least, distance);
                amidst = amidst && (distance > 0.1f || dense(i) == dense(j));
            }
        if (amidst) {
            sum[dense(i)] += double(least);
            ++count[dense(i)];
        }
    }
    EXPECT_GT(count[0], 500);
    EXPECT_GT(count[1], 500);
    EXPECT_NEAR(sum[0] / count[0] / (sum[1] / count[1]), 3, 0.1);
}

TEST(Density, TexelsFollowTheirFactors) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(quad({0, 0, 0}, {8, 0, 0}, {0, 8, 0}, 0));
    b.add(quad({0, 0, 1}, {8, 0, 0}, {0, 8, 0}, 0));
    Scene scene = b.build();
    scene.bake.lightmapCaches = 5000;
    const Atlas atlas =
        buildAtlas(scene, chartsOf(scene), scene.bake, {std::vector<float>{1}, {0.25f}});
    double count[2] = {};
    for (const AtlasTexel& t : atlas.texels) {
        ++count[t.instance];
        EXPECT_FLOAT_EQ(t.width, (t.instance == 0 ? 1 : 4) / atlas.texelsPerMetre);
    }
    EXPECT_NEAR(count[0] + count[1], 5000, 150);
    EXPECT_NEAR(std::sqrt(count[0]) - 1, 4 * (std::sqrt(count[1]) - 1), 4);
}

} // namespace
TEST(Density, ClassesArePowersOfSixteenAndRoundUpBelowTheCentre) {
    EXPECT_EQ(densityClass(1, 1), 0);
    EXPECT_EQ(densityClass(3.9, 1), 0);
    EXPECT_EQ(densityClass(4.1, 1), 1) << "from 16^(1/2) on";
    EXPECT_EQ(densityClass(1e9, 1), kMaxDensityClass);
    const double little = std::pow(16., 0.1);
    EXPECT_EQ(densityClass(little / 16 * 1.01, 1), 0);
    EXPECT_EQ(densityClass(little / 16 * 0.99, 1), -1);
    EXPECT_EQ(densityClass(1e-30, 1), kMinDensityClass);
    EXPECT_EQ(densityClass(0, 1), kMinDensityClass);
    EXPECT_EQ(densityClass(64, 64), 0);
    for (const double nearness : {0.01, 1., 7.3})
        EXPECT_NEAR(nearnessOf(detailOf(nearness)) / nearness, 1, 1e-12);
}

} // namespace limn::density_test
