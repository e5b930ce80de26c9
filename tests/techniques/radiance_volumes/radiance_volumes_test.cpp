// SPDX-License-Identifier: MIT
#include "engine/techniques/radiance_volumes/radiance_volumes.h"

#include "engine/core/parallel.h"
#include "engine/field/field_reading.h"
#include "engine/lighting/lighting_driver.h"
#include "engine/techniques/radiance_volumes/area_lights.h"
#include "tests/techniques/radiance_volumes/lit_by_volumes.h"
#include "tests/techniques/two_lamps.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>
#include <vector>

namespace limn::radiance_volumes_test {
namespace {

/// A room with a block and two lamps of different colours.
Scene room(float scale = 1) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert({0.7f, 0.5f, 0.3f}));
    b.add(simple::box(glm::vec3(0), scale * glm::vec3(4, 3, 5), true));
    b.add(simple::box(scale * glm::vec3(1, 0, 1), scale * glm::vec3(1.8f, 1.2f, 1.6f), false));
    b.scene.lights = twoLamps(scale);
    b.scene.technique.settings = {{"radiance-volumes.read", 16},
                                  {"radiance-volumes.map", 32},
                                  {"radiance-volumes.caches", 500},
                                  {"radiance-volumes.voxels", 32}};
    return b.build();
}

/// On floor, ceiling and walls, in general position.
std::vector<std::pair<glm::vec3, glm::vec3>> places(float scale = 1) {
    return {{scale * glm::vec3(3.03f, 0, 3.11f), {0, 1, 0}},
            {scale * glm::vec3(2.21f, 3, 2.07f), {0, -1, 0}},
            {scale * glm::vec3(0, 1.23f, 2.71f), {1, 0, 0}},
            {scale * glm::vec3(1.43f, 1.2f, 1.31f), {0, 1, 0}}};
}

std::vector<glm::vec3> irradiances(const LitByVolumes& lit, float scale = 1) {
    std::vector<glm::vec3> all;
    for (const auto& [p, n] : places(scale))
        all.push_back(lit.irradiance(p, n));
    return all;
}

Viewpoint view() {
    return viewpointOf({.eye = {3.3f, 1.7f, 4.4f}, .target = {1, 0.4f, 1.3f}}, {48, 32});
}

void expectNear(glm::vec3 a, glm::vec3 b, float share) {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(a[c], b[c], share * std::abs(b[c]));
}

// One bounce in a sphere with a lamp in its middle gives rho Phi / (4 pi R^2), in the air, too.
TEST(RadianceVolumes, LightTheAirOfASphereEvenly) {
    constexpr float kRadius = 2, kIntensity = 10, kAlbedo = 0.5f;
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(kAlbedo)));
    b.add(simple::sphere(kRadius, 4, true));
    b.scene.lights = {{.kind = LightKind::Point, .position = glm::vec3(0), .strength = kIntensity}};
    b.scene.technique.settings = {{"radiance-volumes.caches", 1000},
                                  {"radiance-volumes.shadow", 0}};
    LitByVolumes lit(b.build());
    const float truth = kAlbedo * kIntensity / (kRadius * kRadius);
    const AreaLights lights = areaLightsOf(*lit.trace, lit.scene, lit.scene.lights[0], {});
    const LitAreaLights source{&lights, glm::vec3(kIntensity)};
    for (const float r : {0.f, 0.6f, 1.2f})
        for (const std::uint32_t bands : {2U, 3U}) {
            const CachePlace place{.position = glm::vec3(0.48f, 0.6f, 0.64f) * r};
            const CacheLight light = lightCaches(std::span(&place, 1),
                                                 {.lights = std::span(&source, 1), .bands = bands});
            for (const glm::vec3 n : {glm::vec3(1, 0, 0), glm::vec3(0, -0.6f, 0.8f)})
                EXPECT_NEAR(shIrradiance(int(bands), light.harmonics.data(), n).x, truth,
                            0.05f * truth)
                    << r << ' ' << bands;
        }
    lit.update();
    for (const glm::vec3 n : {glm::vec3(1, 0, 0), glm::vec3(-0.6f, 0.8f, 0)}) {
        const float e = lit.irradiance(n * kRadius, -n).x;
        std::printf("sphere, on its surface: %.3f of the truth\n", double(e / truth));
        EXPECT_NEAR(e, truth, 0.05f * truth);
    }
}

