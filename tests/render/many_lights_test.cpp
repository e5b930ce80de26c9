// SPDX-License-Identifier: MIT
#include "engine/math/sampling.h"
#include "engine/render/shadows/light_table.h"
#include "engine/render/shadows/shadow_maps.h"
#include "tests/render/viewport_fixture.h"
#include "tests/techniques/illuminance/gpu/relit_scene.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <glm/gtx/string_cast.hpp>

namespace limn::many_lights_test {
namespace {

using render::ShadowTiles;

constexpr float kWall = 0.05f; // half its thickness [m]

/// A closed room, 6 m x 3 m x 4 m, that a wall at x = 0 parts, and lamps on the side x < 0.
Scene partedRoom(std::uint32_t lamps) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::box({-3, 0, -2}, {3, 3, 2}, true));
    b.add(simple::box({-kWall, 0, -2}, {kWall, 3, 2}, false));
    b.scene.bake.surfels = 4000;
    b.scene.bake.lightmapCaches = 200;
    b.scene.bake.rays = 16;
    b.scene.bake.links = 16;
    b.scene.relight.dynamicOcclusion = false;
    for (std::uint32_t k = 0; k < lamps; ++k) {
        Light& lamp = b.scene.lights.emplace_back();
        const float u = (float(k) + 0.5f) / float(lamps);
        lamp.position = {-2.6f + 2.2f * u, 0.4f + 2.2f * radicalInverse(k, 2),
                         -1.6f + 3.2f * radicalInverse(k, 3)};
        lamp.strength = 1;
    }
    return b.build();
}

std::vector<Light> points(std::uint32_t count) {
    std::vector<Light> lights(count);
    for (std::uint32_t k = 0; k < count; ++k)
        lights[k].position = {float(k), 1, 0};
    return lights;
}

class ManyLights : public ViewportTest {
protected:
    /// Irradiance of the surfels by the viewport's shadow maps.
    std::vector<float> irradiance(const Scene& scene, const std::shared_ptr<const Bake>& bake) {
        SurfelValues half;
        half.albedo.assign(bake->surfels.size(), glm::vec3(0.5f));
        half.emitted.assign(bake->surfels.size(), glm::vec3(0));
        half.sky.assign(bake->tree.skyCells, glm::vec3(0));
        viewport->setScene(scene, nullptr);
        const ShadowedLights lights = viewport->shadowedLights();
        EXPECT_EQ(lights.count, scene.lights.size());
        SurfelInputs inputs = half.inputs();
        inputs.lights = &lights;
        const auto relighter = gpuRelighter(*device, bake);
        relighter->relight(inputs, 1);
        std::vector<float> E;
        for (const glm::vec3 B : relighter->readRadiosity())
            E.push_back(2 * B.x);
        E.resize(bake->surfels.size());
        return E;
    }
};

/// From the second nearest face of the side x < 0 of the room: from an edge for what lies on a
/// face.
float fromEdge(glm::vec3 p) {
    std::array d = {p.x + 3, -kWall - p.x, p.y, 3 - p.y, p.z + 2, 2 - p.z};
    std::sort(d.begin(), d.end());
    return d[1];
}

TEST_F(ManyLights, ShineThroughNoWall) {
    for (const std::uint32_t lamps : {20U, 500U}) {
        const Scene scene = partedRoom(lamps);
        const TraceScene trace(scene);
        const auto bake = baked(trace, scene.bake);
        const std::vector<float> E = irradiance(scene, bake);
        const std::vector<glm::vec3> traced = surfelValues(*bake, scene, trace).direct;
        // Shadows are filtered over 1.5 texels, after a step of up to 0.7 of one. Faces see 5 m.
        const float size = lamps == 20 ? 1024 : 128, blur = 2.2f * 2 / size * 5;
        double lit = 0, leak = 0, most = 0;
        std::size_t bright = 0, dark = 0, edge = 0;
        for (std::size_t i = 0; i < E.size(); ++i) {
            const glm::vec3 p = bake->surfels.position[i];
            const float share = E[i] / traced[i].x;
            if (p.x < -kWall) {
                float nearest = HUGE_VALF; // of the points that light falls on
                for (std::size_t k = 0; k < kLightPoints; ++k)
                    nearest = std::min(nearest,
                                       fromEdge(bake->surfels.lightPoints[i * kLightPoints + k]));
                ++bright;
                lit += double(traced[i].x);
                edge += nearest < blur;
                if (nearest > blur)
                    ASSERT_NEAR(share, 1, 0.01f) << glm::to_string(p);
                else // the filter reaches the face beside it, which hides at most its half
                    ASSERT_NEAR(share, 0.75f, 0.26f) << glm::to_string(p);
            } else if (p.x >= kWall) {
                ++dark;
                ASSERT_EQ(traced[i].x, 0);
                leak += double(E[i]);
                most = std::max(most, double(E[i]));
            }
        }
        ASSERT_GT(bright, edge + 1000);
        ASSERT_GT(dark, 1000U);
        lit /= double(bright);
        leak /= double(dark);
        std::printf(
            "%u lamps: %zu of %zu near edges; behind the wall, of the light before it: mean "
            "%.1e, most %.1e\n",
            lamps, edge, bright, leak / lit, most / lit);
        // At the foot of the wall the lit floor before it blurs under it.
        EXPECT_LT(leak, 1e-4 * lit);
        EXPECT_LT(most, 0.01 * lit);
    }
}

