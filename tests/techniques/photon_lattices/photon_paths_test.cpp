// SPDX-License-Identifier: MIT
#include "engine/core/parallel.h"
#include "engine/math/fresnel.h"
#include "engine/scene/light/unit_light.h"
#include "engine/shading/surface_point.h"
#include "tests/techniques/photon_lattices/lit_by_photons.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace limn::photon_paths_test {
namespace {

constexpr double kPi = std::numbers::pi;

/// A box with coloured walls and a block of rough metal.
Scene room() {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert({0.8f, 0.4f, 0.2f}));
    b.addMaterial(mirror({0.9f, 0.7f, 0.4f}));
    b.scene.materials[1].roughness = 0.3f;
    b.scene.materials[1].metallic = 0.8f;
    b.add(simple::box(glm::vec3(0), glm::vec3(4, 3, 5), true));
    b.add(simple::box({1, 0, 1}, {1.8f, 1.2f, 1.6f}, false, 1));
    return b.build();
}

double powerOf(const PhotonMap& map) {
    double sum = 0;
    for (const Photon& photon : map.photons)
        sum += double(channelSum(photon.power));
    return sum;
}

// Of an albedo of (0.8, 0.4, 0.2) the mean 0.4667 survives, with powers times 1.714, 0.857, 0.429,
// so that their sum is kept. A photon that has only red survives by 0.8.
TEST(Scatter, KeepsPhotonsByTheMeanOfTheirColours) {
    const PhotonSurface surface{
        .geometricNormal = {0, 1, 0}, .normal = {0, 1, 0}, .diffuse = {0.8f, 0.4f, 0.2f}};
    constexpr std::uint32_t kCount = 1U << 14;
    std::uint32_t white = 0, red = 0;
    glm::dvec3 mean(0);
    for (std::uint32_t i = 0; i < kCount; ++i) {
        const auto s = scatter(surface, {0, -1, 0}, glm::vec3(3), {0, i}, 0);
        red += scatter(surface, {0, -1, 0}, {3, 0, 0}, {0, i}, 0).has_value() ? 1 : 0;
        if (!s)
            continue;
        ++white;
        mean += glm::dvec3(s->direction);
        EXPECT_GT(s->direction.y, 0);
        EXPECT_NEAR(s->power.x, 3 * 1.714286f, 1e-4);
        EXPECT_NEAR(s->power.y, 3 * 0.857143f, 1e-4);
        EXPECT_NEAR(s->power.z, 3 * 0.428571f, 1e-4);
    }
    EXPECT_NEAR(white / double(kCount), 1.4 / 3, 1e-3);
    EXPECT_NEAR(red / double(kCount), 0.8, 1e-3);
    EXPECT_NEAR(mean.y / white, 2 / 3., 1e-2) << "the mean cosine of a Lambertian surface";
}

TEST(Scatter, MirrorsBySchlicksShare) {
    PhotonSurface surface{.geometricNormal = {0, 1, 0}, .normal = {0, 1, 0}};
    surface.metal = {.base = glm::vec3(0.6f), .metallic = 1, .roughness = 0};
    const glm::vec3 in = glm::normalize(glm::vec3(2, -1, 0));
    const float share = schlickFresnel(glm::vec3(0.6f), 1 / std::sqrt(5.f)).x;
    constexpr std::uint32_t kCount = 1U << 14;
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < kCount; ++i)
        if (const auto s = scatter(surface, in, glm::vec3(1), {0, i}, 0)) {
            ++count;
            EXPECT_EQ(s->event, PhotonEvent::Specular);
            EXPECT_TRUE(s->narrow);
            EXPECT_LT(glm::distance(s->direction, glm::vec3(in.x, -in.y, 0)), 1e-5f);
        }
    EXPECT_NEAR(count / double(kCount), double(share), 1e-3);
    surface.metal.roughness = 0.6f;
    for (std::uint32_t i = 0; i < 256; ++i)
        if (const auto s = scatter(surface, in, glm::vec3(1), {0, i}, 0)) {
            EXPECT_FALSE(s->narrow) << "a wide lobe";
        }
}

// By interpolated normals a reflection may point below the surface; such photons are absorbed.
TEST(Scatter, AbsorbsWhatWouldGoBelowTheSurface) {
    PhotonSurface surface{.geometricNormal = {0, 1, 0},
                          .normal = glm::normalize(glm::vec3(1, 1, 0))};
    surface.metal = {.base = glm::vec3(1), .metallic = 1, .roughness = 0};
    const glm::vec3 in = glm::normalize(glm::vec3(0.3f, -1, 0));
    EXPECT_LT(glm::reflect(in, surface.normal).y, 0);
    for (std::uint32_t i = 0; i < 64; ++i)
        EXPECT_FALSE(scatter(surface, in, glm::vec3(1), {0, i}, 0));
}

