// SPDX-License-Identifier: MIT
#include "engine/rsm/reflective_shadow_map.h"
#include "engine/techniques/light_skin/gather_light.h"
#include "tests/techniques/light_skin/lit_by_skin.h"
#include "tests/techniques/lit_ceiling.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <vector>

namespace limn::skin_rooms_test {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

/// A sphere of radius 2 with a lamp in its middle.
Scene sphereRoom(double mapSize, float albedo, float intensity) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(albedo)));
    b.add(simple::sphere(2, 5, true));
    b.scene.lights = {{.kind = LightKind::Point, .position = glm::vec3(0), .strength = intensity}};
    b.scene.technique.settings = {
        {"light-skin.all", 1}, {"light-skin.map_size", mapSize}, {"light-skin.spacing", 8}};
    return b.build();
}

/// What a lamp in the middle of an exact sphere sees through 6 x side^2 texels.
VirtualLights texelsOfSphere(std::uint32_t side, float radius, float albedo) {
    VirtualLights lights;
    const Light lamp{.kind = LightKind::Point, .position = glm::vec3(0)};
    for (const RsmView& view : rsmViews(lamp, {}, side, {}))
        for (std::uint32_t y = 0; y < side; ++y)
            for (std::uint32_t x = 0; x < side; ++x) {
                const glm::vec2 at = (glm::vec2(x, y) + 0.5f) * 2.f / float(side) - 1.f;
                const glm::vec3 way = view.forward + at.x * view.right + at.y * view.up;
                const float l = glm::length(way), angle = view.texelArea() / (l * l * l);
                lights.add(way / l * radius, -way / l, glm::vec3(albedo * angle),
                           angle * radius * radius, 0, std::uint32_t(lights.size()));
            }
    return lights;
}

// The truth of one bounce is rho Phi / (4 pi R^2) everywhere, with Phi = 4 pi I. Discs of texels
// fall short of it, most in the middle of a face of the lamp's cube map: by 1.49, 0.53 and 0.17 %
// with 8^2, 16^2 and 32^2 texels.
TEST(SkinRooms, LightASphereEvenlyFromAProxyInItsMiddle) {
    constexpr float kRadius = 2, kIntensity = 10, kAlbedo = 0.5f;
    const float truth = kAlbedo * kIntensity / (kRadius * kRadius);
    const float flux = kAlbedo * 4 * kPi * kIntensity;
    struct Case {
        double map;
        float error;
    };
    for (const Case k : {Case{8, -0.0149f}, Case{16, -0.0053f}, Case{32, -0.0017f}}) {
        LitBySkin lit(sphereRoom(k.map, kAlbedo, kIntensity));
        lit.update();
        const VirtualLights lights = texelsOfSphere(std::uint32_t(k.map), kRadius, kAlbedo);
        const GatheringLights from = gatheringLights(lights, allLights(lights), 1);
        const GatheringCache middle{.position = {kRadius, 0, 0}, .normal = {-1, 0, 0}};
        const CacheSums sums = gatherLight(from, middle);
        const float atCache = kIntensity * sums.diffuse.light.x / truth - 1;
        EXPECT_NEAR(atCache, k.error, 0.0001f);
        const float between = lit.irradiance({kRadius, 0, 0}, {-1, 0, 0}).x / truth - 1;
        std::printf("6 x %g^2 texels: %+.3f %%, from %zu caches %+.3f %%\n", k.map,
                    double(100 * atCache), lit.part().light().proxies.size(),
                    double(100 * between));
        for (const glm::vec3 d :
             {glm::vec3(1, 0, 0), glm::vec3(1, 0.03f, 0.05f), glm::vec3(1, -0.06f, 0.02f)}) {
            const glm::vec3 n = glm::normalize(d);
            EXPECT_NEAR(lit.irradiance(n * kRadius, -n).x / truth - 1, k.error, 0.002f);
        }
        if (k.map < 32)
            continue;
        const ProxyLight proxy = diffuseProxy(middle, {&sums.diffuse, 1});
        EXPECT_LT(glm::length(proxy.position), kRadius / 500);
        EXPECT_NEAR(kIntensity * proxy.fluxOfLight * sums.diffuse.light.x / flux, 1, 0.002f);
        const SkinPart::Light& light = lit.part().light();
        std::size_t off = 0; // where caches lie on pieces that are bent around their middle
        for (std::size_t c = 0; c < light.proxies.size(); ++c) {
            const ProxyLight& ofCache = light.proxies[c].diffuse;
            off += glm::length(ofCache.position) < kRadius / 400 ? 0 : 1;
            EXPECT_NEAR(light.flux[c].x / flux, 1, 0.003f);
            EXPECT_GT(ofCache.radius(), kRadius) << "2 R / sqrt(3)";
            EXPECT_EQ(ofCache.lit, 1) << "its sphere holds the cache";
        }
        EXPECT_LT(double(off), 0.05 * double(light.proxies.size()));
    }
}

