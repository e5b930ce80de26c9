// SPDX-License-Identifier: MIT
#include "engine/field/sample_field.h"
#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/relight/relight.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

namespace limn::grid_leak_test {
namespace {

using namespace simple;

/// Two rooms of 4 m with a wall of 0.1 m between them. The left one has a lamp; a dynamic ball
/// stands in the dark one, as far from the wall as is said. Cells of 1 m.
Scene rooms(float apart) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.7f)));
    b.add(box(glm::vec3(0), glm::vec3(4), true));
    b.add(box({4.1f, 0, 0}, {8.1f, 4, 4}, true));
    b.add(sphere(0.25f, 2, false),
          glm::translate(glm::mat4(1), glm::vec3(4.35f + apart, 2.1f, 1.9f)), true);
    Light lamp;
    lamp.position = {2, 3, 2};
    lamp.strength = 10;
    b.scene.lights = {lamp};
    Scene scene = b.build();
    scene.bake.surfels = 4000;
    scene.bake.lightmapCaches = 1500;
    scene.bake.rays = 512;
    scene.bake.links = 128;
    scene.bake.grid = {8, 4, 4};
    scene.relight.dynamicOcclusion = false;
    return scene;
}

/// Mean irradiance over the vertices of the ball.
double onBall(const IndirectField& field, const Scene& scene) {
    const Instance& ball = scene.instances[2];
    const Mesh& mesh = scene.meshOf(ball);
    double sum = 0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        sum += double(sampleIrradiance({field,
                                        {},
                                        scene,
                                        2,
                                        0,
                                        0,
                                        0,
                                        ball.toWorld * glm::vec4(mesh.positions[i], 1),
                                        mesh.normals[i]})
                          .x);
    return sum / double(mesh.positions.size());
}

TEST(GridLeak, NoLightComesThroughAWall) {
    Scene scene = rooms(0.05f);
    const auto trace = std::make_unique<TraceScene>(scene);
    Result<Bake> made = bake(*trace);
    ASSERT_TRUE(made);
    Relighter relighter(std::make_shared<const Bake>(std::move(*made)));
    for (const float apart : {0.02f, 0.1f, 0.2f}) {
        scene = rooms(apart);
        const TraceScene moved(scene);
        relighter.relight(scene, moved, 64);
        IndirectField field = relighter.field();
        scene.instances[2].toWorld[3].x -= 2 * (4.35f + apart - 4.05f); // to the bright side
        const double bright = onBall(field, scene);
        scene = rooms(apart);
        const double dark = onBall(field, scene);
        field.gridDepth = nullptr; // trilinear
        const double plain = onBall(field, scene);
        RecordProperty("leak_" + std::to_string(int(100 * apart)), std::to_string(dark / bright));
        RecordProperty("plain_" + std::to_string(int(100 * apart)), std::to_string(plain / bright));
        std::printf("%.2f m from the wall: leak %.2g, trilinear %.2g\n", double(apart),
                    dark / bright, plain / bright);
        EXPECT_GT(plain, 0.05 * bright) << apart; // else there is nothing to tell
        EXPECT_LT(dark, 0.01 * bright) << apart;
        EXPECT_LT(dark, plain / 10) << apart;
    }
}

TEST(GridLeak, WhereNoCellSeesThePointTheLookupIsTrilinear) {
    const Scene scene = rooms(0.2f);
    IndirectField field;
    field.gridSize = {2, 2, 2};
    field.gridBounds = {glm::vec3(0), glm::vec3(2)};
    field.grid.assign(8 * std::size_t(9), glm::vec4(0));
    for (std::size_t i = 0; i < 8; ++i)
        field.grid[i] = glm::vec4(float(i + 1));
    const glm::vec3 p(0.8f, 1.1f, 1.4f), n(0, 0, 1);
    const glm::vec3 plain = sampleIrradiance({field, {}, scene, 9, 0, 0, 0, p, n});
    field.gridDepth = std::make_shared<const std::vector<std::uint16_t>>(8 * 256, 0xffff); // solids
    EXPECT_NEAR(sampleIrradiance({field, {}, scene, 9, 0, 0, 0, p, n}).x, plain.x, 1e-5f * plain.x);
    std::vector<std::uint16_t> one(8 * 256, 0xffff);
    std::fill_n(one.begin() + 5 * 256, 256, 0); // cell 5 alone is in the open
    field.gridDepth = std::make_shared<const std::vector<std::uint16_t>>(one);
    const glm::vec3 seen = sampleIrradiance({field, {}, scene, 9, 0, 0, 0, p, n});
    EXPECT_NEAR(seen.x, 6 * std::sqrt(std::numbers::pi) / 2, 1e-3f); // pi c Y_00
}

TEST(GridNeed, CellsThatNothingReadsAreNeitherLitNorShown) {
    Scene scene = rooms(0.2f);
    const TraceScene trace(scene);
    Result<Bake> made = bake(trace);
    ASSERT_TRUE(made);
    const auto baked = std::make_shared<const Bake>(std::move(*made));
    Relighter relighter(baked);
    EXPECT_EQ(relighter.relight(scene, trace, 64).gridCachesSkipped, 0U);
    EXPECT_EQ(relighter.field().gridSize, baked->gridSize);
    ASSERT_TRUE(relighter.field().gridDepth);

    Scene alone = scene;
    alone.instances.pop_back(); // the ball is hidden
    const TraceScene without(alone);
    Relighter other(baked);
    EXPECT_EQ(other.relight(alone, without, 64).gridCachesSkipped, 8U * 4 * 4);
    EXPECT_EQ(other.field().gridSize, glm::uvec3(0));
    EXPECT_TRUE(other.field().grid.empty());
    EXPECT_FALSE(other.field().gridDepth);
    for (std::size_t i = baked->caches.lightmapCount * 9; i < other.cacheSh().size(); ++i)
        ASSERT_EQ(other.cacheSh()[i], glm::vec3(0));
    EXPECT_EQ(other.relight(scene, trace, 64).gridCachesSkipped, 0U); // it is shown again
    EXPECT_EQ(other.field().grid.size(), relighter.field().grid.size());
    EXPECT_GT(onBall(other.field(), scene), 0);
}

TEST(GridNeed, CellsThatNothingReadsAreLitWhereAskedFor) {
    Scene scene = rooms(0.2f);
    scene.relight.dynamicOcclusion = false; // the ball takes no light from the cells
    const TraceScene trace(scene);
    Result<Bake> made = bake(trace);
    ASSERT_TRUE(made);
    const auto baked = std::make_shared<const Bake>(std::move(*made));
    Relighter read(baked);
    read.relight(scene, trace, 64);

    Scene alone = scene;
    alone.instances.pop_back(); // the ball is hidden, and so is its shadow of the lamp
    const TraceScene without(alone);
    Relighter unread(baked);
    unread.relight(alone, without, 64);
    unread.lightUnreadGrid(true);
    EXPECT_EQ(unread.relight(alone, without, 64).gridCachesSkipped, 0U);
    ASSERT_EQ(unread.field().grid.size(), read.field().grid.size());
    EXPECT_TRUE(unread.field().gridDepth);
    EXPECT_GT(onBall(unread.field(), scene), 0);
}

} // namespace
} // namespace limn::grid_leak_test