// The light's whole flux is emitted, 4 pi per colour. Every path ends in one of three ways.
TEST(PhotonPaths, AccountForAllPower) {
    for (const double bounces : {1., 3., 64.})
        for (const double specular : {0., 8.}) {
            LitByPhotons lit(room(), {{"bounces", bounces}, {"specular", specular}});
            const Light light{.kind = LightKind::Point, .position = {3, 2, 3}};
            const PhotonMap map = traceLight(lit.photons(), unitLight(light), {});
            const PhotonFates& f = map.fates;
            EXPECT_NEAR(f.emittedPower, 3 * 4 * kPi, 3 * 4 * kPi * 2e-3);
            EXPECT_NEAR(f.absorbedPower + f.endedPower + f.lostPower, f.emittedPower,
                        1e-5 * f.emittedPower);
            EXPECT_EQ(f.absorbed + f.ended + f.lost, f.emitted);
            EXPECT_EQ(f.lost, 0U) << "the room is closed";
            for (const Photon& photon : map.photons) {
                EXPECT_NE(photon.vertex, kNoVertex) << "first hits of lights are not stored";
                EXPECT_LT(glm::dot(photon.direction, photon.normal), 0);
                if (specular == 0) {
                    EXPECT_EQ(map.vertices[photon.vertex].event, PhotonEvent::Diffuse);
                }
            }
        }
}

TEST(PhotonPaths, EndAfterTheDiffuseAndSpecularBouncesAllowed) {
    LitByPhotons lit(room(), {{"bounces", 2}, {"specular", 3}});
    const PhotonMap map = traceLight(
        lit.photons(), unitLight({.kind = LightKind::Rectangle, .position = {2, 2.9f, 3}}), {});
    std::uint32_t maxDiffuse = 0, maxSpecular = 0;
    for (const Photon& photon : map.photons) {
        std::uint32_t diffuse = 0, specular = 0;
        for (std::uint32_t v = photon.vertex; v != kNoVertex; v = map.vertices[v].previous)
            ++(map.vertices[v].event == PhotonEvent::Diffuse ? diffuse : specular);
        maxDiffuse = std::max(maxDiffuse, diffuse);
        maxSpecular = std::max(maxSpecular, specular);
    }
    EXPECT_EQ(maxDiffuse, 2U);
    EXPECT_GE(maxSpecular, 1U);
    EXPECT_LE(maxSpecular, 3U);
}

TEST(PhotonPaths, AreTheSameForAnyNumberOfThreads) {
    const LitByPhotons lit(room(), {{"bounces", 4}});
    const Light light = unitLight({.kind = LightKind::Point, .position = {3, 2, 3}});
    const PhotonMap many = traceLight(lit.photons(), light, {});
    const ThreadLimit one(1);
    const PhotonMap single = traceLight(lit.photons(), light, {});
    ASSERT_EQ(many.photons.size(), single.photons.size());
    for (std::size_t i = 0; i < many.photons.size(); ++i) {
        EXPECT_EQ(many.photons[i].power, single.photons[i].power);
        EXPECT_EQ(many.photons[i].position, single.photons[i].position);
        EXPECT_EQ(many.photons[i].vertex, single.photons[i].vertex);
    }
    EXPECT_EQ(many.fates.absorbedPower, single.fates.absorbedPower);
}

// Views of a light share its photons: as many texels as asked for, or up to a row more in each.
TEST(PhotonPaths, ShareTheirNumberAmongTheViewsOfALight) {
    const Bounds bounds{glm::vec3(0), glm::vec3(1)};
    for (const LightKind kind : {LightKind::Directional, LightKind::Point, LightKind::Spot})
        for (const std::uint32_t photons : {100U, 20000U}) {
            const std::uint32_t views = kind == LightKind::Point ? 6 : 1;
            const std::uint32_t side = photonMapSide({.kind = kind}, bounds, photons);
            EXPECT_GE(views * side * side, photons);
            EXPECT_LT(views * (side - 1) * (side - 1), photons);
        }
    EXPECT_EQ(photonMapSide({.kind = LightKind::Directional}, bounds, 20000), 142U);
    const std::uint32_t half = photonMapSide({.kind = LightKind::Rectangle}, bounds, 20000) / 2;
    EXPECT_NEAR(24 * half * half, 20000, 1000);
}

