// SPDX-License-Identifier: MIT
// What a lightmap shows of a wall with a normal map.
#include "engine/export/exported_lightmap.h"

#include "engine/export/lightmap_error.h"
#include "engine/measure/seen_points.h"
#include "engine/reference/path.h"
#include "tests/export/exported_room.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace limn::bumpy_wall_test {
namespace {

/// A room with a lamp at one end. Its back wall has bumps whose normals are tilted by 35 degrees,
/// to the right, the left, up and down.
Document bumpyRoom(Assets& assets) {
    using namespace simple;
    Document d;
    Mesh wall = quad({0, 0, 0.01f}, {4, 0, 0}, {0, 3, 0}, 1);
    wall.tangents.assign(4, {1, 0, 0, 1});
    assets.meshes = {box(glm::vec3(0), {4, 3, 5}, true), wall};
    const auto byte = [](double v) { return std::uint8_t(std::lround((v + 1) * 127.5)); };
    const double s = std::sin(0.61), c = std::cos(0.61);
    Image bumps{.name = "bumps", .width = 2, .height = 2, .rgba = {}};
    for (const auto& [x, y] : {std::pair(s, 0.), {0., s}, {0., -s}, {-s, 0.}})
        bumps.rgba.insert(bumps.rgba.end(), {byte(x), byte(y), byte(c), 255});
    assets.images = {bumps};
    addObject(d, lambert({0.7f, 0.65f, 0.6f}));
    Material bumpy = lambert(glm::vec3(0.6f));
    bumpy.normalTexture = {.image = 0, .scale = {20, 15}, .nearest = true};
    addObject(d, bumpy);
    for (const std::uint32_t mesh : {0U, 1U}) {
        Node node;
        node.meshes = {mesh};
        addObject(d, node);
    }
    addObject(d, Light{.position = {0.3f, 2, 4}, .strength = 20});
    addObject(d, Camera{.name = "eye", .eye = {2, 1.5f, 3.5f}, .target = {2, 1.5f, 0}});
    BakeSettings bake;
    bake.surfels = 2000;
    bake.lightmapCaches = 3000;
    bake.rays = 128;
    addObject(d, bake);
    return d;
}

/// A texel of irradiance knows a single normal. With harmonics, programs evaluate the light at the
/// normal that the map gives.
TEST(BumpyWall, ShowsItsBumpsByHarmonics) {
    auto assets = std::make_shared<Assets>();
    const Document document = bumpyRoom(*assets);
    const ExportedRoom room(document, assets);
    const Emitters emitters = findEmitters(room.trace);
    const SkyLight sky = findSkyLight(room.scene.sky);
    std::vector<SeenPoint> points = findSeenPoints(room.trace, room.scene.cameras[0], 32, 18, 1);
    std::erase_if(points, [](const SeenPoint& p) { return p.hit.instance != 1; });
    ASSERT_GT(points.size(), 300U);
    // The product of errors against two references has none of their noise.
    const PathContext context{room.trace, emitters, sky};
    const std::vector<glm::vec3> truth = *traceIrradiance(context, points, 256, 3, {}),
                                 other = *traceIrradiance(context, points, 256, 4, {});
    std::array<double, 3> error{};
    for (const std::uint32_t bands : {1U, 2U, 3U}) {
        const Result<ExportedLightmap> map =
            exportedLightmap(room.view(), {.texels = 2000, .bands = bands}, PageCount::Any, {});
        ASSERT_TRUE(map) << map.error().message;
        double squared = 0, mean = 0;
        for (std::size_t k = 0; k < points.size(); ++k) {
            const std::optional<glm::vec3> e =
                lookUpExported(room.view(), map->cut.get(), map->pages, map->images, points[k].hit,
                               points[k].surface.normal);
            ASSERT_TRUE(e);
            squared += double((e->y - truth[k].y) * (e->y - other[k].y));
            mean += double(truth[k].y + other[k].y) / 2;
        }
        const auto count = double(points.size());
        error[bands - 1] = std::sqrt(squared / count) / (mean / count);
        RecordProperty("nRMSE of " + std::to_string(bands) + " bands",
                       std::to_string(error[bands - 1]));
    }
    EXPECT_LT(error[1], 0.6 * error[0]);
    EXPECT_LT(error[2], 0.7 * error[1]);
}

} // namespace
} // namespace limn::bumpy_wall_test