// Two walls back to back, of which a sun lights one: what the other faces gets nothing.
TEST(RadianceVolumes, LightNothingBehindALitWall) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::quad({0, -1, -1}, {0, 2, 0}, {0, 0, 2}));
    b.add(simple::quad({0, -1, -1}, {0, 0, 2}, {0, 2, 0}));
    for (const float x : {-2.f, 2.f})
        b.add(simple::quad({x, -1, -1}, x < 0 ? glm::vec3(0, 2, 0) : glm::vec3(0, 0, 2),
                           x < 0 ? glm::vec3(0, 0, 2) : glm::vec3(0, 2, 0)));
    b.scene.lights = {{.kind = LightKind::Spot, // behind the wall that it would otherwise light
                       .position = glm::vec3(1.9f, 0, 0),
                       .direction = glm::vec3(-1, 0, 0),
                       .strength = 10,
                       .outerAngle = 0.4f}};
    for (const double shadow : {0., 1.}) {
        Scene scene = b.build();
        scene.technique.settings = {{"radiance-volumes.shadow", shadow},
                                    {"radiance-volumes.caches", 2000}};
        LitByVolumes lit(scene);
        lit.update();
        EXPECT_GT(lit.irradiance({2, 0.1f, 0.1f}, {-1, 0, 0}).x, 0.01f);
        EXPECT_EQ(lit.irradiance({-2, 0.1f, 0.1f}, {1, 0, 0}), glm::vec3(0));
    }
}

// Light leaks through walls that are thinner than a cell: the nodes on both sides are mixed. What
// leaks through thicker ones passes the cones.
TEST(RadianceVolumes, LeakLessThroughAThickerWall) {
    std::vector<float> leaks;
    for (const float cells : {0.05f, 0.25f, 1.f, 2.f}) {
        constexpr float kCell = 4 / 18.f;
        const float half = cells * kCell / 2;
        simple::SceneBuilder b;
        b.addMaterial(simple::lambert(glm::vec3(0.5f)));
        b.add(simple::box({-2, 0, 0}, {-half, 2, 2}, true));
        b.add(simple::box({half, 0, 0}, {2, 2, 2}, true));
        b.scene.lights = {
            {.kind = LightKind::Point, .position = glm::vec3(-1, 1, 1), .strength = 10}};
        b.scene.technique.settings = {{"radiance-volumes.read", 16},
                                      {"radiance-volumes.map", 64},
                                      {"radiance-volumes.caches", 2000}};
        LitByVolumes lit(b.build());
        lit.update();
        const float bright = lit.irradiance({-1, 0, 1}, {0, 1, 0}).x;
        const float dark = lit.irradiance({1, 0, 1}, {0, 1, 0}).x;
        std::printf("wall of %.2f cells of %.3f m: leak %.5f\n", double(cells),
                    double(lit.part().caches->grids.grids[0].cell), double(dark / bright));
        leaks.push_back(dark / bright);
    }
    EXPECT_LT(leaks[3], 0.01f);
    EXPECT_LT(leaks[0], 0.1f);
}

TEST(RadianceVolumes, AreTheSameAtEveryScale) {
    for (const bool ofView : {false, true}) {
        const auto lit = [&](float scale) {
            LitByVolumes scaled(room(scale));
            Viewpoint v = view();
            v.camera.eye *= scale;
            v.camera.target *= scale;
            scaled.update(ofView ? &v : nullptr);
            return irradiances(scaled, scale);
        };
        const std::vector<glm::vec3> one = lit(1);
        for (const float scale : {1e-3f, 0.1f, 10.f, 1e3f}) {
            const std::vector<glm::vec3> e = lit(scale);
            for (std::size_t i = 0; i < one.size(); ++i)
                expectNear(e[i], one[i], 0.01f);
        }
    }
}