TEST_F(ManyLights, OneThatMovesDrawsItsOwnMapsOnly) {
    Scene scene = partedRoom(500);
    const TraceScene trace(scene);
    const auto bake = baked(trace, scene.bake);
    irradiance(scene, bake);
    EXPECT_EQ(viewport->stats().relightShadowMaps, 500U);
    device->waitIdle();
    const std::uint64_t bytes = viewport->stats().gpuBytes;
    irradiance(scene, bake);
    EXPECT_EQ(viewport->stats().relightShadowMaps, 0U);
    scene.lights[250].position.y = 1.5f;
    const std::vector<float> moved = irradiance(scene, bake);
    EXPECT_EQ(viewport->stats().relightShadowMaps, 1U);
    device->waitIdle();
    EXPECT_EQ(viewport->stats().gpuBytes, bytes);
    viewport = std::make_unique<Viewport>(*device);
    const std::vector<float> fresh = irradiance(scene, bake);
    const float largest = *std::max_element(fresh.begin(), fresh.end());
    for (std::size_t i = 0; i < fresh.size(); ++i) // other places in the atlas round differently
        ASSERT_NEAR(moved[i], fresh[i], 0x1p-12f * largest) << i;
}

TEST_F(ManyLights, CoarseMapsAreThoseOfHalfTheSizeAndAreDrawnAnewLater) {
    Scene scene = partedRoom(20);
    scene.lights.back().kind = LightKind::Directional;
    const TraceScene trace(scene);
    const auto bake = baked(trace, scene.bake);
    const std::vector<float> fine = irradiance(scene, bake);
    const std::uint64_t fineVersion = viewport->shadowedLights().version;
    viewport->setCoarseShadows(true);
    EXPECT_EQ(irradiance(scene, bake), fine) << "those that are drawn are as good";
    EXPECT_EQ(viewport->shadowedLights().version, fineVersion);
    scene.lights[3].position.y = 1.5f;
    irradiance(scene, bake);
    EXPECT_EQ(viewport->stats().relightShadowMaps, 1U);
    const std::uint64_t coarseVersion = viewport->shadowedLights().version;
    EXPECT_GT(coarseVersion, fineVersion);
    viewport->setCoarseShadows(false);
    const std::vector<float> rested = irradiance(scene, bake);
    EXPECT_EQ(viewport->stats().relightShadowMaps, 1U) << "the others are as they were";
    EXPECT_GT(viewport->shadowedLights().version, coarseVersion) << "to be lit by anew";
    viewport = std::make_unique<Viewport>(*device);
    const std::vector<float> fresh = irradiance(scene, bake);
    const float largest = *std::max_element(fresh.begin(), fresh.end());
    for (std::size_t i = 0; i < fresh.size(); ++i)
        ASSERT_NEAR(rested[i], fresh[i], 0x1p-12f * largest) << i;

    render::ShadowMaps maps(*device);
    maps.assign(scene.lights, scene.bounds, 1, true);
    const std::vector<shared::GpuShadowView> coarse = maps.views();
    maps.assign(scene.lights, scene.bounds, 1, false);
    const std::vector<shared::GpuShadowView> whole = maps.views();
    ASSERT_EQ(coarse.size(), whole.size());
    for (std::size_t i = 0; i < whole.size(); ++i) // twice, and wider by the margin's four texels
        EXPECT_NEAR(coarse[i].texelSize, 2 * whole[i].texelSize, 0.02f * whole[i].texelSize);
}

