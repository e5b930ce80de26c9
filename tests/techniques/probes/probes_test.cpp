// SPDX-License-Identifier: MIT
#include "engine/techniques/probes/probes.h"

#include "engine/core/parallel.h"
#include "engine/field/field_reading.h"
#include "engine/techniques/probes/probe_light.h"
#include "tests/techniques/probes/lit_by_probes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include <glm/gtc/matrix_transform.hpp>

namespace limn::probes_test {
namespace {

constexpr double kPi = std::numbers::pi;

/// A sphere of radius 2 seen from inside, with a lamp of 1 cd in its middle.
Scene litSphere(float albedo) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(albedo)));
    b.add(simple::sphere(2, 4, true));
    b.scene.lights = {pointLight(glm::vec3(0), 1)};
    return b.build();
}

const std::vector<glm::vec3> kDirections = {
    {1, 0, 0}, {0, -1, 0}, {0, 0, 1}, glm::normalize(glm::vec3(-0.3f, 0.8f, 0.1f))};
/// One of the eight probes about this point of the sphere stands outside. Distances in its cone
/// reach from the sphere to the horizon, and Chebyshev's bound does not hide the point.
const glm::vec3 kCorner = glm::normalize(glm::vec3(1));

TEST(Probes, ASphereHasTheIrradianceOfOneBounce) {
    LitByProbes s(litSphere(0.5f), {{"probes.count", 125}});
    const LightingReport report = s.update();
    EXPECT_TRUE(report.converged && report.whole);
    EXPECT_EQ(report.bounces, 1U);
    const double expected = 0.5 * 4 * kPi / (4 * kPi * 4); // rho phi / (4 pi R^2)
    for (const glm::vec3 d : kDirections)
        EXPECT_NEAR(s.irradiance(1.995f * d, -d).x, expected, 0.01 * expected);
    EXPECT_NEAR(s.irradiance(1.995f * kCorner, -kCorner).x, expected, 0.1 * expected);
}

TEST(Probes, ASphereHasTheIrradianceOfAllBouncesWhereTheyAreAsked) {
    LitByProbes s(litSphere(0.5f), {{"probes.count", 125}, {"probes.bounces", 1}});
    const LightingReport report = s.update();
    EXPECT_TRUE(report.converged);
    EXPECT_GT(report.bounces, 3U);
    const double expected = 0.5 / (1 - 0.5) * 4 * kPi / (4 * kPi * 4);
    for (const glm::vec3 d : kDirections)
        EXPECT_NEAR(s.irradiance(1.995f * d, -d).x, expected, 0.03 * expected);
    s.scene.technique.settings["probes.bounces"] = 0;
    s.update();
    EXPECT_NEAR(s.irradiance({0, 0, 1.995f}, {0, 0, -1}).x, expected / 2, 0.02 * expected);
}

TEST(Probes, AFurnaceHasTheSameLightOnEverySurface) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0), glm::vec3(2, 3, 4)));
    b.add(simple::box(glm::vec3(0), glm::vec3(4, 3, 5), true));
    b.add(simple::box({1, 0, 1}, {1.8f, 1.2f, 1.6f}, false));
    for (const double smooth : {0., 1.}) {
        LitByProbes s(b.build(), {{"probes.count", 100}, {"probes.smooth", smooth}});
        s.update();
        for (const auto& [p, n] : {std::pair(glm::vec3(2, 0.001f, 3), glm::vec3(0, 1, 0)),
                                   std::pair(glm::vec3(0.001f, 1, 1), glm::vec3(1, 0, 0)),
                                   std::pair(glm::vec3(1.4f, 1.201f, 1.3f), glm::vec3(0, 1, 0)),
                                   std::pair(glm::vec3(1.4f, 0.6f, 1.601f), glm::vec3(0, 0, 1))})
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(s.irradiance(p, n)[c], kPi * (2 + c), 0.01 * kPi * (2 + c)) << smooth;
    }
}

/// Harmonics of a single probe 1 m above the middle of a plane that reaches 10 km.
ProbeHarmonics aboveAPlane(const Scene& scene, std::uint32_t origin) {
    const TraceScene trace(scene);
    ProbeMaps maps = emptyMaps({{glm::vec3(-1, 0, -1), glm::vec3(1, 2, 1)}, glm::uvec3(1)}, 64);
    traceProbe(scene, trace, 0, maps);
    ProbeLight light{.lights = std::uint32_t(scene.lights.size())};
    light.parts.resize(light.origins());
    lightProbe({scene, trace, maps, maps.map.solidAngles(), {}}, 0, {origin}, light);
    return light.part(0, origin);
}