TEST(RadianceVolumes, DoubleWithTheLightsAndAddThem) {
    LitByVolumes lit(room());
    lit.update();
    const std::vector<glm::vec3> both = irradiances(lit);
    for (Light& light : lit.scene.lights)
        light.strength *= 2;
    lit.update();
    const std::vector<glm::vec3> twice = irradiances(lit);
    for (std::size_t i = 0; i < both.size(); ++i) {
        EXPECT_GT(both[i].x, 0);
        EXPECT_EQ(twice[i], 2.f * both[i]);
    }
    std::vector<glm::vec3> sum(both.size(), glm::vec3(0));
    for (const std::size_t off : {0U, 1U}) {
        lit.scene.lights = room().lights;
        lit.scene.lights[off].enabled = false;
        lit.update();
        const std::vector<glm::vec3> alone = irradiances(lit);
        for (std::size_t i = 0; i < sum.size(); ++i)
            sum[i] += alone[i];
    }
    for (std::size_t i = 0; i < both.size(); ++i)
        expectNear(sum[i], both[i], 1e-5f);
}

TEST(RadianceVolumes, HaveTheSameBitsForAnyNumberOfThreadsAndForAViewThatComesBack) {
    const Viewpoint here = view();
    Viewpoint there = here;
    there.camera.target = {4, 1, 0};
    LitByVolumes lit(room());
    lit.set("glossy", 1);
    lit.update(&here);
    const IndirectField first = *lit.lighting->field();
    lit.update(&there);
    EXPECT_FALSE(lit.lighting->field()->parts[0]->equals(*first.parts[0]));
    lit.update(&here);
    EXPECT_TRUE(lit.lighting->field()->parts[0]->equals(*first.parts[0]));
    const ThreadLimit one(1);
    LitByVolumes single(lit.scene);
    single.update(&here);
    EXPECT_TRUE(single.lighting->field()->parts[0]->equals(*first.parts[0]));
}

TEST(RadianceVolumes, LightWhatTheViewShowsAndNothingElse) {
    LitByVolumes lit(room());
    lit.set("caches", 4096);
    EXPECT_TRUE(lit.lighting->isOfView());
    const LightingReport all = lit.update();
    EXPECT_EQ(counterOf(all, "view_rays"), 0);
    const glm::vec3 behind(3.9f, 2.5f, 5);
    EXPECT_GT(lit.irradiance(behind, {0, 0, -1}).x, 0);
    const Viewpoint v = view();
    const LightingReport report = lit.update(&v);
    EXPECT_EQ(counterOf(report, "view_rays"), 48 * 32);
    EXPECT_EQ(counterOf(report, "lights_traced"), 0);
    EXPECT_EQ(counterOf(report, "pixels_missed"), 0);
    EXPECT_EQ(counterOf(report, "caches"), counterOf(report, "caches_0") +
                                               counterOf(report, "caches_1") +
                                               counterOf(report, "caches_2"));
    EXPECT_GT(lit.irradiance({1.43f, 1.2f, 1.31f}, {0, 1, 0}).x, 0);
    EXPECT_EQ(lit.irradiance(behind, {0, 0, -1}), glm::vec3(0)) << "the eye looks the other way";
}

TEST(RadianceVolumes, KeepTheCachesOfAFrozenView) {
    LitByVolumes lit(room());
    const Viewpoint here = view();
    Viewpoint there = here;
    there.camera.eye.x -= 1;
    lit.update(&here);
    const auto address = lit.part().caches->address;
    lit.set("freeze", 1);
    lit.update(&there);
    EXPECT_EQ(lit.part().caches->address, address);
    EXPECT_TRUE(lit.update(&here).skipped);
    lit.set("freeze", 0);
    lit.update(&there);
    EXPECT_NE(lit.part().caches->address, address);
}