TEST_F(ManyLights, TakeNoMoreMemoryThanTheAtlasHas) {
    const std::uint64_t most = 512ull << 20;
    std::uint64_t before = viewport->stats().gpuBytes;
    render::ShadowMaps maps(*device);
    for (const std::uint32_t count : {21U, 22U, 500U, 5461U}) {
        const auto slots = maps.assign(points(count), {glm::vec3(-1), glm::vec3(1)}, 1);
        EXPECT_EQ(maps.leftOut, 0U);
        std::set<std::uint32_t> first;
        for (const render::ShadowSlot& s : slots) {
            EXPECT_EQ(s.count, 6U);
            first.insert(s.first);
        }
        EXPECT_EQ(first.size(), count);
        device->waitIdle();
        EXPECT_LE(viewport->stats().gpuBytes - before, most + (1 << 20)) << count;
    }
}

TEST_F(ManyLights, BeyondTheAtlasAreDarkAndCounted) {
    const std::uint32_t room = ShadowTiles::room(ShadowTiles::kMaxLevel) / 6;
    const std::vector<Light> lights = points(room + 3);
    render::ShadowMaps maps(*device);
    const auto slots = maps.assign(lights, {glm::vec3(-1), glm::vec3(1)}, 1);
    EXPECT_EQ(maps.leftOut, 3U);
    for (std::size_t i = 0; i < slots.size(); ++i)
        EXPECT_EQ(slots[i].count, i < room ? 6U : 0U) << i;
    render::LightTable table;
    render::writeLightTable(*device, table, lights, slots, maps.views());
    EXPECT_EQ(table.count, room);
}

TEST_F(ManyLights, ALargeMapFindsRoomWhereTheFreeTilesAreScattered) {
    render::ShadowMaps maps(*device);
    const Bounds bounds{glm::vec3(-1), glm::vec3(1)};
    std::vector<Light> lights = points(128);
    for (Light& spot : lights)
        spot.kind = LightKind::Spot;
    maps.assign(lights, bounds, 1); // every quarter
    for (const int k : {17, 12, 7, 2})
        lights.erase(lights.begin() + k);
    lights.emplace_back().kind = LightKind::Directional;
    const auto slots = maps.assign(lights, bounds, 1);
    EXPECT_EQ(maps.leftOut, 0U);
    const std::vector<shared::GpuShadowView> views = maps.views();
    std::set<std::array<int, 3>> quarters; // that the views' middles lie in
    for (std::size_t i = 0; i < lights.size(); ++i)
        for (std::uint32_t k = slots[i].first; k < slots[i].first + slots[i].count; ++k) {
            const glm::vec3 middle = lights[i].position + glm::vec3(views[k].axis);
            const glm::vec4 q = views[k].toAtlas * glm::vec4(middle, 1);
            quarters.insert({int(2 * q.x / q.w), int(2 * q.y / q.w), int(views[k].layer)});
        }
    EXPECT_EQ(quarters.size(), 125U);
}

TEST(ShadowTiles, DoNotOverlapAndStayInTheirLayer) {
    for (const std::uint32_t level : {0U, 2U}) {
        ShadowTiles tiles;
        tiles.reset(level);
        const std::uint32_t size = ShadowTiles::smallSize(level);
        std::set<std::array<std::uint32_t, 3>> taken;
        std::uint32_t places = 0;
        for (bool large = true; places < ShadowTiles::room(level);
             large = places < ShadowTiles::room(level) / 2) {
            const auto at = tiles.take(large);
            ASSERT_TRUE(at);
            const render::ShadowTile t = tiles.tile(*at, large);
            ASSERT_EQ(t.size, large ? 2 * size : size);
            ASSERT_LE(std::max(t.x, t.y) + t.size, ShadowTiles::kLayerSize);
            ASSERT_LT(t.layer, ShadowTiles::kMaxLayers);
            for (std::uint32_t y = 0; y < t.size; y += size)
                for (std::uint32_t x = 0; x < t.size; x += size)
                    ASSERT_TRUE(taken.insert({t.layer, t.x + x, t.y + y}).second);
            places += large ? ShadowTiles::kLargeTile : 1;
        }
        EXPECT_FALSE(tiles.take(false));
        tiles.free(7, false);
        EXPECT_FALSE(tiles.take(true));
        EXPECT_EQ(tiles.take(false), 7U);
    }
}

TEST(ShadowTiles, HalveTheirSizeAsTheyGrowInNumber) {
    EXPECT_EQ(ShadowTiles::levelFor(128), 0U);
    EXPECT_EQ(ShadowTiles::levelFor(129), 1U);
    EXPECT_EQ(ShadowTiles::smallSize(0), 1024U);
    EXPECT_EQ(ShadowTiles::levelFor(3000), 3U); // 500 point lights
    EXPECT_EQ(ShadowTiles::smallSize(3), 128U);
    EXPECT_EQ(ShadowTiles::levelFor(32768), 4U);
    EXPECT_FALSE(ShadowTiles::levelFor(32769));
}

} // namespace
} // namespace limn::many_lights_test
