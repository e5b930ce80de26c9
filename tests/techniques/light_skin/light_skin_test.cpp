// SPDX-License-Identifier: MIT
#include "engine/core/parallel.h"
#include "engine/field/field_reading.h"
#include "engine/gallery/hostile_scene.h"
#include "engine/lighting/explanation.h"
#include "engine/lightmap/texel_points.h"
#include "tests/core/sweep.h"
#include "tests/techniques/light_skin/lit_by_skin.h"
#include "tests/techniques/two_lamps.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <string>

#include <glm/gtc/matrix_transform.hpp>

namespace limn::light_skin_test {
namespace {

/// A room with a block and two lamps of different colours.
Scene room(float scale = 1) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert({0.7f, 0.5f, 0.3f}));
    b.scene.materials[0].roughness = 0.4f;
    b.add(simple::box(glm::vec3(0), scale * glm::vec3(4, 3, 5), true));
    b.add(simple::box(scale * glm::vec3(1, 0, 1), scale * glm::vec3(1.8f, 1.2f, 1.6f), false),
          glm::mat4(1), true);
    b.scene.lights = twoLamps(scale);
    b.scene.technique.settings = {{"light-skin.map_size", 24},
                                  {"light-skin.vals", 256},
                                  {"light-skin.samples", 64},
                                  {"light-skin.spacing", 6}};
    return b.build();
}

Viewpoint viewOf(float scale = 1) {
    return {.camera = {.eye = scale * glm::vec3(3.5f, 1.5f, 4.5f), .target = scale * glm::vec3(1)},
            .aspect = 1,
            .size = {64, 64}};
}

struct Place {
    glm::vec3 position, normal;
    std::uint32_t instance;
};
std::vector<Place> places(float scale = 1) {
    return {{scale * glm::vec3(3, 0, 3), {0, 1, 0}, 0},
            {scale * glm::vec3(2.2f, 3, 2), {0, -1, 0}, 0},
            {scale * glm::vec3(0, 1.2f, 2.7f), {1, 0, 0}, 0},
            {scale * glm::vec3(1.4f, 1.2f, 1.3f), {0, 1, 0}, 1}};
}

/// Irradiance and reflected light at places.
std::vector<glm::vec3> lightOf(const LitBySkin& lit, float scale = 1) {
    std::vector<glm::vec3> all;
    for (const Place& p : places(scale)) {
        const FieldPoint point = lit.at(p.position, p.normal, p.instance);
        all.push_back(sampleIrradiance(point));
        all.push_back(sampleLobe(point, p.normal, 2, {1, 0.5f}));
    }
    return all;
}

TEST(LightSkin, IsTheSameAtEveryScale) {
    const auto all = [](float scale) { // rounding may choose other texels
        Scene scene = room(scale);
        scene.technique.settings["light-skin.all"] = 1;
        return scene;
    };
    LitBySkin lit(all(1));
    const Viewpoint view = viewOf();
    lit.update(&view);
    const std::vector<glm::vec3> one = lightOf(lit);
    for (const float scale : {1e-3f, 0.1f, 10.f, 1e3f}) {
        LitBySkin scaled(all(scale));
        const Viewpoint from = viewOf(scale);
        scaled.update(&from);
        const std::vector<glm::vec3> e = lightOf(scaled, scale);
        for (std::size_t i = 0; i < one.size(); ++i)
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(e[i][c], one[i][c], 0.01f * one[i][c]) << scale << ", " << i;
    }
}

TEST(LightSkin, DoublesWithTheLights) {
    LitBySkin lit(room());
    const Viewpoint view = viewOf();
    lit.update(&view);
    const std::vector<glm::vec3> both = lightOf(lit);
    for (Light& light : lit.scene.lights)
        light.strength *= 2;
    lit.update(&view);
    const std::vector<glm::vec3> twice = lightOf(lit);
    for (std::size_t i = 0; i < both.size(); ++i) {
        EXPECT_EQ(twice[i], 2.f * both[i]);
        EXPECT_GT(both[i].x, 0) << i;
    }
}

/// Light at a cache of its own proxy, before shade.
glm::vec3 atCache(const LitBySkin& lit, std::size_t c) {
    const SkinPart::Light& light = lit.part().light();
    const ProxyLight& proxy = light.proxies[c].diffuse;
    return proxy.fluxOfLight > 0 ? light.flux[c] / proxy.fluxOfLight / proxy.lit : glm::vec3(0);
}