// B (4 / pi) k atan k, k = X / sqrt(1 + X^2), X = a / h, with a the half-side of the square.
TEST(SkinRooms, ReceiveTheSquaresLightButForTheSizeOfDiscs) {
    constexpr float kHalf = 1, kAlbedo = 0.5f;
    constexpr std::uint32_t kMap = 64;
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(kAlbedo)));
    b.add(simple::quad({-kHalf, 0, -kHalf}, {0, 0, 2 * kHalf}, {2 * kHalf, 0, 0}));
    const Scene scene = b.build();
    const TraceScene trace(scene);
    const Light sun{.kind = LightKind::Directional, .strength = 1};
    const VirtualLights lights = castVirtualLights(trace, scene, sun, kMap);
    const GatheringLights from = gatheringLights(lights, allLights(lights), 1);
    struct Case {
        float texels, error;
    };
    for (const Case k : {Case{4, -0.010f}, Case{8, -0.0026f}}) {
        const float h = k.texels * 2 * kHalf / kMap;
        const float x = kHalf / h, s = x / std::sqrt(1 + x * x);
        const float truth = kAlbedo * 4 / kPi * s * std::atan(s);
        const float e =
            gatherLight(from, {.position = {0, h, 0}, .normal = {0, -1, 0}}).diffuse.light.x;
        std::printf("square, height of %g texels: %+.3f %%\n", double(k.texels),
                    double(100 * (e / truth - 1)));
        EXPECT_NEAR(e / truth - 1, k.error, 0.0005f);
    }
}

TEST(SkinRooms, AreDarkBehindALitWall) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.7f)));
    b.add(simple::quad({0, 0, 0}, {0, 2, 0}, {0, 0, 2}));      // faces +x, lit
    b.add(simple::quad({-0.01f, 0, 0}, {0, 0, 2}, {0, 2, 0})); // faces -x
    b.add(simple::quad({-1, 0, 0.5f}, {0, 1, 0}, {0, 0, 1}));  // faces it in the dark
    b.scene.lights = {{.kind = LightKind::Spot,
                       .position = {2, 1, 1},
                       .direction = {-1, 0, 0},
                       .outerAngle = 0.3f}};
    LitBySkin lit(b.build());
    lit.update();
    EXPECT_EQ(lit.irradiance({-1, 0.5f, 1}, {1, 0, 0}, 2), glm::vec3(0));
    EXPECT_EQ(lit.irradiance({-0.01f, 1, 1}, {-1, 0, 0}, 1), glm::vec3(0));
}

// Light leaks into a sealed room where the discs of the wall's caches do not cover the proxies. The
// specification asks for the number; the discs alone hold it back.
TEST(SkinRooms, LeakThroughAWallAsFarAsDiscsLeaveGaps) {
    std::vector<float> open, shaded;
    for (const float cells : {0.05f, 0.25f, 1.f, 2.f}) {
        constexpr float kCell = 4 / 32.f;
        const float half = cells * kCell / 2;
        simple::SceneBuilder b;
        b.addMaterial(simple::lambert(glm::vec3(0.5f)));
        b.add(simple::box({-2, 0, 0}, {-half, 2, 2}, true));
        b.add(simple::box({half, 0, 0}, {2, 2, 2}, true));
        b.scene.lights = {
            {.kind = LightKind::Point, .position = glm::vec3(-1, 1, 1), .strength = 10}};
        b.scene.technique.settings = {{"light-skin.spacing", 8}, {"light-skin.vals", 256}};
        for (const double shade : {0., 1.}) {
            b.scene.technique.settings["light-skin.shade"] = shade;
            LitBySkin lit(b.build());
            lit.update();
            const float bright = lit.irradiance({-1, 0, 1}, {0, 1, 0}).x;
            const float dark = lit.irradiance({1, 0, 1}, {0, 1, 0}, 1).x;
            (shade > 0 ? shaded : open).push_back(dark / bright);
        }
        std::printf("wall of %.2f cells: leak %.4f, without shade %.4f\n", double(cells),
                    double(shaded.back()), double(open.back()));
        EXPECT_LE(shaded.back(), open.back());
    }
}

