// SPDX-License-Identifier: MIT
#include "engine/measure/compare.h"
#include "engine/reference/reference.h"
#include "engine/shading/sky_light.h"

#include "engine/core/parallel.h"
#include "tests/trace/masked.h"

#include <gtest/gtest.h>

#include <cmath>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace limn::reference_test {

using namespace simple;

namespace {

constexpr double kPi = 3.14159265358979;

Light pointLight(glm::vec3 position, float candela) {
    Light l;
    l.kind = LightKind::Point;
    l.position = position;
    l.strength = candela;
    return l;
}

Light sun(glm::vec3 direction, float lux) {
    Light l;
    l.kind = LightKind::Directional;
    l.direction = glm::normalize(direction);
    l.strength = lux;
    return l;
}

ReferenceOptions optionsFor(View view, glm::vec3 eye, glm::vec3 target, std::uint32_t size,
                            std::uint32_t spp, float fov = 0.9f) {
    ReferenceOptions o;
    o.view = view;
    o.camera.eye = eye;
    o.camera.target = target;
    o.camera.fovY = fov;
    o.width = o.height = size;
    o.samplesPerPixel = spp;
    return o;
}

/// Standard error of meanOf, relative. Channels are equal in these tests, pixels are independent.
double relativeError(const ReferenceResult& r) {
    return r.noise / std::sqrt(double(r.image.rgb.size()));
}

/// Share of the hemisphere's cosine that a rectangle a x b takes, parallel to a small surface at
/// distance h under its corner.
double cornerFormFactor(double a, double b, double h) {
    const double X = a / h, Y = b / h, x = std::sqrt(1 + X * X), y = std::sqrt(1 + Y * Y);
    return (X / x * std::atan(Y / x) + Y / y * std::atan(X / y)) / (2 * kPi);
}

/// Emissive rectangle [-a, a] x [-b, b] at height h, facing down.
Mesh lamp(float a, float b, float h, std::uint32_t material) {
    return quad({-a, h, -b}, {2 * a, 0, 0}, {0, 0, 2 * b}, material);
}

} // namespace

TEST(Reference, APointLightOnAPlaneGivesIcosOverDSquared) {
    SceneBuilder b;
    b.addMaterial(lambert({0.8f, 0.4f, 0.2f}));
    b.add(quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}));
    b.scene.lights = {pointLight({0, 2, 0}, 100)};
    const TraceScene trace(b.build());
    for (float x : {0.f, 1.f, 3.f}) {
        // A pixel so small that the mean over it is the value at its centre.
        const ReferenceResult r = renderReference(
            trace, optionsFor(View::Direct, {x, 3, 0.01f}, {x, 0, 0}, 1, 16, 1e-3f));
        const double d2 = 4 + double(x) * double(x), E = 100 * 2 / std::sqrt(d2) / d2;
        EXPECT_NEAR(r.image.rgb[0].x, 0.8 * E / kPi, 1e-3 * E);
        EXPECT_NEAR(r.image.rgb[0].y, 0.4 * E / kPi, 1e-3 * E);
        EXPECT_NEAR(r.image.rgb[0].z, 0.2 * E / kPi, 1e-3 * E);
    }
}

TEST(Reference, OneOfManyLightsPerSampleIsUnbiased) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}));
    b.add(quad({-1, 1, -1}, {0.9f, 0, 0}, {0, 0, 2})); // shadows part of it
    Light off = pointLight({0, 1, 0}, 1e6f);
    off.enabled = false;
    b.scene.lights = {pointLight({1, 2, 0}, 30), off, sun({1, -2, 0}, 3),
                      pointLight({-2, 2, 0}, 50)};
    const Scene all = b.build();
    const auto options = optionsFor(View::Direct, {0, 3, 0.01f}, {0, 0, 0}, 24, 256);
    const ReferenceResult together = renderReference(TraceScene(all), options);
    double sum = 0, variance = 0;
    for (const Light& light : all.lights) {
        Scene one = all;
        one.lights = {light};
        const ReferenceResult r = renderReference(TraceScene(one), options);
        sum += meanOf(r.image);
        variance += std::pow(relativeError(r) * meanOf(r.image), 2);
    }
    variance += std::pow(relativeError(together) * sum, 2);
    EXPECT_NEAR(meanOf(together.image), sum, 4 * std::sqrt(variance));
    EXPECT_LT(together.noise, 0.05);
}