// Exact at caches. Between them the place of a proxy is that of all lights.
TEST(LightSkin, AddsLightsAtCachesExactly) {
    Scene scene = room();
    scene.technique.settings["light-skin.shade"] = 0;
    LitBySkin lit(scene);
    lit.update();
    const std::size_t count = lit.part().light().caches->size();
    std::vector<glm::vec3> both(count), sum(count, glm::vec3(0));
    for (std::size_t c = 0; c < count; ++c)
        both[c] = atCache(lit, c);
    const glm::vec3 between = lit.irradiance(places()[0].position, places()[0].normal);
    glm::vec3 sumBetween(0);
    for (const std::size_t off : {0U, 1U}) {
        lit.scene = scene;
        lit.scene.lights[off].enabled = false;
        lit.update();
        for (std::size_t c = 0; c < count; ++c)
            sum[c] += atCache(lit, c);
        sumBetween += lit.irradiance(places()[0].position, places()[0].normal);
    }
    for (std::size_t c = 0; c < count; ++c)
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(sum[c][k], both[c][k], 1e-5f * both[c][k]);
    std::printf("two lights between caches: sum %+.3f %% off\n",
                double(100 * (sumBetween.x / between.x - 1)));
    EXPECT_NEAR(sumBetween.x / between.x, 1, 0.2f);
}

TEST(LightSkin, HasTheSameBitsForAnyNumberOfThreads) {
    const Viewpoint view = viewOf();
    LitBySkin many(room());
    many.update(&view);
    const ThreadLimit one(1);
    LitBySkin single(room());
    single.update(&view);
    EXPECT_TRUE(*single.lighting->field() == *many.lighting->field());
    EXPECT_EQ(lightOf(single), lightOf(many));
    many.scene.lights[0].strength *= 1.0001f;
    many.update(&view);
    EXPECT_FALSE(*single.lighting->field() == *many.lighting->field());
}

TEST(LightSkin, MakesAgainOnlyWhatChanged) {
    LitBySkin lit(room());
    Viewpoint view = viewOf();
    const LightingReport first = lit.update(&view);
    EXPECT_EQ(counterOf(first, "meshes"), 2);
    EXPECT_EQ(counterOf(first, "lights_traced"), 2);
    EXPECT_EQ(counterOf(first, "lights_gathered"), 2);
    EXPECT_GT(counterOf(first, "shadow_rays"), 0);
    EXPECT_GT(counterOf(first, "bytes"), 1000);
    EXPECT_TRUE(lit.update(&view).skipped);
    lit.scene.lights[0].color = {0, 1, 0};
    lit.scene.sky.radiance = glm::vec3(3);
    const LightingReport colour = lit.update(&view);
    EXPECT_FALSE(colour.skipped);
    EXPECT_EQ(counterOf(colour, "shadow_rays"), 0);
    EXPECT_EQ(counterOf(colour, "lights_gathered"), 0);
    lit.scene.lights[0].position.x -= 0.5f;
    const LightingReport moved = lit.update(&view);
    EXPECT_EQ(counterOf(moved, "lights_traced"), 1);
    EXPECT_EQ(counterOf(moved, "lights_gathered"), 1);
    EXPECT_EQ(counterOf(moved, "meshes"), 0);
    view.camera.eye.x -= 0.2f;
    const LightingReport looked = lit.update(&view);
    EXPECT_FALSE(looked.skipped) << "light is of a view";
    EXPECT_EQ(counterOf(looked, "lights_traced"), 0);
    EXPECT_EQ(counterOf(looked, "shadow_rays"), 64) << "view samples";
    lit.scene.instances[1].toWorld[3].x += 0.1f;
    lit.retrace();
    const LightingReport object = lit.update(&view);
    EXPECT_EQ(counterOf(object, "meshes"), 0);
    EXPECT_EQ(counterOf(object, "lights_traced"), 2);
    lit.scene.technique.settings["light-skin.all"] = 1;
    lit.scene.technique.settings["light-skin.glossy"] = 0;
    lit.update(&view);
    view.camera.eye.x -= 0.2f;
    EXPECT_TRUE(lit.update(&view).skipped) << "nothing of it depends on the view";
}

TEST(LightSkin, KeepsItsLightWhenCancelled) {
    LitBySkin lit(room());
    lit.update();
    const std::vector<glm::vec3> before = lightOf(lit);
    lit.scene.lights[0].position.x -= 1;
    std::atomic<bool> cancel = true;
    const LightingReport report = lit.update(nullptr, {.cancel = &cancel});
    EXPECT_FALSE(report.whole);
    EXPECT_EQ(lightOf(lit), before);
    EXPECT_FALSE(lit.update().skipped);
    LitBySkin anew(lit.scene);
    anew.update();
    EXPECT_EQ(lightOf(lit), lightOf(anew));
}