Scene litCeiling(bool blocked, double spacing, double vals) {
    Scene scene = limn::litCeiling(blocked);
    scene.technique.settings = {{"light-skin.spacing", spacing}, {"light-skin.vals", vals}};
    return scene;
}

/// Irradiance of a floor's point from the ceiling's texels that it sees, as a share of all.
double seenShare(const Scene& scene, glm::vec3 p) {
    const TraceScene trace(scene);
    const VirtualLights lights = castVirtualLights(trace, scene, scene.lights[0], 64);
    const GatheringCache cache{.position = p, .normal = {0, 1, 0}};
    ChosenLights seen;
    for (std::uint32_t i = 0; i < lights.size(); ++i)
        if (!trace.blocked(trace.clearOf(p, cache.normal),
                           trace.clearOf(lights.positionOf(i), lights.normalOf(i)))) {
            seen.light.push_back(i);
            seen.weight.push_back(1);
        }
    return double(
        gatherLight(gatheringLights(lights, seen, 1), cache).diffuse.light.x /
        gatherLight(gatheringLights(lights, allLights(lights), 1), cache).diffuse.light.x);
}

// Towards the rim of the spot, texels are ever fainter. Those that are chosen at all stand for
// many, and places are means over areas: the draws by area keep a few of them from being all that
// counts.
TEST(SkinRooms, PlaceProxiesOfChosenTexelsWhereThoseOfAllAre) {
    Scene scene = litCeiling(false, 4, 2048);
    LitBySkin chosen(scene);
    scene.technique.settings["light-skin.all"] = 1;
    LitBySkin all(scene);
    chosen.update();
    all.update();
    const auto& expected = all.part().light().proxies;
    for (std::size_t c = 0; c < expected.size(); ++c) {
        const ProxyLight &found = chosen.part().light().proxies[c].diffuse,
                         &wanted = expected[c].diffuse;
        if (!(wanted.radius() > 0.5f)) // of the ceiling itself
            continue;
        // A twentieth of 2048 draws is by area.
        const float error = 4 * wanted.radius() / 2 / std::sqrt(102.f);
        EXPECT_LT(glm::distance(found.position, wanted.position), error);
        EXPECT_NEAR(found.radius(), wanted.radius(), 2 * error);
    }
}

// An object before a lit wall throws a shadow on what lies behind it; how wide depends on the
// caches.
TEST(SkinRooms, LieInTheShadeOfObjects) {
    for (const double spacing : {2., 4., 8.}) {
        std::vector<double> whole; // shares with all texels
        for (const double vals : {65536., 128., 2048.}) {
            if (vals < 200 && spacing > 2)
                continue;
            LitBySkin open(litCeiling(false, spacing, vals)),
                blocked(litCeiling(true, spacing, vals));
            open.update();
            blocked.update();
            std::printf("spacing %g %%, N = %g:", spacing, vals);
            std::size_t k = 0;
            for (const float x : {0.f, 0.7f, 1.f, 1.3f, 1.8f}) {
                const auto light = [&](const LitBySkin& lit) {
                    return double(lit.irradiance({x, 0, 0}, {0, 1, 0}, 1).x);
                };
                const double share = light(blocked) / light(open);
                std::printf("  %.2f (%.2f)", share, seenShare(blocked.scene, {x, 0, 0}));
                if (x == 0 && spacing < 8) {
                    EXPECT_LT(share, 0.2) << "the middle of the shadow";
                }
                EXPECT_LE(share, 1.05);
                if (vals > 65535)
                    whole.push_back(share);
                if (vals > 2047) {
                    EXPECT_NEAR(share, whole[k], 0.1) << "N = " << vals;
                }
                ++k;
            }
            std::printf("\n");
        }
    }
}

} // namespace
} // namespace limn::skin_rooms_test
