// SPDX-License-Identifier: MIT
#include "engine/field/sample_field.h"
#include "engine/techniques/illuminance/relight/relight.h"

#include "engine/math/sh.h"

#include "engine/core/parallel.h"
#include "engine/math/ycocg.h"
#include "engine/techniques/illuminance/bake/baker.h"
#include "tests/core/sweep.h"
#include "tests/techniques/illuminance/shared_bake.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace limn::relight_test {
namespace {

using namespace simple;

constexpr double kPi = std::numbers::pi;

struct Lit {
    Scene scene;
    std::unique_ptr<TraceScene> trace;
    std::unique_ptr<Relighter> relighter;
    RelightStats stats; ///< of the first call
};

Lit light(Scene scene, std::uint32_t rounds = 400, LitBands bands = LitBands::All) {
    Lit lit;
    lit.scene = std::move(scene);
    lit.trace = std::make_unique<TraceScene>(lit.scene);
    lit.relighter = std::make_unique<Relighter>(sharedBake(*lit.trace), bands);
    lit.stats = lit.relighter->relight(lit.scene, *lit.trace, rounds);
    return lit;
}

glm::vec3 irradianceAt(const Lit& lit, std::uint32_t instance, std::uint32_t triangle, float u,
                       float v, glm::vec3 position, glm::vec3 normal, bool back = false) {
    return sampleIrradiance({lit.relighter->field(), lit.relighter->bake().lightmap, lit.scene,
                             instance, triangle, u, v, position, normal, back});
}

Scene furnace(float albedo, float emission, std::uint32_t bands) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(albedo), glm::vec3(emission)));
    b.add(box(glm::vec3(0), glm::vec3(4, 3, 5), true));
    Scene scene = b.build();
    scene.bake.bands = bands;
    scene.bake.surfels = 1000;
    scene.bake.lightmapCaches = 800;
    scene.bake.rays = 256;
    scene.bake.links = 64;
    scene.bake.grid = {2, 2, 2};
    return scene;
}

TEST(Furnace, ClosedRoomReachesItsRadiosityAtEveryBandCount) {
    for (const LinkStorage storage : {LinkStorage::Rtp, LinkStorage::Sh})
        for (std::uint32_t bands = 2; bands <= 8; bands += kSanitized ? 3 : 1)
            for (const float albedo : {0.f, 0.5f, 0.9f}) {
                Scene scene = furnace(albedo, 1, bands);
                scene.bake.storage = storage;
                scene.bake.surfels = 300, scene.bake.lightmapCaches = 250;
                scene.bake.rays = 128;
                const Lit lit = light(std::move(scene));
                const double expected = kPi / (1 - double(albedo));
                const std::uint32_t surfels = lit.relighter->bake().tree.surfels;
                double worst = 0;
                for (std::uint32_t s = 0; s < surfels; ++s)
                    worst =
                        std::max(worst, std::abs(lit.relighter->radiosity()[s].x / expected - 1));
                EXPECT_LT(worst, 0.01)
                    << bands << " bands, albedo " << albedo << ", storage " << int(storage);
            }
}

// Each bounce passes on nearly all of it: what those left out would bring counts, too.
TEST(Furnace, RoomsThatAbsorbLittleAreLitUntilNothingIsMissing) {
    for (const float albedo : {0.95f, 0.99f}) {
        const Lit lit = light(furnace(albedo, 1, 3), RelightSettings().maxBounces);
        EXPECT_TRUE(lit.stats.converged);
        const double expected = kPi / (1 - double(albedo));
        double sum = 0, area = 0;
        const Surfels& s = lit.relighter->bake().surfels;
        for (std::uint32_t i = 0; i < s.size(); ++i) {
            sum += double(lit.relighter->radiosity()[i].x * s.area[i]);
            area += double(s.area[i]);
        }
        EXPECT_NEAR(sum / area / expected, 1, 0.002) << albedo;
        EXPECT_LT(lit.stats.bounces, 50U) << "one by one, some 180 and 900";
    }
}