Scene plane(const Material& material) {
    simple::SceneBuilder b;
    b.addMaterial(material);
    b.add(simple::quad({-1e4f, 0, 1e4f}, {2e4f, 0, 0}, {0, 0, -2e4f}));
    return b.build();
}

TEST(ProbeLight, AGlowingPlaneFillsHalfTheSphere) {
    const Scene scene = plane(simple::lambert(glm::vec3(0), glm::vec3(1)));
    const ProbeHarmonics c = aboveAPlane(scene, 0);
    const auto irradiance = [&](glm::vec3 n) {
        return double(shIrradiance(kIrradianceBands, c.data(), n).x);
    };
    EXPECT_NEAR(irradiance({0, -1, 0}), kPi, 0.01 * kPi);
    EXPECT_NEAR(irradiance({1, 0, 0}), kPi / 2, 0.01 * kPi);
    EXPECT_NEAR(irradiance({0, 1, 0}), 0, 0.01 * kPi);
}

// Of the radiance n d before a plane with normal n, M = E / pi is 2/3. Three bands of harmonics
// hold 1/4 + 1/2 + 5/16 of it along n, of which the clamped cosine keeps pi, 2 pi / 3 and pi / 4.
TEST(ProbeLight, ACosineHasTwoThirds) {
    const Octahedron map{48};
    const std::vector<float> solidAngle = map.solidAngles();
    const glm::vec3 n = glm::normalize(glm::vec3(1, 2, -3));
    ProbeHarmonics c{};
    for (std::uint32_t t = 0; t < map.texels(); ++t) {
        float y[kIrradianceBands * kIrradianceBands];
        shBasis(kIrradianceBands, map.direction(t), y);
        for (std::size_t i = 0; i < c.size(); ++i)
            c[i] += std::max(glm::dot(n, map.direction(t)), 0.f) * solidAngle[t] * y[i];
    }
    const double m = double(shIrradiance(kIrradianceBands, c.data(), n).x) / kPi;
    EXPECT_NEAR(m, 0.25 + 1. / 3 + 5. / 64, 1e-3);
    EXPECT_NEAR(m, 2. / 3, 0.01 * 2. / 3);
}

TEST(ProbeLight, ALitPlaneSendsItsRadiosityAndTheSkyTheRest) {
    Scene scene = plane(simple::lambert(glm::vec3(0.5f)));
    Light sun;
    sun.kind = LightKind::Directional;
    sun.direction = glm::normalize(glm::vec3(1, -1, 0));
    scene.lights = {sun};
    scene.sky.radiance = glm::vec3(3);
    const ProbeHarmonics lit = aboveAPlane(scene, 0), sky = aboveAPlane(scene, 2);
    EXPECT_NEAR(shIrradiance(kIrradianceBands, lit.data(), {0, -1, 0}).x, 0.5 * std::sqrt(0.5),
                0.005);
    EXPECT_NEAR(shIrradiance(kIrradianceBands, sky.data(), {0, 1, 0}).x, 3 * kPi, 0.03 * kPi);
}

/// Two rooms of 4 x 2 x 4 m with a divider; the left one is lit. Walls have no thickness outside.
Scene twoRooms(float divider) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.7f)));
    const float h = divider / 2;
    b.add(simple::box({-4 - h, 0, 0}, {-h, 2, 4}, true));
    b.add(simple::box({h, 0, 0}, {4 + h, 2, 4}, true));
    b.scene.lights = {pointLight({-2, 1.5f, 2}, 10)};
    return b.build();
}