TEST(RadianceVolumes, TraceOnlyWhatChanged) {
    LitByVolumes lit(room());
    const Viewpoint v = view();
    const LightingReport first = lit.update(&v);
    EXPECT_EQ(counterOf(first, "lights_traced"), 2);
    EXPECT_GT(counterOf(first, "shadow_rays"), 0);
    EXPECT_GT(counterOf(first, "cones"), 0);
    const std::uint64_t version = lit.lighting->field()->version;
    EXPECT_TRUE(lit.update(&v).skipped);
    EXPECT_EQ(lit.lighting->field()->version, version);

    const auto changed = [&](double traced, bool viewed, const char* what) {
        const LightingReport report = lit.update(&v);
        EXPECT_FALSE(report.skipped) << what;
        EXPECT_EQ(counterOf(report, "lights_traced"), traced) << what;
        EXPECT_EQ(counterOf(report, "view_rays") > 0, viewed) << what;
        EXPECT_TRUE(lit.update(&v).skipped) << what;
        LitByVolumes anew(lit.scene);
        anew.update(&v);
        EXPECT_TRUE(anew.part().equals(lit.part())) << what;
    };
    lit.scene.lights[0].color = glm::vec3(0, 1, 0);
    changed(0, false, "colour");
    lit.scene.lights[1].enabled = false;
    changed(0, false, "off");
    lit.scene.lights[1].enabled = true;
    changed(0, false, "on again");
    lit.scene.lights[0].position.y -= 0.3f;
    changed(1, false, "a light moved");
    lit.set("bands", 3);
    changed(0, false, "bands");
    lit.set("voxels", 16);
    changed(0, false, "voxels");
    lit.set("rate", 0.5); // what does not move does not fade
    changed(0, false, "rate");
    lit.set("shadow", 2);
    changed(0, false, "published cones");
    lit.set("shadow", 0);
    changed(0, false, "no shadows");
    lit.set("nodes", 20);
    changed(0, true, "nodes");
    lit.set("level", 1);
    changed(2, false, "level");
    lit.scene.materials[0].baseColor.x *= 0.5f;
    changed(2, true, "albedo");
    lit.scene.instances[1].toWorld[3].z += 1.f;
    lit.retrace();
    changed(2, true, "an object moved");
    lit.scene.lights[0].name = "Renamed";
    EXPECT_TRUE(lit.update(&v).skipped);
}

TEST(RadianceVolumes, AreFiniteForBlackHugeAndBuriedLightsAndWithoutAny) {
    Scene scene = room();
    scene.lights[0].strength = scene.lights[1].strength = kMaxLight;
    scene.lights[0].color = glm::vec3(kMaxLight);
    scene.lights.push_back(
        {.kind = LightKind::Point, .position = glm::vec3(1.4f, 0.5f, 1.3f)}); // in the block
    scene.lights.push_back({.kind = LightKind::Spot, .position = glm::vec3(-50)});
    scene.lights.push_back({.kind = LightKind::Directional, .color = glm::vec3(0)});
    scene.technique.settings["radiance-volumes.bands"] = 3;
    scene.technique.settings["radiance-volumes.glossy"] = 1;
    LitByVolumes lit(scene);
    const Viewpoint v = view();
    for (const Viewpoint* shown : {&v, static_cast<const Viewpoint*>(nullptr)}) {
        lit.update(shown);
        for (const auto* numbers : {&lit.part().light.harmonics, &lit.part().light.glossy})
            for (const glm::vec3 value : *numbers)
                for (int c = 0; c < 3; ++c)
                    ASSERT_TRUE(std::isfinite(value[c]));
    }
    lit.scene.lights.clear();
    const LightingReport dark = lit.update();
    EXPECT_EQ(counterOf(dark, "cones"), 0);
    for (const glm::vec3 e : irradiances(lit))
        EXPECT_EQ(e, glm::vec3(0));
    LitByVolumes empty{simple::SceneBuilder().build()};
    EXPECT_TRUE(empty.update().converged);
    EXPECT_TRUE(empty.update(&v).converged);
}

TEST(RadianceVolumes, KeepTheirLightWhenCancelledAndCatchUp) {
    LitByVolumes lit(room());
    lit.update();
    const auto before = lit.lighting->field()->parts[0];
    lit.scene.lights[0].position.x -= 1;
    const std::atomic<bool> cancel = true;
    const LightingReport report = lit.update(nullptr, {.report = {}, .cancel = &cancel});
    EXPECT_FALSE(report.converged || report.whole || report.skipped);
    EXPECT_EQ(lit.lighting->field()->parts[0], before);
    EXPECT_TRUE(lit.update().converged);
    LitByVolumes anew(lit.scene);
    anew.update();
    EXPECT_TRUE(anew.part().equals(lit.part()));
}

