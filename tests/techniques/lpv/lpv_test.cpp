// SPDX-License-Identifier: MIT
#include "engine/techniques/lpv/lpv.h"

#include "engine/core/parallel.h"
#include "engine/field/field_reading.h"
#include "engine/field/sample_field.h"
#include "engine/lightmap/atlas.h"
#include "engine/techniques/lpv/injected_lights.h"
#include "engine/techniques/lpv/lpv_settings.h"
#include "tests/techniques/two_lamps.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <numbers>

namespace limn::lpv_test {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

/// A scene lit by the technique.
struct Lit {
    Scene scene;
    LightmapLayout layout;
    std::unique_ptr<TraceScene> trace;
    std::unique_ptr<Lighting> lighting = kLpvTechnique.light({});

    explicit Lit(const Scene& of) : scene(of), layout(layoutWithoutLightmap(scene)) { retrace(); }
    void retrace() { trace = std::make_unique<TraceScene>(scene); }
    LightingReport update(const Progress& progress = {}) {
        return lighting->update({.scene = scene, .trace = trace.get()}, progress);
    }
    FieldPoint at(glm::vec3 p, glm::vec3 n) const {
        return {.field = *lighting->field(),
                .layout = layout,
                .scene = scene,
                .instance = 0,
                .triangle = 0,
                .u = 0,
                .v = 0,
                .position = p,
                .normal = n};
    }
    glm::vec3 irradiance(glm::vec3 p, glm::vec3 n) const { return sampleIrradiance(at(p, n)); }
};

/// A room with a block and two lamps of different colours.
Scene room(float scale = 1) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert({0.7f, 0.5f, 0.3f}));
    b.add(simple::box(glm::vec3(0), scale * glm::vec3(4, 3, 5), true));
    b.add(simple::box(scale * glm::vec3(1, 0, 1), scale * glm::vec3(1.8f, 1.2f, 1.6f), false));
    b.scene.lights = twoLamps(scale);
    b.scene.technique.settings = {{"lpv.resolution", 16}, {"lpv.map_size", 32}, {"lpv.rounds", 16}};
    return b.build();
}

/// On floor, ceiling and walls.
std::vector<std::pair<glm::vec3, glm::vec3>> places(float scale = 1) {
    return {{scale * glm::vec3(3, 0, 3), {0, 1, 0}},
            {scale * glm::vec3(2.2f, 3, 2), {0, -1, 0}},
            {scale * glm::vec3(0, 1.2f, 2.7f), {1, 0, 0}},
            {scale * glm::vec3(1.4f, 1.2f, 1.3f), {0, 1, 0}}};
}

std::vector<glm::vec3> irradiances(const Lit& lit, float scale = 1) {
    std::vector<glm::vec3> all;
    for (const auto& [p, n] : places(scale))
        all.push_back(lit.irradiance(p, n));
    return all;
}

double stepsMs(const LightingReport& report) {
    double ms = 0;
    for (const LightingStep& step : report.steps)
        ms += step.ms;
    return ms;
}

// The truth of one bounce is rho Phi / (4 pi R^2) everywhere. Diffusion loses light on its way
// through the sphere, and what the wall's own cells hold is read again.
TEST(Lpv, LightsASphereEvenlyAndLessThanItShould) {
    constexpr float kRadius = 2, kIntensity = 10, kAlbedo = 0.5f;
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(kAlbedo)));
    b.add(simple::sphere(kRadius, 5, true));
    b.scene.lights = {{.kind = LightKind::Point, .position = glm::vec3(0), .strength = kIntensity}};
    Lit lit(b.build());
    const float truth = kAlbedo * kIntensity / (kRadius * kRadius);
    for (const double rounds : {16., 200.}) {
        lit.scene.technique.settings = {{"lpv.rounds", rounds}};
        lit.update();
        float lowest = std::numeric_limits<float>::max(), highest = 0;
        for (int axis = 0; axis < 3; ++axis)
            for (const float sign : {-1.f, 1.f}) {
                glm::vec3 n(0);
                n[axis] = sign;
                const float e = lit.irradiance(n * kRadius, -n).x;
                lowest = std::min(lowest, e);
                highest = std::max(highest, e);
            }
        std::printf("sphere, %g rounds: %.3f to %.3f of the truth\n", rounds,
                    double(lowest / truth), double(highest / truth));
        EXPECT_GT(lowest, 0);
        EXPECT_LT(highest / lowest, 1.05f) << "symmetric";
        EXPECT_LT(highest, truth);
    }
}