// Probes stand every metre. Places are the floor in the middle of the dark room, and the wall
// itself 1 mm behind its dark side, where nothing but the probes' distances tells the two rooms
// apart.
TEST(Probes, AWallHidesTheLitRoomFromTheDarkOne) {
    for (const float divider : {0.05f, 0.25f, 1.f, 2.f})
        for (const double smooth : {0., 1.}) {
            LitByProbes s(twoRooms(divider), {{"probes.count", 128}, {"probes.smooth", smooth}});
            s.update();
            const float lit = s.irradiance({-2, 0.001f, 2}, {0, 1, 0}).x,
                        dark = s.irradiance({2 + divider / 2, 0.001f, 2}, {0, 1, 0}).x,
                        beside = s.irradiance({divider / 2 + 1e-3f, 1, 2}, {1, 0, 0}).x;
            std::printf("divider of %.2f m, %s: floor %.1e, wall %.1e of the lit room\n",
                        double(divider), smooth > 0 ? "ddgi" : "MM17", double(dark / lit),
                        double(beside / lit));
            EXPECT_GT(lit, 0.1f);
            EXPECT_LT(dark, 1e-3f * lit) << divider << ' ' << smooth;
            // Distances to a wall's two sides do not differ where it is much thinner than a step.
            EXPECT_LT(beside, (divider < 0.1f ? 0.15f : 0.01f) * lit) << divider << ' ' << smooth;
        }
}

/// Irradiance of the floor of a room with a block and a lamp, `scale` times as large.
float irradianceAtScale(float scale) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.6f)));
    const glm::mat4 toWorld = glm::scale(glm::mat4(1), glm::vec3(scale));
    b.add(simple::box(glm::vec3(0), glm::vec3(4, 3, 5), true), toWorld);
    b.add(simple::box({1, 0, 1}, {1.8f, 1.2f, 1.6f}, false), toWorld);
    b.scene.lights = {pointLight(scale * glm::vec3(2, 2.5f, 2), 5 * scale * scale)};
    LitByProbes s(b.build(), {{"probes.count", 64}});
    s.update();
    return s.irradiance(scale * glm::vec3(3, 0.001f, 3), {0, 1, 0}).x;
}

TEST(Probes, ScaleDoesNotChangeIrradiance) {
    const float found = irradianceAtScale(1);
    EXPECT_GT(found, 0.1f);
    // Powers of two round nothing. At other scales, rays that run into an edge of the room fall to
    // either side of it: some of 64 probes' rays, which is up to 0.23 % here.
    for (const float scale : {0x1p-10f, 0x1p10f})
        EXPECT_NEAR(irradianceAtScale(scale), found, 1e-5f * found) << scale;
    for (const float scale : {1e-3f, 1e3f})
        EXPECT_NEAR(irradianceAtScale(scale), found, 4e-3f * found) << scale;
}

constexpr glm::vec3 kPoint(3, 0.001f, 3), kUp(0, 1, 0);

TEST(Probes, LightsAddUpAndTheirColoursNeedNoRay) {
    LitByProbes both(room(), {{"probes.count", 64}});
    both.update();
    const glm::vec3 sum = both.irradiance(kPoint, kUp);
    glm::vec3 parts(0);
    for (std::size_t off : {0U, 1U}) {
        LitByProbes one(room(), {{"probes.count", 64}});
        one.scene.lights[off].enabled = false;
        one.update();
        parts += one.irradiance(kPoint, kUp);
    }
    EXPECT_NEAR(sum.x, parts.x, 1e-5f * sum.x);
    both.scene.lights[0].color = {2, 0, 1};
    both.scene.lights[1].color = {2, 0, 1};
    const LightingReport report = both.update();
    EXPECT_FALSE(report.skipped);
    EXPECT_EQ(counterOf(report, "rays"), 0);
    const glm::vec3 colored = both.irradiance(kPoint, kUp);
    EXPECT_NEAR(colored.x, 2 * sum.x, 1e-5f * sum.x);
    EXPECT_EQ(colored.y, 0);
    EXPECT_NEAR(colored.z, sum.z, 1e-5f * sum.z);
}

TEST(Probes, AMovedLampIsTracedAloneAndEqualsAFreshStart) {
    LitByProbes s(room(), {{"probes.count", 64}});
    const double whole = counterOf(s.update(), "rays");
    s.scene.lights[1].position = {3.5f, 2, 4};
    const LightingReport report = s.update();
    EXPECT_GT(counterOf(report, "rays"), 0);
    EXPECT_LT(counterOf(report, "rays"), 0.6 * whole) << "no map, no other lamp";
    LitByProbes fresh(s.scene, s.scene.technique.settings);
    fresh.update();
    EXPECT_EQ(s.lighting->field()->grid, fresh.lighting->field()->grid);
}