TEST(Reference, AWhiteFurnaceGlowsByEmissionOverOneMinusAlbedo) {
    for (float albedo : {0.2f, 0.5f, 0.9f, 0.95f, 0.99f}) {
        SceneBuilder b;
        b.addMaterial(lambert(glm::vec3(albedo), glm::vec3(1)));
        b.add(box(glm::vec3(-1), {1, 2, 3}, true));
        const TraceScene trace(b.build());
        // The number of bounces varies more the longer paths are.
        const auto options = optionsFor(View::Indirect, {0, 0.2f, 0.4f}, {1, 1, 1}, 24, 64);
        const ReferenceResult r = renderReference(trace, options);
        const double expected = double(albedo) / (1 - double(albedo));
        EXPECT_NEAR(meanOf(r.image) / expected, 1, 4 * relativeError(r) + 1e-5) << albedo;
        EXPECT_LT(relativeError(r), albedo < 0.92f ? 4e-3 : 8e-3);
    }
}

TEST(Reference, AnIntegratingSphereHasUniformBouncedLight) {
    for (float albedo : {0.3f, 0.8f}) {
        SceneBuilder b;
        b.addMaterial(lambert(glm::vec3(albedo)));
        Mesh ball = sphere(2, 4, true);
        ball.normals.clear(); // facets: energy is conserved exactly
        b.add(ball);
        b.scene.lights = {pointLight(glm::vec3(0), 10)};
        const TraceScene trace(b.build());
        const bool dark = albedo < 0.5f; // short paths, little noise: can show 0.1 %
        auto options =
            optionsFor(View::Irradiance, {0, 0, 0}, {1, 1, 1}, 32, dark ? 400 : 100, 1.5f);
        const ReferenceResult r = renderReference(trace, options);
        // All flux lands on the facets: rho / (1 - rho) Phi over their area, 0.17 % under 4 pi R^2.
        // What is left of the tessellation is the unevenness of E over a facet, under 0.05 %.
        const double rho = double(albedo), flux = 4 * kPi * 10;
        const double expected = rho / (1 - rho) * flux / areaOf(ball);
        EXPECT_NEAR(areaOf(ball) / (4 * kPi * 4), 1, 2e-3);
        EXPECT_NEAR(meanOf(r.image) / expected, 1, 5e-4 + 4 * relativeError(r)) << albedo;
        EXPECT_LT(relativeError(r), dark ? 1.25e-4 : 2e-3);
    }
}

// Concentric spheres exchange light in closed form: the inner one is convex, so F12 = 1,
// F21 = A1 / A2 and F22 = 1 - F21.
TEST(Reference, ConcentricSpheresBalanceTheirRadiosities) {
    SceneBuilder b;
    const double rho1 = 0.3, rho2 = 0.7, Le = 2;
    b.addMaterial(lambert(glm::vec3(float(rho1)), glm::vec3(float(Le))));
    b.addMaterial(lambert(glm::vec3(float(rho2))));
    Mesh inner = sphere(0.5f, 4, false, 0), outer = sphere(2, 4, true, 1);
    inner.normals.clear();
    outer.normals.clear();
    b.add(inner);
    b.add(outer);
    const TraceScene trace(b.build());
    const double F21 = areaOf(inner) / areaOf(outer);
    // B1 = pi Le + rho1 B2, B2 = rho2 E2, E2 = F21 B1 + (1 - F21) B2
    const double E2 = F21 * kPi * Le / (1 - rho2 * (F21 * rho1 + 1 - F21));
    auto options = optionsFor(View::Irradiance, {0, 0, 1.2f}, {0, 0, 2}, 32, 256, 1.2f);
    const ReferenceResult r = renderReference(trace, options);
    EXPECT_NEAR(meanOf(r.image) / E2, 1, 4 * relativeError(r) + 1e-3);
    EXPECT_LT(relativeError(r), 1.5e-3);
}

TEST(Reference, ParallelPlatesExchangeTheirFormFactor) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0), glm::vec3(1)));
    b.addMaterial(lambert(glm::vec3(0)));
    b.add(lamp(0.5f, 0.5f, 1, 0));
    b.add(quad({-0.5f, 0, 0.5f}, {1, 0, 0}, {0, 0, -1}, 1));
    const TraceScene trace(b.build());
    // Two opposed unit squares one apart: F = 2/pi (ln sqrt(4/3) + 2 sqrt2 atan(1/sqrt2) - pi/2).
    const double F =
        2 / kPi *
        (std::log(std::sqrt(4.0 / 3)) + 2 * std::sqrt(2.0) * std::atan(std::sqrt(0.5)) - kPi / 2);
    double sum = 0;
    constexpr int n = 32; // midpoint rule: error below 1e-4 for this smooth field
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            sum +=
                double(referenceIrradiance(
                           trace, {(float(x) + 0.5f) / n - 0.5f, 0, (float(y) + 0.5f) / n - 0.5f},
                           {0, 1, 0}, 64, 8, true, std::uint32_t(y * n + x))
                           .x);
    EXPECT_NEAR(sum / (n * n) / kPi, F, 1e-3 * F);
}

