// SPDX-License-Identifier: MIT
#include "engine/techniques/radiance_volumes/allocation.h"

#include "engine/core/parallel.h"
#include "engine/shading/pixel_rays.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <tuple>

namespace limn::allocation_test {
namespace {

Scene room(float scale = 1) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::box(glm::vec3(0), scale * glm::vec3(4, 3, 5), true));
    b.add(simple::box(scale * glm::vec3(1, 0, 1), scale * glm::vec3(1.8f, 1.2f, 1.6f), false));
    return b.build();
}

Viewpoint view() {
    return viewpointOf({.eye = {2.3f, 1.2f, 2.5f}, .target = {1.2f, 0.5f, 1.3f}}, {96, 64});
}

constexpr VolumeSettings kSettings = {
    .cascades = 3, .nodes = 32, .caches = 1 << 20, .transition = 2};

/// (grid, x, y, z) of a node.
using Node = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>;

std::set<Node> nodesOf(const CacheAllocation& made) {
    std::set<Node> nodes;
    for (std::uint32_t g = 0; g < made.grids.grids.size(); ++g)
        for (std::size_t i = 0; i < made.grids.grids[g].count(); ++i)
            if (made.address[made.grids.firstNode(g) + i] != kNoCache) {
                const glm::uvec3 n = made.grids.grids[g].node(i);
                nodes.insert({g, n.x, n.y, n.z});
            }
    return nodes;
}

// The grids that light a point, said once more: the finest whose box, 1.5 cells within its edge,
// holds the point, and within two cells of that box's faces the next, too.
std::set<Node> nodesWanted(const CacheGrids& grids, glm::vec3 eye, float scene,
                           const std::vector<glm::vec3>& points) {
    std::set<Node> nodes;
    const auto add = [&](std::uint32_t g, glm::vec3 p) {
        const CacheGrid& grid = grids.grids[g];
        for (int k = 0; k < 8; ++k) {
            Node node{g, 0, 0, 0};
            const auto coordinate = [&](int axis) {
                return std::uint32_t(std::floor((p[axis] - grid.lower[axis]) / grid.cell)) +
                       std::uint32_t(k >> axis & 1);
            };
            nodes.insert({g, coordinate(0), coordinate(1), coordinate(2)});
        }
    };
    for (const glm::vec3 p : points) {
        for (std::uint32_t g = 0; g < 3; ++g) {
            const float edge = 2 * scene / float(4U >> g), cell = edge / 30;
            const glm::vec3 d = glm::abs(p - eye);
            const float inside = edge / 2 - 1.5f * cell - std::max({d.x, d.y, d.z});
            if (g < 2 && inside < 0)
                continue;
            if (g == 2 || inside > 0)
                add(g, p);
            if (g < 2 && inside < 2 * cell)
                add(g + 1, p);
            break;
        }
    }
    return nodes;
}

TEST(CacheAllocation, HasACacheAtTheNodesAboutEachPixelAndNowhereElse) {
    const Scene scene = room();
    const TraceScene trace(scene);
    const CacheAllocation made = allocateForView(trace, scene, view(), kSettings);
    ASSERT_EQ(made.grids.grids.size(), 3U);
    for (int g = 0; g < 3; ++g)
        EXPECT_FLOAT_EQ(made.grids.grids[std::size_t(g)].cell, 5.f * float(1 << g) / 2 / 30);
    // A hundredth of a fine cell above what the pixels show.
    std::vector<glm::vec3> points;
    const PixelRays rays(view().camera, 96, 64);
    for (std::uint32_t y = 0; y < 64; ++y)
        for (std::uint32_t x = 0; x < 96; ++x) {
            const Hit hit = trace.closestHit(rays.through({float(x) + 0.5f, float(y) + 0.5f}));
            points.push_back(hit.position + hit.geometricNormal * (hit.frontFace ? 1.f : -1.f) *
                                                (0.01f * 2.5f / 30));
        }
    EXPECT_EQ(nodesOf(made), nodesWanted(made.grids, view().camera.eye, 5, points));
    EXPECT_EQ(made.pixels, points.size());
    EXPECT_EQ(made.missed, 0U);
    EXPECT_EQ(made.droppedCount, 0U);
    std::set<std::size_t> lit;
    for (const glm::vec3 p : points) {
        const CacheLookup found = lookUpCaches(made.grids, made.address, p);
        const GridShares shares = gridShares(made.grids, p);
        EXPECT_TRUE(found.count >= 1 && found.count <= 8 * shares.count); // none of weight 0
        for (std::size_t k = 0; k < shares.count; ++k)
            for (std::uint32_t corner = 0; corner < 8; ++corner) {
                const std::uint32_t g = shares.share[k].grid;
                const CacheGrid& grid = made.grids.grids[g];
                EXPECT_NE(made.address[made.grids.firstNode(g) +
                                       grid.index(cellCorner(grid.cellAt(p), corner))],
                          kNoCache);
            }
        float sum = 0;
        for (std::size_t k = 0; k < found.count; ++k)
            sum += found.weight[k];
        EXPECT_NEAR(sum, 1, 1e-5f);
        lit.insert(shares.count);
    }
    EXPECT_EQ(lit.size(), 2U) << "some pixels are lit by two grids, and some by one";
}