TEST(LightSkin, OfObjectAndLampTurnedTogetherIsTheSame) {
    const auto lit = [](bool turned) {
        const glm::mat4 turn =
            turned ? glm::rotate(glm::mat4(1), 1.5707963f, glm::vec3(0, 1, 0)) : glm::mat4(1);
        simple::SceneBuilder b;
        b.addMaterial(simple::lambert(glm::vec3(0.6f)));
        b.add(simple::box({-2, 0, -1}, {2, 3, 1.5f}, true), turn);
        b.add(simple::sphere(0.5f, 3, false), turn * glm::translate(glm::mat4(1), {1, 1, 0}));
        b.scene.lights = {{.kind = LightKind::Point,
                           .position = glm::vec3(turn * glm::vec4(-0.5f, 2, 0.3f, 1)),
                           .strength = 20}};
        b.scene.technique.settings = {
            {"light-skin.all", 1}, {"light-skin.map_size", 32}, {"light-skin.spacing", 6}};
        LitBySkin room(b.build());
        room.update();
        std::vector<float> all;
        for (const auto& [p, n] : {std::pair(glm::vec3(0.3f, 0, 0.2f), glm::vec3(0, 1, 0)),
                                   std::pair(glm::vec3(-2, 1, 0.4f), glm::vec3(1, 0, 0)),
                                   std::pair(glm::vec3(0.9f, 3, -0.3f), glm::vec3(0, -1, 0))})
            all.push_back(
                room.irradiance(glm::vec3(turn * glm::vec4(p, 1)), glm::mat3(turn) * n).x);
        return all;
    };
    const std::vector<float> still = lit(false), turned = lit(true);
    for (std::size_t i = 0; i < still.size(); ++i)
        EXPECT_NEAR(turned[i] / still[i], 1, 2e-3f);
}

TEST(LightSkin, IsTheSameByListsOfVerticesOnAFineMesh) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.6f)));
    b.add(simple::sphere(1, 5, true));
    b.scene.lights = {{.kind = LightKind::Point, .position = {0.3f, 0.2f, 0}, .strength = 20}};
    b.scene.technique.settings = {
        {"light-skin.all", 1}, {"light-skin.map_size", 16}, {"light-skin.spacing", 6}};
    LitBySkin lit(b.build());
    std::vector<float> byList[2];
    for (const std::size_t k : {0U, 1U}) {
        lit.scene.technique.settings["light-skin.vertex_lists"] = double(k);
        lit.update();
        const Mesh& mesh = lit.scene.meshOf(lit.scene.instances[0]);
        for (std::uint32_t t = 0; t < mesh.triangleCount(); t += 97) {
            const std::array<std::uint32_t, 3> i = mesh.triangle(t);
            FieldPoint point = lit.at(
                (mesh.positions[i[0]] + mesh.positions[i[1]] + mesh.positions[i[2]]) / 3.f,
                glm::normalize(mesh.normals[i[0]] + mesh.normals[i[1]] + mesh.normals[i[2]]));
            point.triangle = t;
            point.u = point.v = 1 / 3.f;
            byList[k].push_back(sampleIrradiance(point).x);
        }
    }
    double mean = 0, difference = 0;
    for (std::size_t i = 0; i < byList[0].size(); ++i) {
        mean += double(byList[0][i]);
        difference += std::abs(double(byList[1][i] - byList[0][i]));
    }
    std::printf("lists of vertices: mean difference %.4f of the mean\n", difference / mean);
    EXPECT_LT(difference, 0.01 * mean);
    EXPECT_GT(difference, 0) << "they are other lists";
}