/// A block of x = -0.4 ... 0.2, instance 2, between a wall that a spot lights and the floor behind.
Scene shadowOfABlock() {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.7f)));
    b.add(simple::quad({-3, 0, -2}, {0, 0, 4}, {6, 0, 0}));
    b.add(simple::quad({3, 0, -2}, {0, 0, 4}, {0, 3, 0}));
    b.add(simple::box({-0.4f, 0, -2}, {0.2f, 2.5f, 2}, false));
    b.scene.lights = {{.kind = LightKind::Spot,
                       .position = glm::vec3(1, 1, 0),
                       .direction = glm::vec3(1, 0, 0),
                       .strength = 10,
                       .outerAngle = 0.35f}};
    b.scene.technique.settings = {{"radiance-volumes.read", 16}};
    return b.build();
}

// The bounce off the far wall is hidden from the floor behind the block by cones alone.
TEST(RadianceVolumes, CastShadows) {
    float behind[2], before[2];
    for (const int shadow : {0, 1}) {
        LitByVolumes lit(shadowOfABlock());
        lit.set("shadow", shadow);
        lit.update();
        behind[shadow] = lit.irradiance({-1.2f, 0, 0}, {0, 1, 0}).x;
        before[shadow] = lit.irradiance({1.2f, 0, 0}, {0, 1, 0}).x;
    }
    std::printf("behind a block: %.4f of the light that would arrive, before it %.4f\n",
                double(behind[1] / behind[0]), double(before[1] / before[0]));
    EXPECT_LT(behind[1], 0.1f * behind[0]);
    EXPECT_GT(before[1], 0.75f * before[0]);
}

// The block moves into the way of the light. Its voxels take four updates of 64 255ths to fade in.
TEST(RadianceVolumes, LetShadowsFadeInUntilTheirBitsAreThoseAtOnce) {
    const glm::vec3 p(-1.2f, 0, 0), up(0, 1, 0);
    for (const std::uint32_t maxBounces : {1U, 64U}) {
        LitByVolumes lit(shadowOfABlock());
        lit.scene.relight.maxBounces = maxBounces;
        lit.set("rate", 0.25);
        lit.set("voxels", 32);
        lit.set("caches", 500);
        lit.scene.instances[2].toWorld[3].x = -2;
        lit.retrace();
        EXPECT_TRUE(lit.update().converged) << "nothing was shown before";
        float before = lit.irradiance(p, up).x;
        lit.scene.instances[2].toWorld[3].x = 0;
        lit.retrace();
        LightingDriver driver(std::move(lit.lighting));
        driver.lightChanged();
        int updates = 0;
        for (; !driver.done() && updates < 10; ++updates) {
            const auto report = driver.step({.scene = lit.scene, .trace = lit.trace.get()},
                                            LightingDriver::Rest::All);
            ASSERT_TRUE(report);
            EXPECT_FALSE(report->skipped);
            EXPECT_EQ(report->converged, updates == 3);
            const IndirectField& field = *driver.lighting()->field();
            const float e =
                sampleIrradiance({field, lit.layout, lit.scene, 0, 0, 0.3f, 0.3f, p, up}).x;
            EXPECT_LT(e, before);
            before = e;
        }
        EXPECT_EQ(updates, 4);
        LitByVolumes anew(lit.scene);
        anew.update();
        EXPECT_TRUE(anew.part().equals(*driver.lighting()->field()->parts[0]));
        EXPECT_TRUE(
            driver.lighting()->update({.scene = lit.scene, .trace = lit.trace.get()}, {}).skipped);
    }
}

// Nothing stands in an empty room: what cones take away there is the walls' own voxels, here those
// of a floor along which light comes from a patch of a wall.
TEST(RadianceVolumes, HardlyShadowAnEmptyRoom) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.7f)));
    b.add(simple::box(glm::vec3(0), glm::vec3(4, 3, 5), true));
    b.scene.lights = {{.kind = LightKind::Spot,
                       .position = glm::vec3(2, 0.6f, 2.5f),
                       .direction = glm::vec3(1, 0, 0),
                       .strength = 10,
                       .outerAngle = 0.25f}};
    std::vector<glm::vec3> light[2];
    for (const int shadow : {0, 1}) {
        Scene scene = b.build();
        scene.technique.settings = {{"radiance-volumes.shadow", shadow},
                                    {"radiance-volumes.read", 16},
                                    {"radiance-volumes.caches", 2000}};
        LitByVolumes lit(scene);
        lit.update();
        for (const float x : {1.f, 2.f, 3.f})
            light[shadow].push_back(lit.irradiance({x, 0, 2.3f}, {0, 1, 0}));
    }
    for (std::size_t i = 0; i < light[0].size(); ++i) {
        std::printf("empty room: %.3f of the light passes\n",
                    double(light[1][i].x / light[0][i].x));
        EXPECT_GT(light[1][i].x, 0.9f * light[0][i].x);
    }
}