// The truth for a square of radiosity B that faces the receiver at height h is
// B (4 / pi) k atan k, k = X / sqrt(1 + X^2), X = a / h, with a the half-side.
TEST(Lpv, ReceivesLessAboveALitSquareWithHeight) {
    constexpr float kHalf = 1, kAlbedo = 0.5f, kSun = 10;
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(kAlbedo)));
    b.add(simple::quad({-kHalf, 0, -kHalf}, {0, 0, 2 * kHalf}, {2 * kHalf, 0, 0}));
    for (const float far : {-3.f, 3.f}) // specks that make the lattice large
        b.add(simple::quad({far, 4, far}, {0.01f, 0, 0}, {0, 0, 0.01f}));
    b.scene.lights = {{.kind = LightKind::Directional, .strength = kSun}};
    b.scene.technique.settings = {{"lpv.rounds", 64}};
    Lit lit(b.build());
    lit.update();
    float before = std::numeric_limits<float>::max();
    for (const float h : {0.5f, 1.f, 2.f}) {
        const float x = kHalf / h, k = x / std::sqrt(1 + x * x);
        const float truth = kAlbedo * kSun * 4 / kPi * k * std::atan(k);
        const float e = lit.irradiance({0, h, 0}, {0, -1, 0}).x;
        std::printf("square, height %g: %.3f, truth %.3f\n", double(h), double(e), double(truth));
        EXPECT_GT(e, 0);
        EXPECT_LT(e, before);
        EXPECT_GT(e, lit.irradiance({0, h, 0}, {0, 1, 0}).x) << "it comes from below";
        EXPECT_NEAR(e, lit.irradiance({0.01f, h, 0.01f}, {0, -1, 0}).x, 0.1f * e) << "smooth";
        before = e;
    }
}

// Light leaks through a wall between two rooms, more through a thin one. The specification asks
// for the number; no bound holds for this technique below a thickness of a cell.
TEST(Lpv, LeaksLessThroughAThickerWall) {
    std::vector<float> leaks;
    for (const float cells : {0.05f, 0.25f, 1.f, 2.f}) {
        constexpr float kCell = 4 / 32.f;
        const float half = cells * kCell / 2;
        simple::SceneBuilder b;
        b.addMaterial(simple::lambert(glm::vec3(0.5f)));
        b.add(simple::box({-2, 0, 0}, {-half, 2, 2}, true));
        b.add(simple::box({half, 0, 0}, {2, 2, 2}, true));
        b.scene.lights = {
            {.kind = LightKind::Point, .position = glm::vec3(-1, 1, 1), .strength = 10}};
        b.scene.technique.settings = {{"lpv.rounds", 64}};
        Lit lit(b.build());
        lit.update();
        const float bright = lit.irradiance({-1, 0, 1}, {0, 1, 0}).x;
        const float dark = lit.irradiance({1, 0, 1}, {0, 1, 0}).x;
        std::printf("wall of %.2f cells: leak %.4f\n", double(cells), double(dark / bright));
        leaks.push_back(dark / bright);
    }
    EXPECT_LT(leaks[3], leaks[0]);
    EXPECT_LT(leaks[0], 1);
}

TEST(Lpv, IsTheSameAtEveryScale) {
    Lit lit(room());
    lit.update();
    const std::vector<glm::vec3> one = irradiances(lit);
    for (const float scale : {1e-3f, 0.1f, 10.f, 1e3f}) {
        Lit scaled(room(scale));
        scaled.update();
        const std::vector<glm::vec3> e = irradiances(scaled, scale);
        for (std::size_t i = 0; i < one.size(); ++i)
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(e[i][c], one[i][c], 0.01f * one[i][c]) << scale;
    }
}