TEST(Furnace, GridCachesSeeTheSameRadianceFromEverywhere) {
    Scene scene = furnace(0.5f, 1, 3);
    SceneBuilder b;
    b.scene = scene;
    b.assets = std::make_shared<Assets>(*scene.assets);
    b.add(sphere(0.01f, 0, false), glm::mat4(1), true); // reads the grid
    scene = b.build();
    scene.relight.dynamicOcclusion = false;
    const Lit lit = light(std::move(scene));
    for (const glm::vec3 n :
         {glm::vec3(1, 0, 0), glm::vec3(0, -1, 0), glm::normalize(glm::vec3(1, 2, 3))}) {
        Scene noLightmap = lit.scene; // an instance unknown to the lightmap is lit from the grid
        const glm::vec3 e = sampleIrradiance(
            {lit.relighter->field(), {}, noLightmap, 99, 0, 0, 0, {2, 1.5f, 2}, n});
        EXPECT_NEAR(e.x, 2 * kPi, 0.01 * 2 * kPi);
    }
}

TEST(Sky, ATwoSidedPlateIsLitByItAboveAndDarkBelow) {
    SceneBuilder b;
    Material m = lambert(glm::vec3(0.5f));
    m.doubleSided = true;
    b.addMaterial(m);
    b.add(quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}));
    Scene scene = b.build();
    scene.sky.kind = SkyKind::Gradient;
    scene.sky.radiance = glm::vec3(3);
    scene.bake.lightmapCaches = 400;
    scene.bake.surfels = 200;
    scene.bake.rays = 1024;
    const Lit lit = light(scene);
    const Bake& bake = lit.relighter->bake();
    EXPECT_GT(bake.lightmap.instances[0].backRows, 0U);
    const auto irradiance = [&](glm::vec3 n, bool back) {
        return irradianceAt(lit, 0, 0, 0.3f, 0.3f, glm::vec3(0), n, back).x;
    };
    // Radiance 3 sin(elevation) over the upper half: E = 3 * 2 pi / 3.
    EXPECT_NEAR(irradiance({0, 1, 0}, false), 2 * kPi, 0.01 * 2 * kPi);
    EXPECT_EQ(irradiance({0, -1, 0}, true), 0);
    for (std::uint32_t s = 0; s < bake.surfels.size(); ++s)
        EXPECT_NEAR(lit.relighter->radiosity()[s].x, bake.surfels.normal[s].y > 0 ? kPi : 0,
                    0.01 * kPi);
}

TEST(Sky, UnoccludedGroundGetsPiTimesItsRadiance) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}));
    Scene scene = b.build();
    scene.sky.radiance = {1, 2, 3};
    scene.bake.lightmapCaches = 200;
    scene.bake.surfels = 200;
    scene.bake.rays = 256;
    const Lit lit = light(scene);
    const glm::vec3 e = irradianceAt(lit, 0, 0, 0.3f, 0.3f, {0, 0, 0}, {0, 1, 0});
    EXPECT_NEAR(e.x, kPi, 0.01 * kPi);
    EXPECT_NEAR(e.y, 2 * kPi, 0.02 * kPi);
    EXPECT_NEAR(e.z, 3 * kPi, 0.03 * kPi);
}

TEST(Sky, AConstantPanoramaIsAConstantColourAndATurnIsSeenAtOnce) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}));
    b.scene.materials[0].doubleSided = true;
    b.add(quad({0, 0, 5}, {0, 0, -10}, {0, 10, 0})); // a wall: the ground beside it sees half
    Scene scene = b.build();
    scene.bake.lightmapCaches = 400;
    scene.bake.surfels = 400;
    scene.bake.rays = 256;
    scene.sky.radiance = {1, 2, 3};
    const Lit lit = light(scene);
    const std::vector<glm::vec3> colour = lit.relighter->cacheSh();
    const ImageF constant{8, 4, std::vector<glm::vec3>(32, {1, 2, 3})};
    scene.sky = {.kind = SkyKind::Image, .image = "constant", .panorama = makeSkyImage(constant)};
    const TraceScene trace(scene);
    while (!lit.relighter->relight(scene, trace, 8).converged) {
    }
    float largest = 0, difference = 0;
    for (std::size_t i = 0; i < colour.size(); ++i) {
        largest = std::max(largest, glm::length(colour[i]));
        difference = std::max(difference, glm::length(colour[i] - lit.relighter->cacheSh()[i]));
    }
    EXPECT_LT(difference, 1e-3f * largest);

    ImageF half{8, 4, std::vector<glm::vec3>(32, glm::vec3(0))};
    for (std::size_t i = 0; i < 32; ++i)
        half.rgb[i] = glm::vec3(i % 8 >= 4); // +X shines
    scene.sky = {.kind = SkyKind::Image, .image = "half", .panorama = makeSkyImage(half)};
    const auto beside = [&](float x, float rotation) {
        scene.sky.rotation = rotation;
        while (!lit.relighter->relight(scene, trace, 8).converged) {
        }
        // At z = 0: in the first triangle for x > 0, in the second for x < 0.
        const glm::vec2 uv = x > 0 ? glm::vec2(x / 10, 0.5f) : glm::vec2((x + 5) / 10, -x / 10);
        return irradianceAt(lit, 0, x > 0 ? 0U : 1U, uv.x, uv.y, {x, 0, 0}, {0, 1, 0}).x;
    };
    const float pi = glm::pi<float>();
    // From 2 m behind the wall's middle, 68 of 90 degrees to either side are hidden.
    const float open = beside(2, 0), hidden = beside(-2, 0);
    EXPECT_GT(open, 3 * hidden);
    EXPECT_NEAR(beside(-2, pi), open, 0.03f * open); // the other way round, the same
    EXPECT_NEAR(beside(2, pi), hidden, 0.05f * hidden);
}