// Of what a square sends, 0.1998 falls on an equal one that faces it a side apart: the closed form
// of the form factor between parallel squares.
TEST(PhotonPaths, OfAnEmissiveSquareArriveByItsFormFactor) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0), glm::vec3(5)));
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::quad({0, 1, 0}, {1, 0, 0}, {0, 0, 1}, 0));
    b.add(simple::quad({0, 0, 0}, {0, 0, 1}, {1, 0, 0}, 1));
    const LitByPhotons lit(b.build());
    const PhotonMap map = traceEmitters(lit.photons(), 0, {});
    EXPECT_NEAR(map.fates.emittedPower, 3 * kPi, 3 * kPi * 1e-4);
    const double arrived = powerOf(map) / map.fates.emittedPower;
    const double x2 = 2,
                 factor = 2 / kPi *
                          (std::log(x2 / std::sqrt(3)) +
                           2 * std::sqrt(x2) * std::atan(1 / std::sqrt(x2)) - 2 * std::atan(1));
    EXPECT_NEAR(factor, 0.1998, 1e-4);
    EXPECT_NEAR(arrived, factor, 3 * std::sqrt(factor * (1 - factor) / 20000));
    std::printf("square: %.4f of the power arrives, form factor %.4f\n", arrived, factor);
}

// A sky of radiance L sends pi L A onto an open square.
TEST(PhotonPaths, OfTheSkyArriveEvenly) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::quad({0, 0, 0}, {0, 0, 2}, {2, 0, 0}));
    LitByPhotons lit(b.build(), {{"photons", 1 << 16}});
    lit.scene.sky.radiance = glm::vec3(2);
    const PhotonMap map = traceSky(lit.photons(), {});
    double first = 0;
    for (const Photon& photon : map.photons)
        first += double(photon.power.x);
    // A disc of radius sqrt(2) is hit by half of the mean projected area, 1/4 of the surface.
    const double chance = 0.25 * 4 / (kPi * 2);
    EXPECT_NEAR(first, 2 * kPi * 4, 3 * 2 * kPi * 4 * std::sqrt((1 - chance) / chance / (1 << 16)));
}

// A mirror of area A in the sun passes its Fresnel share of E0 A cos on, into the fine lattice.
TEST(PhotonPaths, OfAMirrorInTheSunKeepItsShare) {
    simple::SceneBuilder b;
    b.addMaterial(mirror({0.9f, 0.6f, 0.3f}));
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    const float s = std::sqrt(0.5f);
    b.add(simple::quad({0, 0, 0}, {0, 0, 1}, {s, -s, 0}, 0)); // faces (1, 1, 0)
    b.add(simple::quad({3, -2, -1}, {0, 0, 3}, {0, 4, 0}, 1));
    LitByPhotons lit(b.build(), {{"photons", 160000}});
    const Light sun = unitLight({.kind = LightKind::Directional, .direction = {0, -1, 0}});
    const PhotonMap map = traceLight(lit.photons(), sun, {});
    const PhotonLattices lattices =
        photonLattices(lit.scene.bounds, {.low = 4, .mid = 8, .high = 128});
    glm::dvec3 power(0);
    for (const Photon& photon : map.photons)
        power += glm::dvec3(photon.power);
    for (const std::uint8_t place : choosePlaces(map, lattices[1], {.few = 8}))
        EXPECT_EQ(place, std::uint8_t(PhotonLattice::High));
    const glm::vec3 share = schlickFresnel({0.9f, 0.6f, 0.3f}, s);
    // Rows of texels are 3 m / 400 apart, against sides of 1 m and 0.7 m.
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(power[c], double(share[c] * s), 0.03 * double(share[c] * s)) << c;
        std::printf("mirror: %.4f, closed form %.4f\n", power[c], double(share[c] * s));
    }
}

/// Glass that is clear, smooth and colourless.
Material clearGlass() {
    Material m = simple::lambert(glm::vec3(1));
    m.transmission = 1;
    m.roughness = 0;
    m.thickness = 1;
    return m;
}

/// Photons of power 1 towards `to`, as many as `count`.
PhotonMap shoot(const LitByPhotons& lit, glm::vec3 from, glm::vec3 to, std::uint32_t count) {
    return tracePaths(lit.photons(), count,
                      [&](std::uint32_t path, PhotonMap&) {
                          return PathStart{.flight = {.origin = from,
                                                      .direction = glm::normalize(to - from),
                                                      .power = glm::vec3(1)},
                                           .surface = {},
                                           .sample = path};
                      },
                      {});
}