// Doubling is exact. The sum of two lights is so but for the clamp: where their lobes point away
// from each other, less of their sum is negative.
TEST(Lpv, DoublesWithTheLightsAndAddsThemUpToTheClamp) {
    Lit lit(room());
    lit.update();
    const std::vector<glm::vec3> both = irradiances(lit);
    for (Light& light : lit.scene.lights)
        light.strength *= 2;
    lit.update();
    const std::vector<glm::vec3> twice = irradiances(lit);
    for (std::size_t i = 0; i < both.size(); ++i)
        EXPECT_EQ(twice[i], 2.f * both[i]);
    std::vector<glm::vec3> sum(both.size(), glm::vec3(0));
    for (const std::size_t off : {0U, 1U}) {
        lit.scene = room();
        lit.scene.lights[off].enabled = false;
        lit.update();
        const std::vector<glm::vec3> alone = irradiances(lit);
        for (std::size_t i = 0; i < sum.size(); ++i)
            sum[i] += alone[i];
    }
    double worst = 0;
    for (std::size_t i = 0; i < both.size(); ++i)
        for (int c = 0; c < 3; ++c)
            worst = std::max(worst, std::abs(double(sum[i][c] / both[i][c]) - 1));
    std::printf("two lights: sum differs by up to %.4f\n", worst);
    EXPECT_LT(worst, 0.138) << "the share that the clamp adds to a single plane's light";
}

// 4 / s^2 for a point light half a cell away, 2 pi / 3 / s^2 for the flux through a cell's face.
TEST(Lpv, LooksUpAPointLightOrTheArrivingFlux) {
    Lit lit(room());
    lit.update();
    const std::vector<glm::vec3> flux = irradiances(lit);
    lit.scene.technique.settings["lpv.flux_lookup"] = 0;
    lit.update();
    const std::vector<glm::vec3> point = irradiances(lit);
    for (std::size_t i = 0; i < flux.size(); ++i)
        EXPECT_NEAR(point[i].x / flux[i].x, 6 / kPi, 1e-5f);
}

TEST(Lpv, HasTheSameBitsForAnyNumberOfThreads) {
    Lit many(room());
    many.update();
    const ThreadLimit one(1);
    Lit single(room());
    single.update();
    EXPECT_EQ(single.lighting->field()->grid, many.lighting->field()->grid);
}

TEST(Lpv, CastsRaysOnlyForLightsWhoseMapChanged) {
    Lit lit(room());
    const LightingReport first = lit.update();
    EXPECT_EQ(counterOf(first, "lights_traced"), 2);
    EXPECT_GT(counterOf(first, "shadow_rays"), 0);
    EXPECT_GT(first.totalMs, 0);
    EXPECT_LE(stepsMs(first), first.totalMs * 1.001 + 0.01);
    const std::uint64_t version = lit.lighting->field()->version;
    LightingReport report = lit.update();
    EXPECT_TRUE(report.skipped);
    EXPECT_EQ(lit.lighting->field()->version, version);

    const auto changed = [&](double traced, const char* what) {
        const std::vector<glm::vec3> before = irradiances(lit);
        report = lit.update();
        EXPECT_FALSE(report.skipped) << what;
        EXPECT_EQ(counterOf(report, "lights_traced"), traced) << what;
        EXPECT_EQ(counterOf(report, "shadow_rays") > 0, traced > 0) << what;
        EXPECT_NE(irradiances(lit), before) << what;
        EXPECT_TRUE(lit.update().skipped) << what;
        Lit anew(lit.scene);
        anew.update();
        EXPECT_EQ(anew.lighting->field()->grid, lit.lighting->field()->grid) << what;
    };
    lit.scene.lights[0].color = glm::vec3(0, 1, 0);
    changed(0, "colour");
    lit.scene.lights[1].strength *= 3;
    changed(0, "strength");
    lit.scene.lights[1].enabled = false;
    changed(0, "off");
    lit.scene.lights[1].enabled = true;
    changed(0, "on again");
    lit.scene.lights[0].position.y -= 0.3f;
    changed(1, "a light moved");
    lit.scene.technique.settings["lpv.rounds"] = 5;
    changed(0, "rounds");
    lit.scene.technique.settings["lpv.flux_lookup"] = 0;
    changed(0, "lookup");
    lit.scene.materials[0].baseColor.x *= 0.5f;
    changed(2, "albedo");
    lit.scene.instances[1].toWorld[3].z += 1.f;
    lit.retrace();
    changed(2, "an object moved");
    lit.scene.technique.settings["lpv.resolution"] = 12;
    changed(2, "resolution");

    lit.scene.lights[0].name = "Renamed";
    lit.scene.materials[0].roughness = 0.3f;
    EXPECT_TRUE(lit.update().skipped) << "neither changes diffuse light";
}