TEST(CacheAllocation, HasTheSameBitsEachTimeAndForAnyNumberOfThreads) {
    const Scene scene = room();
    const TraceScene trace(scene);
    const CacheAllocation first = allocateForView(trace, scene, view(), kSettings);
    const ThreadLimit one(1);
    const CacheAllocation second = allocateForView(trace, scene, view(), kSettings);
    EXPECT_EQ(first.address, second.address);
    EXPECT_EQ(first.places, second.places);
    EXPECT_EQ(first.grids, second.grids);
}

// A plane within a layer of cells: all corners of the cells that it crosses.
TEST(CacheAllocation, OfAPlaneHasTheCornersOfItsCells) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::quad({0.1f, 0.43f, 0.1f}, {0, 0, 5.8f}, {3.8f, 0, 0}));
    for (const glm::vec3 p : {glm::vec3(0), glm::vec3(6.99f)})
        b.add(simple::quad(p, {0.01f, 0, 0}, {0, 0, 0.01f}));
    Scene scene = b.build();
    scene.bounds = {glm::vec3(0), glm::vec3(7)};
    CacheGrids grids = gridOver(scene.bounds, 7);
    ASSERT_EQ(grids.grids[0].nodes, glm::uvec3(8));
    WantedNodes wanted(grids.nodes(), 0);
    for (float x = 0.15f; x < 3.9f; x += 0.1f)
        for (float z = 0.15f; z < 5.9f; z += 0.1f)
            wantNodes(grids, 0, grids.grids[0].cellAt({x, 0.43f, z}), wanted);
    EXPECT_EQ(std::ranges::count(wanted, 1), 2 * (4 + 1) * (6 + 1));
    scene.instances.resize(1);
    for (const std::uint32_t caches : {2U * 5 * 7, 200U}) {
        const CacheAllocation made = allocateForScene(scene, {.caches = caches});
        EXPECT_LE(made.caches(), caches);
        EXPECT_EQ(made.droppedCount, 0U);
        if (caches == 70) {
            EXPECT_EQ(made.grids.grids[0].nodes, glm::uvec3(8)) << "the finest that fits";
            EXPECT_EQ(made.caches(), 70U);
        }
    }
}

TEST(CacheAllocation, KeepsCoarseGridsAndDropsTheRestWhereCachesAreFew) {
    const Scene scene = room();
    const TraceScene trace(scene);
    const CacheAllocation all = allocateForView(trace, scene, view(), kSettings);
    VolumeSettings few = kSettings;
    few.caches = all.ofGrid[2] + all.ofGrid[1] / 2;
    const CacheAllocation made = allocateForView(trace, scene, view(), few);
    EXPECT_EQ(made.caches(), few.caches);
    EXPECT_EQ(made.ofGrid[2], all.ofGrid[2]);
    EXPECT_EQ(made.ofGrid[0], 0U);
    EXPECT_EQ(made.droppedCount, all.caches() - few.caches);
    EXPECT_EQ(made.dropped.size(), made.droppedCount);
    EXPECT_GT(made.missed, 0U);
    few.caches = all.ofGrid[2] / 2;
    EXPECT_GT(allocateForView(trace, scene, view(), few).missed, made.missed);
}