TEST(Sky, OneThatComesBackReachesTheSurfelsEvenOneBounceAtATime) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}));
    Scene scene = b.build();
    scene.bake.lightmapCaches = 200;
    scene.bake.surfels = 200;
    Lit lit = light(scene);
    ASSERT_TRUE(lit.stats.converged);
    lit.scene.sky.radiance = {1, 2, 3};
    std::uint32_t calls = 0;
    while (!lit.relighter->relight(lit.scene, *lit.trace, 1).converged)
        ASSERT_LT(++calls, 10U);
    EXPECT_NEAR(lit.relighter->radiosity()[7].x, 0.5f * kPi, 0.05f); // it sees nothing but sky
}

/// Irradiance at the middle of the upper of two facing unit squares at distance h from the lower
/// one of radiosity B is B F, F = (4/2pi) (2 X / sqrt(1+X^2) atan(X / sqrt(1+X^2))) with X =
/// 1/(2h): the point-to-rectangle factor of Howell. A Catalog of Radiation Heat Transfer
/// Configuration Factors. B-4, four quarters.
double factorToSquare(double h) {
    const double x = 0.5 / h, r = std::sqrt(1 + x * x);
    return 4 * (1 / (2 * kPi)) * 2 * (x / r) * std::atan(x / r);
}

TEST(ParallelPlates, TheMiddleSeesTheClosedFormFactor) {
    for (const float h : {0.5f, 1.f, 2.f}) {
        SceneBuilder b;
        b.addMaterial(lambert(glm::vec3(0), glm::vec3(1)));
        b.addMaterial(lambert(glm::vec3(0.5f)));
        b.add(quad({-0.5f, 0, 0.5f}, {1, 0, 0}, {0, 0, -1}, 0)); // emits upward
        b.add(quad({-0.5f, h, -0.5f}, {1, 0, 0}, {0, 0, 1}, 1)); // looks down
        Scene scene = b.build();
        scene.bake.texelsPerMetre = 8; // nine texels a side: one in the middle
        scene.bake.surfels = 2000;
        scene.bake.rays = 4096;
        scene.bake.links = 4000;
        const Lit lit = light(scene);
        const glm::vec3 e = irradianceAt(lit, 1, 0, 0.f, 0.5f, {0, h, 0}, {0, -1, 0});
        // Three bands of the clamped cosine: error below 2 % of the largest irradiance for small
        // senders; rays: 1 %.
        EXPECT_NEAR(e.x, kPi * factorToSquare(h), 0.03 * kPi * factorToSquare(h) + 0.01)
            << "h " << h;
    }
}