TEST(LightSkin, IsExplainedExactlyByLightsAndByObjects) {
    LitBySkin lit(room());
    const Viewpoint view = viewOf();
    lit.update(&view);
    for (const Place& place : places()) {
        FieldReading reading;
        const FieldPoint point = lit.at(place.position, place.normal, place.instance);
        addIrradiance(point, {1, 2, 3}, reading);
        addLobe(point, place.normal, 2, {1, 0.5f}, glm::vec3(0.5f), reading);
        const glm::vec3 value = valueOf(reading, *lit.lighting->field());
        const Explanation e = lit.lighting->explain(lit.scene, reading, {});
        ASSERT_EQ(e.byOrigin.size(), 2U);
        EXPECT_EQ(e.byOrigin[0].label, "Red");
        EXPECT_EQ(e.bySender.size(), 2U) << "the room and the block";
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(totalOf(e.byOrigin)[c], value[c], 1e-4f * value[c]);
            EXPECT_NEAR(totalOf(e.bySender)[c], value[c], 1e-4f * value[c]);
        }
        const Explanation black = lit.lighting->explain(lit.scene, reading, {.black = {1}});
        EXPECT_TRUE(black.bySender.empty());
        for (const LightRow& row : e.bySender)
            if (row.index == 1) {
                const glm::vec3 others = totalOf(e.byOrigin) - row.value;
                EXPECT_NEAR(totalOf(black.byOrigin).x, others.x, 1e-4f * others.x);
            }
    }
}

TEST(LightSkin, IsFiniteForBlackHugeAndBuriedLights) {
    for (const float strength : {0.f, 1e-10f, kMaxLight}) {
        Scene scene = room();
        for (Light& light : scene.lights)
            light.strength = strength;
        scene.lights[0].color = glm::vec3(strength > 1 ? kMaxLight : 1);
        scene.lights[0].position = {1.4f, 0.6f, 1.3f}; // in the block
        Light lamp = scene.lights[0];
        lamp.position = {1.4f, 1.2f, 1.3f}; // on it
        scene.lights.push_back(lamp);
        lamp.kind = LightKind::Directional;
        scene.lights.push_back(lamp);
        LitBySkin lit(scene);
        const Viewpoint view = viewOf();
        lit.update(&view);
        for (const glm::vec3 e : lightOf(lit))
            for (int c = 0; c < 3; ++c)
                EXPECT_TRUE(std::isfinite(e[c]) && e[c] >= 0) << strength;
        for (const glm::vec3 flux : lit.part().light().flux)
            for (int c = 0; c < 3; ++c)
                EXPECT_TRUE(std::isfinite(flux[c]) && flux[c] >= 0) << strength;
    }
    Scene empty = room();
    empty.instances.clear();
    empty.bounds = {};
    LitBySkin lit(empty);
    EXPECT_TRUE(lit.update().whole);
}

// Needles, holes, buried lights, a million triangles, objects far larger than all that is static.
TEST(LightSkin, IsFiniteInHostileScenes) {
    const std::uint64_t seeds = kSanitized ? 15 : 60;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        const HostileScene made = hostileScene(seed);
        SCOPED_TRACE(std::to_string(seed) + " " + made.description);
        Scene scene = flatten(made.document, made.assets);
        scene.technique = {"light-skin",
                           {{"light-skin.map_size", 8},
                            {"light-skin.samples", 16},
                            {"light-skin.vals", 32},
                            {"light-skin.spacing", 10}}};
        LitBySkin lit(scene);
        const Viewpoint view{.camera = chooseCamera(scene, {}), .aspect = 1, .size = {16, 16}};
        EXPECT_TRUE(lit.update(&view).whole);
        for (const glm::vec3 flux : lit.part().light().flux)
            for (int c = 0; c < 3; ++c)
                ASSERT_TRUE(std::isfinite(flux[c]) && flux[c] >= 0);
        for (std::uint32_t i = 0; i < scene.instances.size(); i += 1 + i / 10) {
            const Mesh& mesh = scene.meshOf(scene.instances[i]);
            if (mesh.triangleCount() == 0)
                continue;
            const WorldPoint at = worldPoint(scene, scene.instances[i], {0, glm::vec2(1 / 3.f)});
            const glm::vec3 e = lit.irradiance(at.position, at.normal, i);
            for (int c = 0; c < 3; ++c)
                EXPECT_TRUE(std::isfinite(e[c]) && e[c] >= 0) << i;
        }
    }
}

// A needle a million times as long as all that is static moves by.
TEST(LightSkin, IsMadeInAMomentForDynamicObjectsLargerThanAllThatIsStatic) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::box(glm::vec3(0), glm::vec3(0.1f), true));
    b.add(simple::quad({0, 1, 0}, {1e5f, 0, 0}, {0, 0.001f, 0}), glm::mat4(1), true);
    b.scene.lights = {{.kind = LightKind::Directional, .strength = 1}};
    b.scene.technique.settings = {{"light-skin.map_size", 8}};
    LitBySkin lit(b.build());
    EXPECT_TRUE(lit.update().whole);
    EXPECT_LT(counterOf(lit.update(), "caches"), 3e5);
}

} // namespace
} // namespace limn::light_skin_test