TEST(Probes, ALampThatWasOffIsLitWhereItStands) {
    LitByProbes s(room(), {{"probes.count", 64}});
    s.scene.lights[1].enabled = false;
    s.update();
    s.scene.lights[1].enabled = true;
    s.update();
    LitByProbes fresh(room(), {{"probes.count", 64}});
    fresh.update();
    EXPECT_EQ(s.lighting->field()->grid, fresh.lighting->field()->grid);
}

TEST(Probes, MovedObjectsAndNewColoursAreSeen) {
    LitByProbes s(room(), {{"probes.count", 64}});
    s.update();
    s.scene.materials[0].baseColor = glm::vec4(0.9f);
    s.scene.instances[1].toWorld = glm::translate(glm::mat4(1), {1, 0, 1});
    s.trace = std::make_shared<const TraceScene>(s.scene);
    s.update();
    LitByProbes fresh(s.scene, s.scene.technique.settings);
    fresh.update();
    EXPECT_EQ(s.lighting->field()->grid, fresh.lighting->field()->grid);
    EXPECT_EQ(s.lighting->field()->gridMoments->texels,
              fresh.lighting->field()->gridMoments->texels);
}

TEST(Probes, AViewGetsItsLightAFewProbesAtATime) {
    LitByProbes s(room(), {{"probes.count", 64}, {"probes.perUpdate", 5}});
    const double probes = counterOf(s.update(), "probes");
    s.scene.lights[0].position = {1, 2, 3};
    const Viewpoint view{};
    int updates = 0;
    LightingReport report;
    do {
        report = s.lighting->update(
            {.scene = s.scene, .trace = s.trace.get(), .bounces = 2, .view = &view}, {});
        EXPECT_LE(counterOf(report, "probes_refreshed"), 5);
        EXPECT_EQ(report.converged, counterOf(report, "probes_stale") == 0);
        ++updates;
    } while (!report.converged && updates < 1000);
    EXPECT_EQ(updates, int(std::ceil(probes / 5)));
    LitByProbes fresh(s.scene, s.scene.technique.settings);
    fresh.update();
    EXPECT_EQ(s.lighting->field()->grid, fresh.lighting->field()->grid);
}

TEST(Probes, AreTheSameWithAnyNumberOfThreads) {
    LitByProbes many(room(), {{"probes.count", 64}, {"probes.bounces", 1}});
    many.update();
    const ThreadLimit one(1);
    LitByProbes single(room(), {{"probes.count", 64}, {"probes.bounces", 1}});
    single.update();
    EXPECT_EQ(many.lighting->field()->grid, single.lighting->field()->grid);
}

TEST(Probes, ExplainWhereTheirLightComesFrom) {
    Scene scene = room();
    scene.sky.radiance = glm::vec3(1);
    scene.materials.push_back(simple::lambert(glm::vec3(0), glm::vec3(3)));
    scene.instances[1].material = 1;
    LitByProbes s(scene, {{"probes.count", 64}, {"probes.bounces", 1}});
    s.update();
    FieldReading reading;
    addIrradiance({*s.lighting->field(), {}, s.scene, 0, 0, 0, 0, kPoint, kUp}, glm::vec3(1),
                  reading);
    const Explanation why = s.lighting->explain(s.scene, reading, {});
    const glm::vec3 is = s.irradiance(kPoint, kUp);
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(totalOf(why.byOrigin)[c], is[c], 1e-4f * is[c]);
        EXPECT_NEAR(totalOf(why.bySender)[c], is[c], 1e-4f * is[c]);
    }
    EXPECT_GE(why.byOrigin.size(), 4U);
}

TEST(Probes, NothingToLightAndStrangeLightsAreHarmless) {
    LitByProbes empty{Scene{.assets = std::make_shared<Assets>()}};
    EXPECT_TRUE(empty.update().converged);
    Scene scene = room();
    scene.lights[0].strength = 1e10f;
    scene.lights[1].position = {1.4f, 0.6f, 1.3f}; // inside the block
    Light panel;
    panel.kind = LightKind::Rectangle;
    panel.position = {2, 2.9f, 2};
    scene.lights.push_back(panel);
    LitByProbes s(scene, {{"probes.count", 64}});
    s.update();
    for (const glm::vec4 c : s.lighting->field()->grid)
        for (int k = 0; k < 4; ++k)
            EXPECT_TRUE(std::isfinite(c[k]));
    s.scene.lights.clear();
    s.update();
    EXPECT_EQ(s.irradiance(kPoint, kUp), glm::vec3(0));
}

} // namespace
} // namespace limn::probes_test