TEST(IntegratingSphere, PointLightGivesTheSeriesOfItsBounces) {
    SceneBuilder b;
    const float albedo = 0.8f, radius = 2;
    b.addMaterial(lambert(glm::vec3(albedo)));
    b.add(sphere(radius, 3, true));
    Scene scene = b.build();
    Light lamp;
    lamp.strength = 10;
    scene.lights = {lamp};
    scene.bake.surfels = 2000;
    scene.bake.lightmapCaches = 2500;
    scene.bake.rays = 256;
    const Lit lit = light(scene);
    const double direct = 10 / (double(radius) * radius); // Phi / 4 pi R^2
    const double expected = direct * (1 + albedo / (1 - albedo)) * albedo;
    double mean = 0, area = 0;
    const Surfels& s = lit.relighter->bake().surfels;
    for (std::size_t i = 0; i < s.size(); ++i) {
        mean += lit.relighter->radiosity()[i].x * s.area[i];
        area += s.area[i];
    }
    // The tessellated sphere lies up to 1 % inside the true one.
    EXPECT_NEAR(mean / area, expected, 0.02 * expected);
}

Scene lampRoom() {
    Scene scene = furnace(0.6f, 0, 3);
    Light lamp;
    lamp.position = {2, 2.5f, 2};
    lamp.strength = 5;
    scene.lights = {lamp};
    scene.relight.maxBounces = 64;
    return scene;
}

TEST(Relight, StandingStillDoesNothing) {
    Lit lit = light(lampRoom());
    const std::uint64_t version = lit.relighter->field().version;
    const RelightStats stats = lit.relighter->relight(lit.scene, *lit.trace, 4);
    EXPECT_TRUE(stats.skipped);
    EXPECT_EQ(stats.bounces, 0U);
    EXPECT_EQ(stats.shadowRays, 0U);
    EXPECT_EQ(lit.relighter->field().version, version);
}

TEST(Relight, LightsThatReachNothingCostNothing) {
    Scene scene = lampRoom();
    Light off = scene.lights[0], black = off, weak = off, far = off, near = off;
    off.enabled = false;
    black.color = glm::vec3(0);
    weak.strength = 0;
    far.position = {2, 2, 9}; // the room ends at 5
    far.range = 3.9f;
    near = far;
    near.range = 8;
    const RelightStats alone = light(scene).stats;
    EXPECT_EQ(alone.lightsOff, 0U);
    scene.lights.insert(scene.lights.end(), {off, black, weak, far});
    const RelightStats more = light(scene).stats;
    EXPECT_EQ(more.lightsOff, 4U);
    EXPECT_EQ(more.lightsTraced, 1U);
    EXPECT_EQ(more.shadowRays, alone.shadowRays);
    scene.lights.push_back(near);
    EXPECT_EQ(light(scene).stats.lightsTraced, 2U);
}

TEST(Relight, AColourChangeTracesNoRayAndScalesTheLight) {
    Lit lit = light(lampRoom());
    const glm::vec3 before = lit.relighter->radiosity()[10];
    lit.scene.lights[0].color = {0.5f, 0.25f, 0};
    const RelightStats stats = lit.relighter->relight(lit.scene, *lit.trace, 400);
    EXPECT_EQ(stats.lightsTraced, 0U);
    EXPECT_EQ(stats.shadowRays, 0U);
    const glm::vec3 after = lit.relighter->radiosity()[10];
    EXPECT_NEAR(after.x, before.x * 0.5f, 2e-3f * before.x);
    EXPECT_NEAR(after.y, before.y * 0.25f, 2e-3f * before.y);
    EXPECT_NEAR(after.z, 0, 2e-3f * before.z);
}

TEST(Relight, MovingALightTracesOnlyThatLight) {
    Lit lit = light(lampRoom());
    lit.scene.lights.push_back(lit.scene.lights[0]);
    lit.scene.lights[1].position.x = 1;
    EXPECT_EQ(lit.relighter->relight(lit.scene, *lit.trace, 4).lightsTraced, 1U);
    lit.scene.lights[0].enabled = false;
    EXPECT_EQ(lit.relighter->relight(lit.scene, *lit.trace, 4).lightsTraced, 0U);
}

TEST(Relight, NoLightIsBlackAndExtremeLightsStayFinite) {
    for (const float strength : {0.f, 1e-6f, 1e6f}) {
        Scene scene = lampRoom();
        scene.lights[0].strength = strength;
        scene.lights[0].position = {0, 1, 1}; // in the wall
        const Lit lit = light(scene);
        for (const glm::vec4 c : lit.relighter->field().lightmap) {
            EXPECT_TRUE(std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z));
            if (strength == 0) {
                EXPECT_EQ(c.x, 0);
            }
        }
    }
}

