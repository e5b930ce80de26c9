// SPDX-License-Identifier: MIT
// Which caches are worth rays, where those start, and what takes the place of the others.
#include "engine/field/grid_placement.h"
#include "engine/lightmap/atlas_stage.h"
#include "engine/scene/mesh/input_hash.h"
#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/bake/rays/trace_stage.h"
#include "engine/techniques/illuminance/bake/receivers/cache_points.h"
#include "engine/techniques/illuminance/bake/receivers/fill_invalid.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include <glm/gtc/matrix_transform.hpp>

namespace limn::caches_test {
namespace {

using namespace simple;

/// Caches with the given positions, those of `valid` with a link.
Caches lightmapCaches(const std::vector<glm::vec3>& at, const std::vector<glm::vec3>& normal,
                      const std::set<std::uint32_t>& valid, std::uint32_t lightmapCount) {
    Caches c;
    c.position = at;
    c.normal = normal;
    c.kind.assign(at.size(), CacheKind::Hemisphere);
    c.lightmapCount = lightmapCount;
    c.linkBegin = {0};
    for (std::uint32_t i = 0; i < at.size(); ++i)
        c.linkBegin.push_back(c.linkBegin.back() + std::uint32_t(valid.count(i)));
    return c;
}

TEST(FillInvalid, TakesTheNearestValidOnesOfItsKindAndSide) {
    const glm::vec3 up(0, 1, 0), down(0, -1, 0), none(0);
    //                       invalid        above       twice as far  other side   grid, near
    Caches c = lightmapCaches({{0, 0, 0}, {0.1f, 0, 0}, {0.2f, 0, 0}, {0, 0, 0.01f}, {0, 0, 0}},
                              {up, up, up, down, none}, {1, 2, 3, 4}, 4);
    EXPECT_EQ(fillInvalid(c, 1), 1U);
    EXPECT_EQ(c.fillBegin, (std::vector<std::uint32_t>{0, 3, 3, 3, 3, 3}));
    ASSERT_EQ(c.fillSource, (std::vector<std::uint32_t>{1, 2, 3}));
    // costs 0.01, 0.04, 0.0001 + 16 * 2
    const double sum = 1 + 0.25 + 0.01 / 32.0001;
    EXPECT_NEAR(c.fillWeight[0], 1 / sum, 1e-5);
    EXPECT_NEAR(c.fillWeight[1], 0.25 / sum, 1e-5);
    EXPECT_NEAR(c.fillWeight[2], 0.01 / 32.0001 / sum, 1e-7);
}

TEST(FillInvalid, AGridAsksForNoSideAndWithoutAnyValidOneNothingIsTaken) {
    Caches grid =
        lightmapCaches({{0, 0, 0}, {1, 0, 0}, {0, 2, 0}}, std::vector(3, glm::vec3(0)), {1, 2}, 0);
    EXPECT_EQ(fillInvalid(grid, 5), 1U);
    ASSERT_EQ(grid.fillSource, (std::vector<std::uint32_t>{1, 2}));
    EXPECT_NEAR(grid.fillWeight[0], 0.8, 1e-6);
    EXPECT_NEAR(grid.fillWeight[1], 0.2, 1e-6);
    Caches dark = lightmapCaches({{0, 0, 0}, {0, 0, 0}}, std::vector(2, glm::vec3(0)), {}, 1);
    EXPECT_EQ(fillInvalid(dark, 1), 2U);
    EXPECT_TRUE(dark.fillSource.empty());
    EXPECT_EQ(dark.fillBegin, (std::vector<std::uint32_t>{0, 0, 0}));
}

/// A room of 4 m with a block of 2 m at height `y` over the floor, and a dynamic ball.
Scene roomWithSolid(float x, float y) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(box(glm::vec3(0), glm::vec3(4), true));
    b.add(box(glm::vec3(0), glm::vec3(2), false), glm::translate(glm::mat4(1), glm::vec3(x, y, 1)));
    b.add(sphere(0.1f, 0, false), glm::translate(glm::mat4(1), glm::vec3(0.3f, 3, 3)), true);
    Scene scene = b.build();
    scene.bake.surfels = 500;
    scene.bake.lightmapCaches = 500;
    scene.bake.rays = 256;
    scene.bake.grid = {8, 8, 8};
    return scene;
}

struct PlacedCaches {
    CachePoints points;
    Caches caches;
};

PlacedCaches placed(const TraceScene& trace, std::uint32_t grid) {
    const Scene& scene = trace.scene();
    std::uint64_t rays = 0;
    const auto atlas = atlasStage(trace, scene, hashMeshes(scene), {}, nullptr, rays);
    PlacedCaches result;
    result.caches = placeCaches(scene, atlas->atlas, result.points);
    addGridCaches(glm::uvec3(grid), gridBoundsOf(scene), result.caches, result.points);
    return result;
}

TEST(BuriedCaches, AreThoseWhoseEveryProbeMetABack) {
    constexpr std::uint32_t kRays = 200;
    std::vector<RawHit> hits(kRays, 7 | kBack);
    EXPECT_TRUE(isInSolid(hits.data(), kRays));
    EXPECT_FALSE(isInSolid(hits.data(), 2 * kProbes - 1)); // too few to leave any out
    std::uint32_t probes = 0;
    for (RawHit& hit : hits) {
        hit = 7;
        probes += isInSolid(hits.data(), kRays) ? 0 : 1;
        hit = kUntraced;
        EXPECT_TRUE(isInSolid(hits.data(), kRays));
        hit = 7 | kBack;
    }
    EXPECT_EQ(probes, kProbes);
}

TEST(BuriedCaches, CostProbesAlone) {
    const Scene scene = roomWithSolid(1, 0.1f);
    const TraceScene trace(scene);
    const PlacedCaches p = placed(trace, 8);
    const SurfelSet set = placeSurfels(scene, scene.bake.surfels);
    const OwnerTables owners(scene, set);
    GatherHits hits;
    const auto report =
        traceHits({trace, set, owners, p.caches, p.points, Linker::Gather, 256, hashMeshes(scene)},
                  {}, nullptr, hits);
    ASSERT_TRUE(report);
    // Cells are 0.5 m wide: 4 x 4 x 4 lie in the block. No texel does.
    std::uint32_t leftOut = 0;
    for (std::uint32_t c = 0; c < p.caches.size(); ++c) {
        const glm::vec3 at = p.caches.position[c];
        const bool inside = c >= p.caches.lightmapCount &&
                            glm::all(glm::greaterThan(at, glm::vec3(1, 0.1f, 1))) &&
                            glm::all(glm::lessThan(at, glm::vec3(3, 2.1f, 3)));
        EXPECT_EQ(hits.sender[c * 256] == GatherHits::kExcluded, inside) << c;
        leftOut += inside ? 1 : 0;
    }
    EXPECT_EQ(leftOut, 64U);
    EXPECT_EQ(report->rays, (p.caches.size() - 64) * 256 + 64 * kProbes);
}

TEST(BuriedCaches, AreTracedWhenTheSolidLeavesThem) {
    StageStore store;
    for (const float x : {1.f, 1.7f, 0.1f, 1.f}) {
        const Scene scene = roomWithSolid(x, 0.1f);
        const TraceScene trace(scene);
        const Result<Bake> kept = bake(trace, {}, &store), fresh = bake(trace);
        ASSERT_TRUE(kept && fresh);
        EXPECT_EQ(fresh->counts.invalidCaches, 64U);
        EXPECT_EQ(kept->hash(), fresh->hash());
    }
}

TEST(OpenPoints, OfATexelHalfUnderAWallAreThoseInTheOpen) {
    // The block stands on the floor: texels of that cross its edges.
    const Scene scene = roomWithSolid(1.13f, 0);
    const TraceScene trace(scene);
    const PlacedCaches p = placed(trace, 1);
    int crossing = 0, under = 0;
    for (std::uint32_t c = 0; c < p.caches.lightmapCount; ++c) {
        int inBlock = 0, open = 0;
        for (std::uint32_t k = p.points.begin[c]; k < p.points.begin[c + 1]; ++k) {
            const glm::vec3 at = p.points.position[k];
            if (!(at.y < 1e-4f && p.points.normal[k].y > 0.9f))
                continue;
            (at.x > 1.13f && at.x < 3.13f && at.z > 1 && at.z < 3 ? inBlock : open)++;
        }
        crossing += inBlock > 0 && open > 0;
        under += inBlock > 0 && open == 0;
    }
    EXPECT_EQ(crossing, 0);
    EXPECT_GT(under, 0); // wholly under it: filled from others
}

} // namespace
} // namespace limn::caches_test