TEST(Reference, ARectangularLampGivesItsFormFactorNearFarAndAtEveryScale) {
    for (float scale : {1e-3f, 1.f, 1e4f})
        for (float h : {0.01f, 0.2f, 1.f, 5.f}) {
            SceneBuilder b;
            b.addMaterial(lambert(glm::vec3(0), glm::vec3(3)));
            b.addMaterial(lambert(glm::vec3(0)));
            b.add(lamp(1, 0.5f, h, 0), glm::scale(glm::mat4(1), glm::vec3(scale)));
            const TraceScene trace(b.build());
            const double F = 4 * cornerFormFactor(1, 0.5, double(h));
            const glm::vec3 E =
                referenceIrradiance(trace, glm::vec3(0), {0, 1, 0}, 1 << 15, 4, true, 1);
            // Multiple importance sampling keeps the samples' deviation below E: 1 / sqrt(2^15) =
            // 0.55 %, before stratification.
            EXPECT_NEAR(double(E.x) / (kPi * 3 * F), 1, 4e-3) << "h " << h << " scale " << scale;
        }
}

TEST(Reference, ATexturedLampSendsItsTexelsLight) {
    SceneBuilder b;
    b.assets->images.push_back({"half", 2, 1, {255, 255, 255, 255, 0, 0, 0, 255}});
    Material m = lambert(glm::vec3(0), glm::vec3(1));
    m.emissiveTexture.image = 0;
    m.emissiveTexture.nearest = true;
    b.addMaterial(m);
    b.add(lamp(1, 0.5f, 0.3f, 0)); // u grows with x: x < 0 shines
    const TraceScene trace(b.build());
    for (float x : {-0.6f, 0.f, 0.6f}) {
        const double left = double(x) + 1,
                     right = -double(x); // of the point, to the lit part's ends
        const double F = 2 * (cornerFormFactor(left, 0.5, 0.3) +
                              (right < 0 ? -1 : 1) * cornerFormFactor(std::abs(right), 0.5, 0.3));
        const glm::vec3 E = referenceIrradiance(trace, {x, 0, 0}, {0, 1, 0}, 1 << 16, 4, true, 1);
        EXPECT_NEAR(double(E.x) / (kPi * F), 1, 5e-3) << x;
    }
}

TEST(Reference, AConstantSkyGivesPiTimesItsRadiance) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}));
    b.scene.sky.radiance = {1, 2, 3};
    const TraceScene trace(b.build());
    const glm::vec3 E = referenceIrradiance(trace, glm::vec3(0), {0, 1, 0}, 64, 8, true, 1);
    EXPECT_LT(glm::length(E - glm::pi<float>() * glm::vec3(1, 2, 3)), 1e-5f);
    const auto pixel = [&](View view, glm::vec3 target) {
        return renderReference(trace, optionsFor(view, {0, 3, 0.01f}, target, 1, 4, 1e-3f))
            .image.rgb[0];
    };
    EXPECT_LT(glm::length(pixel(View::Lit, {0, 9, 0}) - glm::vec3(1, 2, 3)), 1e-6f);
    EXPECT_EQ(pixel(View::Irradiance, {0, 9, 0}), glm::vec3(0));
    EXPECT_EQ(pixel(View::Indirect, {0, 9, 0}), glm::vec3(0));
    EXPECT_EQ(pixel(View::Direct, {0, 0, 0}), glm::vec3(0));
    EXPECT_LT(glm::length(pixel(View::Indirect, {0, 0, 0}) - glm::vec3(0.5f, 1, 1.5f)), 1e-5f);
}