#if defined(__SSE2__)

std::size_t denormals(const Relighter& relighter) {
    std::size_t count = 0;
    const auto look = [&](float v) { count += std::fpclassify(v) == FP_SUBNORMAL; };
    for (const std::vector<glm::vec4>* all :
         {&relighter.radiosity(), &relighter.field().lightmap, &relighter.field().grid})
        for (const glm::vec4 v : *all)
            look(v.x), look(v.y), look(v.z), look(v.w);
    for (const glm::vec3 v : relighter.cacheSh())
        look(v.x), look(v.y), look(v.z);
    return count;
}

TEST(Relight, NoLightIsTooWeakForNormalNumbers) {
    for (const LinkStorage storage : {LinkStorage::Rtp, LinkStorage::Sh}) {
        Scene scene = lampRoom();
        scene.bake.storage = storage;
        Lit lit = light(scene);
        for (const float strength : {1e-35f, 1e-37f, 3e-38f, 1e-39f}) {
            lit.scene.lights[0].strength = strength;
            for (int bounce = 0; bounce < 10; ++bounce) {
                lit.relighter->relight(lit.scene, *lit.trace, 1);
                EXPECT_EQ(denormals(*lit.relighter), 0U) << strength << " after " << bounce;
            }
        }
        // After the lamp, its light dies away, bounce by bounce.
        lit.scene = scene;
        lit.relighter->relight(lit.scene, *lit.trace, 400);
        lit.scene.lights.clear();
        bool weak = false;
        for (int bounce = 0; bounce < 400; ++bounce) {
            lit.relighter->relight(lit.scene, *lit.trace, 1);
            ASSERT_EQ(denormals(*lit.relighter), 0U) << "after " << bounce;
            const float most = lit.relighter->radiosity()[0].x;
            weak = weak || (most > 0 && most < 1e-30f);
        }
        EXPECT_TRUE(weak);
        EXPECT_EQ(lit.relighter->radiosity()[0], glm::vec4(0));
    }
}

#endif

TEST(Relight, SceneScaleChangesNothing) {
    double mean[3] = {};
    int k = 0;
    for (const float scale : {1e-3f, 1.f, 1e4f}) {
        Scene scene = lampRoom();
        for (Instance& i : scene.instances)
            i.toWorld = glm::mat4(glm::vec4(scale, 0, 0, 0), glm::vec4(0, scale, 0, 0),
                                  glm::vec4(0, 0, scale, 0), glm::vec4(0, 0, 0, 1)) *
                        i.toWorld;
        for (Instance& i : scene.instances)
            i.normalToWorld = i.normalToWorld * (scale * scale);
        scene.bounds.lower *= scale;
        scene.bounds.upper *= scale;
        scene.lights[0].position *= scale;
        scene.lights[0].strength *= scale * scale;
        const Lit lit = light(scene);
        for (std::uint32_t s = 0; s < lit.relighter->bake().tree.surfels; ++s)
            mean[k] += lit.relighter->radiosity()[s].x;
        ++k;
    }
    EXPECT_NEAR(mean[0] / mean[1], 1, 1e-3);
    EXPECT_NEAR(mean[2] / mean[1], 1, 1e-3);
}

TEST(Bake, SameBytesAtOneAndTwoThreads) {
    for (const LinkStorage storage : {LinkStorage::Rtp, LinkStorage::Sh}) {
        std::uint64_t hash[2];
        std::vector<glm::vec3> sh[2];
        for (const int threads : {1, 2}) {
            const ThreadLimit limit(threads);
            Scene scene = lampRoom();
            scene.bake.storage = storage;
            const TraceScene trace(scene);
            Result<Bake> baked = bake(trace); // not one that is shared
            ASSERT_TRUE(baked) << baked.error().message;
            Relighter relighter(std::make_shared<const Bake>(std::move(*baked)), LitBands::All);
            relighter.relight(scene, trace, 400);
            hash[threads - 1] = relighter.bake().hash();
            sh[threads - 1] = relighter.cacheSh();
        }
        EXPECT_EQ(hash[0], hash[1]);
        EXPECT_TRUE(sh[0] == sh[1]);
    }
}