// With 0 rounds to choose, they grow with the lattice, so that light crosses a room at any size.
TEST(Lpv, RoundsAreHalfOfTheCellsUnlessTold) {
    TechniqueChoice choice{.technique = "lpv", .settings = {{"lpv.resolution", 48}}};
    EXPECT_EQ(lpvSettingsOf(choice).rounds, 24U);
    choice.settings["lpv.rounds"] = 5;
    EXPECT_EQ(lpvSettingsOf(choice).rounds, 5U);
    EXPECT_EQ(lpvSettingsOf({}).rounds, 16U);
}

TEST(Lpv, IsFiniteForBlackHugeAndBuriedLightsAndWithoutAny) {
    Scene scene = room();
    scene.lights[0].strength = scene.lights[1].strength = kMaxLight;
    scene.lights[0].color = glm::vec3(kMaxLight);
    scene.lights.push_back(
        {.kind = LightKind::Point, .position = glm::vec3(1.4f, 0.5f, 1.3f)}); // in the block
    scene.lights.push_back({.kind = LightKind::Spot, .position = glm::vec3(-50)});
    scene.lights.push_back({.kind = LightKind::Directional, .color = glm::vec3(0)});
    Lit lit(scene);
    lit.update();
    for (const glm::vec4 value : lit.lighting->field()->grid)
        for (int c = 0; c < 3; ++c)
            ASSERT_TRUE(std::isfinite(value[c]));
    lit.scene.lights.clear();
    const LightingReport dark = lit.update();
    EXPECT_EQ(counterOf(dark, "rounds"), 0) << "no light, no round";
    for (const glm::vec3 e : irradiances(lit))
        EXPECT_EQ(e, glm::vec3(0));
    Lit empty{simple::SceneBuilder().build()};
    EXPECT_TRUE(empty.update().converged);
}

TEST(Lpv, KeepsItsLightWhenCancelledAndCatchesUp) {
    Lit lit(room());
    lit.update();
    const std::vector<glm::vec4> before = lit.lighting->field()->grid;
    lit.scene.lights[0].position.x -= 1;
    const std::atomic<bool> cancel = true;
    const LightingReport report = lit.update({.report = {}, .cancel = &cancel});
    EXPECT_FALSE(report.converged || report.whole || report.skipped);
    EXPECT_EQ(lit.lighting->field()->grid, before);
    EXPECT_TRUE(lit.update().converged);
    Lit anew(lit.scene);
    anew.update();
    EXPECT_EQ(anew.lighting->field()->grid, lit.lighting->field()->grid);
}