TEST(Reference, APanoramaLightsByTheIntegralOfItsRadiance) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0)));
    b.add(quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}));
    // Upper half: 3 in the quarter right of -Z, else 0. Lower half: 100, which the ground hides.
    ImageF panorama{4, 2, std::vector<glm::vec3>(8, glm::vec3(100))};
    for (int x = 0; x < 4; ++x)
        panorama.rgb[std::size_t(x)] = glm::vec3(x == 2 ? 3.f : 0.f);
    b.scene.sky = {.kind = SkyKind::Image,
                   .radiance = glm::vec3(9),
                   .image = "x",
                   .strength = 2,
                   .panorama = makeSkyImage(panorama)};
    const TraceScene trace(b.build());
    const auto up = referenceIrradiance(trace, glm::vec3(0), {0, 1, 0}, 4096, 1, false, 1);
    EXPECT_NEAR(double(up.x), kPi * 2 * 3 / 4, 0.02); // a quarter of the hemisphere
    const auto pixel = [&](glm::vec3 target) {
        return renderReference(trace, optionsFor(View::Lit, {0, 1, 0}, target, 1, 4, 1e-3f))
            .image.rgb[0];
    };
    EXPECT_EQ(pixel({1, 2, -1}), glm::vec3(6));
    EXPECT_EQ(pixel({-1, 2, -1}), glm::vec3(0));
}

TEST(Reference, ASmallSunInAPanoramaIsFoundAtEverySample) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0)));
    b.add(quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}));
    ImageF panorama{512, 256, std::vector<glm::vec3>(512 * 256, glm::vec3(1))};
    const std::uint32_t row = 64, column = 300; // 45 degrees high
    panorama.rgb[row * 512 + column] = glm::vec3(1e6f);
    b.scene.sky = {.kind = SkyKind::Image, .rotation = 0.7f, .panorama = makeSkyImage(panorama)};
    const TraceScene trace(b.build());
    const double step = kPi / 256, upper = std::cos(row * step), lower = std::cos((row + 1) * step);
    const double sun = (1e6 - 1) * step * (upper * upper - lower * lower) / 2; // of the mean height
    const auto up = referenceIrradiance(trace, glm::vec3(0), {0, 1, 0}, 256, 1, false, 1);
    EXPECT_NEAR(double(up.x), kPi + sun, 5e-3 * sun);
    // And is where it is seen.
    const SkyLight light = findSkyLight(trace.scene().sky);
    for (int i = 0; i < 100; ++i) {
        const glm::vec2 u((float(i) + 0.5f) / 100, std::fmod(float(i) * 0.618f, 1.f));
        const SkySample s = sampleSky(light, trace.scene().sky, u);
        EXPECT_EQ(skyRadiance(trace.scene().sky, s.direction), s.radiance);
    }
}

TEST(Reference, AGradientIsLinearInTheHeight) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0)));
    b.add(quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}));
    b.scene.sky = {.kind = SkyKind::Gradient, .radiance = {4, 0, 0}, .horizon = {1, 2, 0}};
    b.scene.sky.ground = glm::vec3(100);
    const TraceScene trace(b.build());
    // Of h + (z - h) y, with the cosine y: pi h + 2 pi / 3 (z - h).
    const auto up = referenceIrradiance(trace, glm::vec3(0), {0, 1, 0}, 4096, 1, false, 1);
    EXPECT_NEAR(double(up.x), kPi * (1 + 2.0 / 3 * 3), 2e-2);
    EXPECT_NEAR(double(up.y), kPi * (2 - 2.0 / 3 * 2), 2e-2);
}

TEST(Reference, LitIsDirectPlusIndirectPlusOwnEmissionPlusReflection) {
    SceneBuilder b;
    b.addMaterial(lambert({0.2f, 0.5f, 0.8f}, {0.3f, 0.2f, 0.1f}));
    b.addMaterial(lambert(glm::vec3(0.6f)));
    b.add(quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}));
    b.add(box({-1, 0, -3}, {1, 2, -1}, false, 1));
    b.scene.lights = {pointLight({0, 3, 0}, 5)};
    b.scene.sky.radiance = glm::vec3(0.2f);
    const TraceScene trace(b.build());
    const auto render = [&](View view) {
        auto o = optionsFor(view, {0, 4, 3}, {0, 0, -1}, 8, 16, 0.3f);
        return renderReference(trace, o).image.rgb;
    };
    const auto lit = render(View::Lit), direct = render(View::Direct),
               indirect = render(View::Indirect), irradiance = render(View::Irradiance),
               albedo = render(View::Albedo);
    for (std::size_t i = 0; i < lit.size(); ++i) {
        const bool floor = albedo[i] == glm::vec3(0.2f, 0.5f, 0.8f);
        const bool block = albedo[i] == glm::vec3(0.6f);
        if (!floor && !block)
            continue; // a pixel of both
        const glm::vec3 emission = floor ? glm::vec3(0.3f, 0.2f, 0.1f) : glm::vec3(0);
        // Of the same samples in every view. Reflection of a dielectric only adds, and less than a
        // tenth of what arrives.
        for (int c = 0; c < 3; ++c) {
            const float glossy = lit[i][c] - direct[i][c] - indirect[i][c] - emission[c];
            EXPECT_GT(glossy, 0);
            EXPECT_LT(glossy, 0.1f * (direct[i][c] + indirect[i][c]) / albedo[i][c]);
        }
        EXPECT_LT(glm::length(indirect[i] - albedo[i] * irradiance[i] / glm::pi<float>()), 1e-5f);
    }
}