TEST(Relight, KeepsTheColourOfTheBandsThatTheSettingsSay) {
    Scene scene = lampRoom();
    scene.lights[0].color = {1, 0.5f, 0.1f};
    const Lit whole = light(scene);
    for (const std::uint32_t chroma : {1U, 2U}) {
        scene.bake.chromaBands = chroma;
        const Lit lit = light(scene);
        const std::vector<glm::vec3>&sh = lit.relighter->cacheSh(),
              &wholeSh = whole.relighter->cacheSh();
        // Two bands of the clamped cosine make a surface 3 % less colourful.
        const auto expectNear = [&](glm::vec3 is, glm::vec3 was) {
            for (int k = 0; k < 3; ++k)
                EXPECT_NEAR(is[k], was[k], 0.05f * was.x) << chroma << " bands of chrominance";
            EXPECT_NEAR(toYCoCg(is).y, toYCoCg(was).y, 1e-3f * was.x);
        };
        for (std::size_t i = 0; i < sh.size(); ++i) {
            if (i % 9 == 0) {
                expectNear(sh[i], wholeSh[i]);
            } else if (i % 9 >= std::size_t(chroma * chroma)) {
                EXPECT_EQ(sh[i], glm::vec3(sh[i].y));
            }
        }
        for (std::uint32_t surfel = 0; surfel < lit.relighter->bake().tree.surfels; ++surfel)
            expectNear(lit.relighter->radiosity()[surfel], whole.relighter->radiosity()[surfel]);
    }
}

TEST(Bake, CachesInsideASolidAreInvalidAndFilledFromOutside) {
    Scene scene = furnace(0.5f, 1, 3);
    SceneBuilder b;
    b.scene = scene;
    b.assets = std::make_shared<Assets>(*scene.assets);
    b.add(box({1, 0, 1}, {3, 1, 4}, false)); // hides the floor below it
    scene = b.build();
    const Lit lit = light(scene);
    EXPECT_GT(lit.relighter->bake().counts.invalidCaches, 0U);
    const glm::vec3 hidden = irradianceAt(lit, 0, 4, 0.3f, 0.3f, {2, 0, 2}, {0, 1, 0});
    EXPECT_GT(hidden.x, 0);
}

TEST(Bake, RefusesAnEmptySceneAndSettingsOutOfRange) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    const TraceScene empty(b.build());
    EXPECT_FALSE(bake(empty));
    Scene scene = lampRoom();
    scene.bake.bands = 9;
    const Result<Bake> refused = bake(TraceScene(scene));
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("bands 9"), std::string::npos);
}

TEST(Bake, StopsWhenCancelled) {
    std::atomic<bool> cancel = true;
    const Scene scene = lampRoom();
    const Result<Bake> stopped = bake(TraceScene(scene), {.report = {}, .cancel = &cancel});
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().message, "cancelled");
}

TEST(Relight, MoreBandsBringNoOtherIrradiance) {
    Scene scene = lampRoom();
    scene.bake.bands = 3;
    const Lit three = light(scene, 1);
    for (const std::uint32_t bands : {4U, 5U, 8U}) {
        scene.bake.bands = bands;
        const Lit more = light(scene, 1);
        const Caches& caches = more.relighter->bake().caches;
        ASSERT_EQ(caches.linkBegin, three.relighter->bake().caches.linkBegin);
        for (std::uint32_t c = 0; c < caches.lightmapCount; ++c) {
            const glm::vec3* sh = more.relighter->cacheSh().data() + c * bands * bands;
            const glm::vec3* sh3 = three.relighter->cacheSh().data() + c * 9;
            const float e = shIrradiance(3, sh, caches.normal[c]).x,
                        e3 = shIrradiance(3, sh3, caches.normal[c]).x;
            ASSERT_NEAR(e, e3, 1e-5f * e3 + 1e-9f) << bands << " " << c;
        }
    }
}

/// The lamp's room with a block of metal in it.
Scene metalRoom(float roughness, LinkStorage storage) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.6f, 0.5f, 0.3f)));
    Material metal = lambert(glm::vec3(0.9f));
    metal.metallic = 1;
    metal.roughness = roughness;
    b.addMaterial(metal);
    b.add(box(glm::vec3(0), glm::vec3(4, 3, 5), true));
    b.add(box({1, 0, 3}, {2, 1.5f, 4}, false, 1));
    b.scene.bake = lampRoom().bake;
    b.scene.lights = lampRoom().lights;
    b.scene.bake.bands = 6;
    b.scene.bake.storage = storage;
    return b.build();
}