// A corner without a cache drops out, the others are scaled up; where all are missing, the next
// grid lights the point, and where that has none, either, nothing does.
TEST(CacheLookups, DoWithoutMissingCaches) {
    const CacheGrids grids = cascadesAbout(glm::vec3(2), {glm::vec3(0), glm::vec3(4)}, 2, 16, 2);
    std::vector<std::uint32_t> address(grids.nodes(), kNoCache);
    const glm::vec3 p(2.03f, 2.07f, 1.96f);
    EXPECT_EQ(lookUpCaches(grids, address, p).count, 0U);
    const auto put = [&](std::size_t g, glm::uvec3 step, std::uint32_t cache) {
        const CacheGrid& grid = grids.grids[g];
        address[grids.firstNode(g) + grid.index(grid.cellAt(p) + step)] = cache;
    };
    put(1, {1, 0, 1}, 7);
    CacheLookup found = lookUpCaches(grids, address, p);
    ASSERT_EQ(found.count, 1U);
    EXPECT_EQ(found.cache[0], 7U);
    EXPECT_FLOAT_EQ(found.weight[0], 1);
    put(0, {0, 0, 0}, 3);
    put(0, {1, 0, 0}, 4);
    found = lookUpCaches(grids, address, p);
    ASSERT_EQ(found.count, 2U);
    const CacheGrid& fine = grids.grids[0];
    const float f = (p.x - fine.place(fine.cellAt(p)).x) / fine.cell;
    EXPECT_NEAR(found.weight[0], 1 - f, 1e-5f);
    EXPECT_NEAR(found.weight[1], f, 1e-5f);
}

TEST(CacheGrids, HoldTheWholeSceneWhereverTheEyeIs) {
    const Bounds bounds{glm::vec3(-1, 2, 3), glm::vec3(4, 3, 6)};
    for (const glm::vec3 eye : {glm::vec3(0, 2.5f, 4), glm::vec3(-40, 90, 3), glm::vec3(4, 3, 6)}) {
        const CacheGrids grids = cascadesAbout(eye, bounds, 3, 32, 2);
        const CacheGrid& last = grids.grids.back();
        const glm::vec3 upper = last.place(last.nodes - 1U);
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_LE(last.lower[axis], bounds.lower[axis] + 1e-4f);
            EXPECT_GE(upper[axis], bounds.upper[axis] - 1e-4f);
        }
    }
    const CacheGrids here = cascadesAbout({1.01f, 2.5f, 4}, bounds, 3, 32, 2),
                     there = cascadesAbout({1.02f, 2.5f, 4}, bounds, 3, 32, 2);
    EXPECT_EQ(here.grids[2].lower, there.grids[2].lower) << "snapped to cells";
    EXPECT_NE(here.grids[2].decision, there.grids[2].decision) << "follows the eye";
}

// A cache on a floor is raised above it, in the corner of two walls along both.
TEST(CachePlaces, AreRaisedAboveTheSurfacesThatWantThem) {
    const CachePlace floor{.position = {1, -0.1f, 1}, .normal = {0, 1, 0}, .height = -0.1f};
    EXPECT_NEAR(floor.raised(0.3f).y, 0.3f, 1e-6f);
    EXPECT_EQ(floor.raised(-1).y, -0.1f);
    const CachePlace corner{.normal = {0.5f, 0.5f, 0}};
    EXPECT_NEAR(glm::dot(corner.raised(0.2f), glm::vec3(0.5f, 0.5f, 0)), 0.2f, 1e-6f)
        << "the mean height of both";
    const CachePlace thin{.position = {1, 2, 3}, .normal = {0.1f, 0, 0}, .height = -1};
    EXPECT_EQ(thin.raised(0.5f), thin.position);
}

// A cache 0.1 below and 0.4 before the end of a floor, which is seen from x = 0.7 on.
TEST(CachePlaces, AreSeenFromWhereThePointsAreThatWantThem) {
    CachePlaceSums sums(1);
    const glm::vec3 position(0.3f, -0.1f, 1);
    for (const float x : {0.7f, 0.9f})
        for (const float z : {0.5f, 1.1f})
            sums.add(0, position, 0.5f, {x, 0, z}, {0, 1, 0});
    const CachePlace place = placeOf(sums.sums(0), position, 0.5f);
    EXPECT_LT(glm::distance(place.seenFrom(0.2f), glm::vec3(0.8f, 0.2f, 0.8f)), 1e-3f);
    CachePlace high = place;
    high.position.y = 0.6f, high.height = 0.6f, high.shift.y = -0.6f;
    EXPECT_LT(glm::distance(high.seenFrom(0.2f), glm::vec3(0.8f, 0.6f, 0.8f)), 1e-3f);
    CachePlace thin = place;
    thin.normal = {0, 0.1f, 0};
    EXPECT_EQ(thin.seenFrom(0.2f), position);
}

} // namespace
} // namespace limn::allocation_test