TEST(Lpv, ExplainsALightByWhatItGivesAlone) {
    Lit lit(room());
    lit.update();
    const auto [p, n] = places()[0];
    FieldReading reading;
    addIrradiance(lit.at(p, n), glm::vec3(1), reading);
    const Explanation e = lit.lighting->explain(lit.scene, reading, {});
    ASSERT_EQ(e.byOrigin.size(), 3U);
    EXPECT_EQ(e.byOrigin[1].label, "Blue");
    EXPECT_EQ(e.byOrigin[1].kind, LightRowKind::Light);
    EXPECT_EQ(e.byOrigin[1].index, 1U);
    EXPECT_EQ(e.byOrigin[2].kind, LightRowKind::Remainder);
    const glm::vec3 all = lit.irradiance(p, n);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(totalOf(e.byOrigin)[c], all[c], 1e-5f * all[c]);
        EXPECT_NEAR(totalOf(e.bySender)[c], all[c], 1e-5f * all[c]);
    }
    lit.scene.lights[0].enabled = false;
    lit.update();
    const glm::vec3 blue = lit.irradiance(p, n);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(e.byOrigin[1].value[c], blue[c], 1e-5f * blue[c]);
    EXPECT_EQ(lit.lighting->explain(lit.scene, reading, {}).byOrigin.size(), 1U)
        << "nothing is left over of one light";
}

TEST(Lpv, ExplainsWhatIsLeftWhereASurfaceReflectsNothing) {
    Scene scene = room();
    scene.materials.push_back(scene.materials[0]);
    scene.instances[1].material = 1;
    Lit lit(scene);
    lit.update();
    const auto [p, n] = places()[0];
    FieldReading reading;
    addIrradiance(lit.at(p, n), glm::vec3(1), reading);
    const Explanation black = lit.lighting->explain(lit.scene, reading, {.black = {1}});
    EXPECT_TRUE(black.bySender.empty());
    const glm::vec3 before = lit.irradiance(p, n);
    lit.scene.materials[1].baseColor = glm::vec4(0, 0, 0, 1);
    lit.update();
    const glm::vec3 left = lit.irradiance(p, n);
    EXPECT_LT(left.x, before.x);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(totalOf(black.byOrigin)[c], left[c], 1e-5f * left[c]);
}

// A side of radiance L sends pi L times its area.
TEST(Lpv, SendsTheLightOfEmissiveSurfacesUnlessThatIsOff) {
    Scene scene = room();
    scene.lights.clear();
    scene.materials.push_back(simple::lambert(glm::vec3(0), glm::vec3(2, 1, 0)));
    scene.instances[1].material = 1;
    Lit lit(scene);
    const Lattice lattice = latticeOver(scene.bounds, 16);
    const std::vector<InjectedInstance> parts = injectEmitters(scene, lattice);
    ASSERT_EQ(parts.size(), 1U);
    EXPECT_EQ(parts[0].instance, 1U);
    double flux = 0;
    for (const CellLobe& cell : parts[0].cells)
        flux += double(cell.lobe[0].x) * 2 * std::sqrt(std::numbers::pi);
    const double area = 2 * (0.8 * 1.2 + 0.8 * 0.6 + 1.2 * 0.6);
    EXPECT_NEAR(flux, std::numbers::pi * 2 * area, 1e-4 * flux);

    lit.update();
    const std::vector<glm::vec3> once = irradiances(lit);
    EXPECT_GT(once[0].x, 0);
    EXPECT_NEAR(once[0].y, once[0].x / 2, 1e-5f * once[0].x);
    EXPECT_EQ(once[0].z, 0);
    FieldReading reading;
    addIrradiance(lit.at(places()[0].first, places()[0].second), glm::vec3(1), reading);
    const Explanation e = lit.lighting->explain(lit.scene, reading, {});
    ASSERT_EQ(e.byOrigin.size(), 1U);
    EXPECT_NEAR(e.byOrigin[0].value.x, once[0].x, 1e-5f * once[0].x);

    lit.scene.materials[1].emission *= 2;
    lit.update();
    for (std::size_t i = 0; i < once.size(); ++i)
        EXPECT_EQ(irradiances(lit)[i], 2.f * once[i]);
    lit.scene.technique.settings["lpv.emitters"] = 0;
    lit.scene.materials[0].baseColor.x = 0.1f;
    lit.update();
    EXPECT_EQ(irradiances(lit)[0], glm::vec3(0));
}

} // namespace
} // namespace limn::lpv_test