/// The largest coefficient of a band.
float largest(const Relighter& relighter, std::size_t band) {
    const std::size_t n = relighter.field().coefficients();
    float most = 0;
    for (std::size_t i = 0; i < relighter.cacheSh().size(); ++i)
        if (i % n >= band * band && i % n < (band + 1) * (band + 1))
            most = std::max(most, std::abs(relighter.cacheSh()[i].x));
    return most;
}

TEST(Relight, BandsThatNothingReflectsAreNotLit) {
    for (const LinkStorage storage : {LinkStorage::Rtp, LinkStorage::Sh})
        for (const std::uint32_t chroma : {0U, 2U, 5U}) {
            Scene scene = metalRoom(1, storage);
            scene.bake.chromaBands = chroma;
            const Lit whole = light(scene, 3), needed = light(scene, 3, LitBands::Needed);
            EXPECT_EQ(whole.stats.bandsLit, 6U);
            EXPECT_EQ(whole.stats.bandsSkipped, 0U);
            EXPECT_EQ(needed.stats.bandsLit, 3U);
            EXPECT_EQ(needed.stats.bandsSkipped, 3U);
            EXPECT_GT(largest(*whole.relighter, 5), 0.01f) << "which is light that was skipped";
            EXPECT_GT(largest(*needed.relighter, 2), 0.1f);
            EXPECT_TRUE(needed.relighter->radiosity() == whole.relighter->radiosity());
            // What is lit and looked up is what all bands would have there.
            const IndirectField &few = needed.relighter->field(), &all = whole.relighter->field();
            EXPECT_EQ(few.bands, 3U);
            EXPECT_EQ(all.bands, 6U);
            ASSERT_EQ(few.lightmap.size() * 4, all.lightmap.size());
            ASSERT_EQ(few.grid.size() * 4, all.grid.size());
            // With 5 bands in colour all 6 are summed as luma and chrominance, 3 as RGB: rounding.
            const float rounding = chroma == 5 ? 1e-5f * largest(*whole.relighter, 0) : 0;
            for (std::size_t i = 0; i < few.lightmap.size(); ++i)
                ASSERT_LE(glm::length(few.lightmap[i] - all.lightmap[i]), rounding);
            for (std::size_t i = 0; i < few.grid.size(); ++i)
                ASSERT_LE(glm::length(few.grid[i] - all.grid[i]), rounding);
        }
}

TEST(Relight, ASurfaceThatIsPolishedGetsItsBandsAtOnceAndGivesThemBack) {
    for (const LinkStorage storage : {LinkStorage::Rtp, LinkStorage::Sh}) {
        Lit lit = light(metalRoom(1, storage), 400, LitBands::Needed);
        ASSERT_TRUE(lit.stats.converged);
        const IndirectField rough = lit.relighter->field();
        lit.scene.materials.back().roughness = 0.3f;
        const RelightStats polished = lit.relighter->relight(lit.scene, *lit.trace, 1);
        EXPECT_EQ(polished.bandsLit, 6U);
        const Lit fresh = light(metalRoom(0.3f, storage), 400, LitBands::Needed);
        EXPECT_EQ(lit.relighter->field().bands, 6U);
        EXPECT_GT(largest(*fresh.relighter, 5), 0.01f);
        // The same albedos, so the same light; converged to 1e-4.
        const auto &a = lit.relighter->field().lightmap, &b = fresh.relighter->field().lightmap;
        ASSERT_EQ(a.size(), b.size());
        for (std::size_t i = 0; i < a.size(); ++i)
            ASSERT_LT(glm::length(a[i] - b[i]), 1e-3f);
        lit.scene.materials.back().roughness = 1;
        EXPECT_EQ(lit.relighter->relight(lit.scene, *lit.trace, 1).bandsSkipped, 3U);
        EXPECT_EQ(lit.relighter->field().bands, 3U);
        EXPECT_EQ(lit.relighter->field().lightmap.size(), rough.lightmap.size());
    }
}

} // namespace
} // namespace limn::relight_test