TEST(Reference, AMaskedLeafShadesWhereItsTexelsAreOpaque) {
    SceneBuilder b;
    b.addMaterial(
        masked(b, {"mask", 2, 1, {255, 255, 255, 255, 255, 255, 255, 0}}, glm::vec3(0.5f)));
    b.add(quad({-1, 1, -1}, {2, 0, 0}, {0, 0, 2}));
    b.scene.lights = {sun({0, -1, 0}, 7)};
    const TraceScene trace(b.build());
    const auto irradiance = [&](float x) {
        return referenceIrradiance(trace, {x, 0, 0.3f}, {0, 1, 0}, 1, 1, true, 1).x;
    };
    EXPECT_EQ(irradiance(-0.5f), 0);
    EXPECT_FLOAT_EQ(irradiance(0.5f), 7);
    EXPECT_FLOAT_EQ(irradiance(1.5f), 7);
}

TEST(Reference, TheBackOfAOneSidedSurfaceIsBlackAndBlocks) {
    for (bool doubleSided : {false, true}) {
        SceneBuilder b;
        Material m = lambert(glm::vec3(0.5f), glm::vec3(4));
        m.doubleSided = doubleSided;
        b.addMaterial(m);
        b.add(quad({-50, 1, 50}, {100, 0, 0}, {0, 0, -100})); // front up
        b.scene.sky.radiance = glm::vec3(1);
        b.scene.lights = {sun({0, -1, 0}, 7)};
        const TraceScene trace(b.build());
        const auto options = optionsFor(View::Lit, {0, 0, 0}, {0, 1, 0.01f}, 4, 4);
        const double seen = meanOf(renderReference(trace, options).image);
        const glm::vec3 E = referenceIrradiance(trace, glm::vec3(0), {0, 1, 0}, 1024, 8, true, 1);
        if (doubleSided) { // emits; below it is all sky, of which its lobe reflects 1.57 % at most
            EXPECT_GT(seen, 4.5);
            EXPECT_LT(seen, 4.5157);
            EXPECT_NEAR(double(E.x), 4.5 * kPi, 0.02);
        } else {
            EXPECT_EQ(seen, 0);
            // Only a rim of sky beyond 50 m: cos^2 there is 1 / 2501.
            EXPECT_NEAR(double(E.x), 0, 0.01);
        }
    }
}

TEST(Reference, TheNumberOfThreadsChangesNoByte) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.7f)));
    b.addMaterial(lambert(glm::vec3(0.1f), glm::vec3(5)));
    b.add(box(glm::vec3(-1), glm::vec3(1), true));
    b.add(lamp(0.2f, 0.2f, 0.99f, 1));
    b.scene.lights = {pointLight({0.5f, 0, 0}, 1), pointLight({-0.5f, 0, 0}, 1)};
    const Scene scene = b.build();
    const auto render = [&](int threads) {
        const ThreadLimit limit(threads);
        return renderReference(TraceScene(scene),
                               optionsFor(View::Lit, {0, 0, 0.9f}, glm::vec3(0), 40, 10));
    };
    const ReferenceResult one = render(1), two = render(2);
    EXPECT_EQ(one.image, two.image);
    EXPECT_EQ(one.rays, two.rays);
    EXPECT_EQ(one.noise, two.noise);
}