// A face of glass reflects R. A pane of two faces passes (1 - R) / (1 + R), a sheet 1 - R, and
// reflects the rest, over all the bounces between its faces.
TEST(PhotonPaths, ThroughGlassArePassedOnOrMirrored) {
    constexpr std::uint32_t kCount = 1U << 15;
    const glm::vec3 from(-2, 3, 0), middle(0, 1, 0);
    const float cosine = 2 / std::sqrt(8.f);
    const double R = double(fresnelDielectric(cosine, 1.5f));
    for (const bool sheet : {false, true}) {
        simple::SceneBuilder b;
        b.addMaterial(simple::lambert(glm::vec3(1e-6f))); // stores photons and sends none on
        b.addMaterial(clearGlass());
        b.scene.materials[1].thickness = sheet ? 0 : 1;
        b.add(simple::quad({-6, 0, -6}, {0, 0, 12}, {12, 0, 0}));
        if (sheet)
            b.add(simple::quad({-2, 1, -2}, {0, 0, 4}, {4, 0, 0}, 1));
        else
            b.add(simple::box({-2, 0.8f, -2}, {2, 1, 2}, false, 1));
        const LitByPhotons lit(b.build(), {{"specular", 64}});
        const PhotonMap map = shoot(lit, from, middle, kCount);
        const double passed = double(map.photons.size()) / kCount;
        const double expected = sheet ? 1 - R : (1 - R) / (1 + R);
        std::printf("%s: passes %.4f, closed form %.4f\n", sheet ? "sheet" : "pane", passed,
                    expected);
        EXPECT_NEAR(passed, expected, 3 * std::sqrt(expected * (1 - expected) / kCount));
        const PhotonFates& f = map.fates;
        // What is mirrored leaves upwards; what passes ends on the dark floor.
        EXPECT_EQ(f.lost + map.photons.size(), kCount);
        EXPECT_EQ(f.absorbed, map.photons.size());
        // A pane shifts light; neither bends it for good.
        const glm::vec3 direction = glm::normalize(middle - from);
        for (const Photon& photon : map.photons) {
            EXPECT_LT(glm::distance(photon.direction, direction), 1e-4f);
            EXPECT_EQ(map.vertices[photon.vertex].event, PhotonEvent::Transmitted);
            EXPECT_TRUE(map.vertices[photon.vertex].narrow);
        }
        const float shift = sheet ? 0.f : 0.2f * (1 - std::tan(std::asin(cosine / 1.5f)));
        EXPECT_NEAR(map.photons[0].position.x, 1 - shift, 1e-4);
    }
}

// Tinted glass colours what it passes and not what it mirrors. A body is left by total reflection.
TEST(Scatter, TintsWhatGlassPasses) {
    PhotonSurface surface{.geometricNormal = {0, 1, 0}, .normal = {0, 1, 0}};
    surface.transmission = {
        .tint = {0.9f, 0.6f, 0.3f}, .share = 1, .ior = 1.5f, .isThin = false, .roughness = 0};
    const glm::vec3 in = glm::normalize(glm::vec3(2, -1, 0));
    const double R = double(fresnelDielectric(1 / std::sqrt(5.f), 1.5f));
    constexpr std::uint32_t kCount = 1U << 14;
    std::uint32_t mirrored = 0, passed = 0;
    for (std::uint32_t i = 0; i < kCount; ++i)
        if (const auto s = scatter(surface, in, glm::vec3(1), {0, i}, 0)) {
            if (s->event == PhotonEvent::Specular) {
                ++mirrored;
                EXPECT_NEAR(s->power.x, s->power.z, 1e-5f);
            } else {
                ++passed;
                EXPECT_NEAR(s->power.x, 1.5f, 1e-4);
                EXPECT_NEAR(s->power.z, 0.5f, 1e-4);
                EXPECT_NEAR(s->direction.x, in.x / 1.5f, 1e-5) << "Snell";
                EXPECT_LT(s->direction.y, 0);
            }
        }
    EXPECT_NEAR(mirrored / double(kCount), R, 1e-3);
    EXPECT_NEAR(passed / double(kCount), (1 - R) * 0.6, 1e-3);
    surface.inside = true;
    for (std::uint32_t i = 0; i < 64; ++i) {
        const auto s = scatter(surface, in, glm::vec3(1), {0, i}, 0);
        ASSERT_TRUE(s);
        EXPECT_EQ(s->event, PhotonEvent::Specular) << "beyond 41.8 degrees";
    }
}

} // namespace
} // namespace limn::photon_paths_test