TEST(RadianceVolumes, ExplainLightExactlyByLightAndByObject) {
    for (const bool glossy : {false, true}) {
        Scene scene = room();
        scene.technique.settings["radiance-volumes.glossy"] = glossy ? 1 : 0;
        scene.technique.settings["radiance-volumes.fill"] = 2;
        scene.materials.push_back(scene.materials[0]);
        scene.instances[1].material = 1;
        LitByVolumes lit(scene);
        const Viewpoint v = view();
        lit.update(&v);
        const glm::vec3 p(1.43f, 1.2f, 1.31f), n(0, 1, 0);
        const std::array<float, kMaxBands> factors = {1, 0.5f};
        const auto valueNow = [&] {
            return sampleIrradiance(lit.point(p, n)) +
                   sampleLobe(lit.point(p, n), glm::normalize(glm::vec3(0.2f, 1, 0)), 2, factors);
        };
        FieldReading reading;
        addIrradiance(lit.point(p, n), glm::vec3(1), reading);
        addLobe(lit.point(p, n), glm::normalize(glm::vec3(0.2f, 1, 0)), 2, factors, glm::vec3(1),
                reading);
        const Explanation e = lit.lighting->explain(lit.scene, reading, {});
        const Explanation black = lit.lighting->explain(lit.scene, reading, {.black = {1}});
        const glm::vec3 all = valueNow();
        EXPECT_GT(all.x, 0);
        ASSERT_EQ(e.byOrigin.size(), 2U);
        EXPECT_EQ(e.byOrigin[1].label, "Blue");
        EXPECT_EQ(e.byOrigin[1].index, 1U);
        ASSERT_EQ(e.bySender.size(), 2U);
        EXPECT_EQ(e.bySender[0].kind, LightRowKind::Surface);
        expectNear(totalOf(e.byOrigin), all, 2e-5f);
        expectNear(totalOf(e.bySender), all, 2e-5f);

        if (!glossy) { // other texels would be dark, and filled
            lit.scene.lights[0].enabled = false;
            lit.update(&v);
            expectNear(e.byOrigin[1].value, valueNow(), 2e-5f);
        }
        const glm::vec3 left = totalOf(black.byOrigin);
        const std::size_t block = e.bySender[0].index == 1 ? 0 : 1;
        expectNear(all, left + e.bySender[block].value, 2e-5f);
        EXPECT_TRUE(black.bySender.empty());
    }
}

// Light comes from a small patch of the wall at y = 1: caches above and below it are next to each
// other. One whose irradiance is clamped to 0 sends nothing to the point.
TEST(RadianceVolumes, ExplainLightOfClampedCachesExactly) {
    Scene scene = shadowOfABlock();
    scene.lights[0].outerAngle = 0.05f;
    LitByVolumes mixed(scene), clamped(scene);
    clamped.set("clamp", 1);
    mixed.update();
    clamped.update();
    int differing = 0;
    for (const float y : {0.8f, 0.85f, 1.15f, 1.2f})
        for (const glm::vec3 n : {glm::vec3(0, 1, 0), glm::vec3(0, -1, 0)}) {
            const glm::vec3 p(2.9f, y, 0.1f);
            const glm::vec3 e = clamped.irradiance(p, n);
            FieldReading reading;
            addIrradiance(clamped.point(p, n), glm::vec3(1), reading);
            const Explanation why = clamped.lighting->explain(clamped.scene, reading, {});
            expectNear(totalOf(why.byOrigin), e, 2e-5f);
            expectNear(totalOf(why.bySender), e, 2e-5f);
            const float mean = mixed.irradiance(p, n).x;
            EXPECT_GE(e.x, mean * (1 - 1e-5f));
            differing += e.x > 1.01f * mean ? 1 : 0;
        }
    EXPECT_EQ(differing, 4);
}

} // namespace
} // namespace limn::radiance_volumes_test