TEST(Reference, NoiseIsTheDeviationBetweenSeeds) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.7f)));
    b.add(box(glm::vec3(-1), glm::vec3(1), true));
    b.scene.lights = {pointLight({0.5f, 0, 0}, 1)};
    const TraceScene trace(b.build());
    for (std::uint32_t spp : {2u, 9u, 64u}) {
        auto options = optionsFor(View::Irradiance, {0, 0, 0.9f}, glm::vec3(0), 32, spp);
        const ReferenceResult a = renderReference(trace, options);
        options.seed = 2;
        const ReferenceResult c = renderReference(trace, options);
        double sum = 0;
        for (std::size_t i = 0; i < a.image.rgb.size(); ++i)
            sum +=
                double(glm::dot(a.image.rgb[i] - c.image.rgb[i], a.image.rgb[i] - c.image.rgb[i]));
        const double rms = std::sqrt(sum / (2 * 3 * double(a.image.rgb.size())));
        // 1024 pixels of heavy-tailed noise give its rms to some 10 %. The halves carry half the
        // stratification of the whole, so the estimate may lie above, not below.
        EXPECT_GT(a.noise * meanOf(a.image), 0.8 * rms) << spp;
        EXPECT_LT(a.noise * meanOf(a.image), 2.0 * rms) << spp;
    }
}

TEST(Reference, ACancelledRenderReturnsWhatItHas) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(box(glm::vec3(-1), glm::vec3(1), true));
    b.scene.sky.radiance = glm::vec3(1);
    b.scene.lights = {pointLight({0.5f, 0, 0}, 1)};
    const TraceScene trace(b.build());
    const auto options = optionsFor(View::Lit, {0, 0, 0.9f}, glm::vec3(0), 32, 64);
    std::atomic<bool> cancel = true;
    Progress progress;
    progress.cancel = &cancel;
    const ReferenceResult none = renderReference(trace, options, progress);
    EXPECT_EQ(none.samplesPerPixel, 0u);
    EXPECT_EQ(meanOf(none.image), 0);

    cancel = false;
    float last = 0;
    progress.report = [&](const char*, float f) {
        EXPECT_GE(f, 0);
        EXPECT_LE(f, 1);
        last = f;
        cancel = f > 0.5f;
    };
    const ReferenceResult part = renderReference(trace, options, progress);
    EXPECT_GE(part.samplesPerPixel, 16u);
    EXPECT_LT(part.samplesPerPixel, 64u);
    EXPECT_GT(last, 0.5f);
    cancel = false;
    progress = {};
    const ReferenceResult whole = renderReference(trace, options);
    EXPECT_NEAR(meanOf(part.image) / meanOf(whole.image), 1, 0.02);
}

TEST(Reference, AnEmptySceneShowsTheSky) {
    Scene scene;
    scene.sky.radiance = glm::vec3(0.25f);
    const ReferenceResult r =
        renderReference(TraceScene(scene), optionsFor(View::Lit, {0, 0, 1}, {0, 0, 0}, 4, 2));
    EXPECT_EQ(meanOf(r.image), 0.25);
    EXPECT_EQ(r.noise, 0);
}

TEST(Reference, ARectangleLightGivesTheClosedFormAndTheSameSceneAnEmitterDoes) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.addMaterial(lambert(glm::vec3(0), glm::vec3(4)));
    b.add(quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}));
    b.add(quad({-1.2f, 1, -1}, {0.9f, 0, 0}, {0, 0, 2})); // shadows part of it
    Light panel;
    panel.kind = LightKind::Rectangle;
    panel.position = {0, 2, 0};
    panel.size = {1.2f, 0.8f};
    panel.strength = 4;
    b.scene.lights = {panel};
    const Scene lit = b.build();
    const auto corner =
        optionsFor(View::Direct, {0.6f, 0.5f, 0.4f}, {0.6f, 0, 0.401f}, 1, 64, 1e-3f);
    const ReferenceResult point = renderReference(TraceScene(lit), corner);
    EXPECT_NEAR(double(point.image.rgb[0].x), 0.5 * 4 * cornerFormFactor(1.2, 0.8, 2), 2e-3);

    b.scene.lights.clear();
    b.add(lamp(0.6f, 0.4f, 2, 1));
    const Scene glowing = b.build();
    // A black lamp: only the light on the floor differs in how it is found.
    auto options = optionsFor(View::Direct, {0, 1.5f, 3}, {0, 0, 0}, 24, 256);
    const ReferenceResult direct = renderReference(TraceScene(lit), options);
    options.view = View::Indirect;
    options.maxBounces = 1;
    const ReferenceResult emitted = renderReference(TraceScene(glowing), options);
    const double error = std::hypot(relativeError(direct), relativeError(emitted));
    EXPECT_NEAR(meanOf(direct.image) / meanOf(emitted.image), 1, 4 * error + 1e-5);
    EXPECT_LT(error, 5e-3);
}

} // namespace limn::reference_test
