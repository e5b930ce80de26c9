// SPDX-License-Identifier: MIT
#include "engine/field/grid_depth.h"

#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/format/bake.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <algorithm>

#include <glm/gtc/matrix_transform.hpp>

namespace limn::grid_depth_test {
namespace {

using namespace simple;

/// 8 x 4 x 4 m, with a wall of 0.2 m at x = 4.5, a block of 2 m and a dynamic ball. Cells of 1 m.
Scene dividedRoom(std::uint32_t rays) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(box(glm::vec3(0), glm::vec3(8, 4, 4), true));
    b.add(box({4.6f, 0, 0}, {4.8f, 4, 4}, false));
    b.add(box({1, 0, 1}, {3, 2, 3}, false));
    b.add(sphere(0.1f, 0, false), glm::translate(glm::mat4(1), glm::vec3(6, 3, 3)), true);
    Scene scene = b.build();
    scene.bake.surfels = 4000;
    scene.bake.lightmapCaches = 300;
    scene.bake.links = 16;
    scene.bake.rays = rays;
    scene.bake.grid = {8, 4, 4};
    return scene;
}

struct Cell {
    const std::uint16_t* map;
    glm::vec3 centre;
};

Cell cellAt(const Bake& bake, std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    const std::uint32_t cell = (z * bake.gridSize.y + y) * bake.gridSize.x + x;
    return {bake.gridDepth.data() + cell * kGridDepthTexels,
            bake.caches.position[bake.caches.lightmapCount + cell]};
}

TEST(GridDepth, SeesAsFarAsTheNextWallAndNothingFromASolid) {
    const Scene scene = dividedRoom(1024);
    const Result<Bake> made = bake(TraceScene(scene));
    ASSERT_TRUE(made);
    ASSERT_EQ(made->gridDepth.size(), 8U * 4 * 4 * kGridDepthTexels);
    const float reach = gridReach(made->gridBounds, made->gridSize);
    EXPECT_NEAR(reach, 3, 1e-5f);
    const auto seen = [&](const Cell& cell, glm::vec3 p) {
        return seenFromCell(cell.map, p - cell.centre, reach);
    };
    // The wall is 0.6 m from the cell whose centre is at x = 4.5 - 0.5 = 4, to its right.
    for (std::uint32_t y = 1; y < 3; ++y)
        for (std::uint32_t z = 1; z < 3; ++z) {
            const Cell before = cellAt(*made, 4, y, z), left = cellAt(*made, 3, y, z);
            for (const float side : {-0.5f, 0.f, 0.5f}) {
                const glm::vec3 p(4.5f, before.centre.y + side, before.centre.z - side);
                EXPECT_GT(seen(left, p), 0.9f) << side; // 0.1 m before the wall
                EXPECT_GT(seen(before, p), 0.9f) << side;
                EXPECT_EQ(seen(left, p + glm::vec3(0.4f, 0, 0)), 0) << side; // behind it
                EXPECT_EQ(seen(before, p + glm::vec3(0.4f, 0, 0)), 0) << side;
            }
        }
    const Cell buried = cellAt(*made, 1, 0, 1), open = cellAt(*made, 1, 3, 1);
    EXPECT_EQ(std::count(buried.map, buried.map + kGridDepthTexels, 0xffff), kGridDepthTexels);
    EXPECT_EQ(seen(buried, buried.centre), 0);
    EXPECT_GT(seen(open, open.centre), 0.99f);
    // The block's top is 1.5 m below. Straight down four faces of the octahedron meet, so the depth
    // comes out up to a sixteenth too large.
    EXPECT_GT(seen(open, open.centre - glm::vec3(0, 1.5f, 0)), 0.99f);
    EXPECT_EQ(seen(open, open.centre - glm::vec3(0, 1.5f * 1.15f * 16 / 15, 0)), 0);
}

TEST(GridDepth, FewRaysLeaveNoTexelWithoutADistance) {
    const Result<Bake> made = bake(TraceScene(dividedRoom(16)));
    ASSERT_TRUE(made);
    const Cell open = cellAt(*made, 6, 2, 2);
    for (std::uint32_t i = 0; i < kGridDepthTexels; ++i)
        EXPECT_GT(open.map[i], 200U) << i; // walls are within 9 m in all directions
}

} // namespace
} // namespace limn::grid_depth_test
