// SPDX-License-Identifier: MIT
#include "engine/math/lobe.h"
#include "engine/reference/field_render.h"
#include "engine/reference/reference.h"
#include "engine/reference/sampler.h"
#include "engine/scene/specular.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <cmath>

#include <glm/gtc/constants.hpp>

using namespace limn;
using namespace limn::simple;

namespace {

Material metal(glm::vec3 color, float roughness) {
    Material m;
    m.baseColor = glm::vec4(color, 1);
    m.metallic = 1;
    m.roughness = roughness;
    return m;
}

/// The middle of what `eye` sees in the direction of `target`, all but a point.
ReferenceOptions pointOptions(glm::vec3 eye, glm::vec3 target, std::uint32_t spp) {
    ReferenceOptions o;
    o.camera.eye = eye;
    o.camera.target = target;
    o.camera.fovY = 1e-3f;
    o.width = o.height = 4;
    o.samplesPerPixel = spp;
    return o;
}

FieldRenderOptions fieldOptions(const ReferenceOptions& o) {
    FieldRenderOptions f;
    f.camera = o.camera;
    f.width = o.width;
    f.height = o.height;
    f.samplesPerPixel = o.samplesPerPixel;
    return f;
}

glm::vec3 meanOf(const ImageF& image) {
    glm::dvec3 sum(0);
    for (const glm::vec3 c : image.rgb)
        sum += glm::dvec3(c);
    return glm::vec3(sum / double(image.rgb.size()));
}

constexpr float kRoughnesses[] = {0.731f, 0.5f, 0.374f}; // n = 5, 30, 100

} // namespace

TEST(SampleLobe, HasTheMomentsOfTheNormalisedLobe) {
    constexpr std::uint32_t count = 1 << 14;
    const glm::vec3 axis = glm::normalize(glm::vec3(-1, 2, -3));
    for (const float n : {0.f, 1.f, 5.f, 30.f, 100.f}) {
        glm::dvec3 mean(0);
        for (std::uint32_t i = 0; i < count; ++i) {
            const glm::vec3 d = sampleLobeDirection(axis, n, Sampler{1, i}.pair(0));
            ASSERT_NEAR(glm::length(d), 1, 1e-5f);
            mean += glm::dvec3(d) / double(count);
        }
        EXPECT_LT(glm::length(mean - double((n + 1) / (n + 2)) * glm::dvec3(axis)), 1e-3) << n;
    }
}

// A room that glows evenly and sends nothing back: whoever looks straight at a metal wall sees its
// own glow and the share of 1 that its lobe reflects.
TEST(Glossy, AFurnaceIsReflectedWhole) {
    for (const float roughness : kRoughnesses) {
        SceneBuilder b;
        Material m = metal({1, 0.5f, 0.25f}, roughness);
        m.emission = glm::vec3(1);
        b.addMaterial(m);
        b.add(box(glm::vec3(-1), {1, 2, 3}, true));
        const TraceScene trace(b.build());
        const ReferenceOptions o = pointOptions({0, 0.5f, 0}, {0, 0.5f, -1}, 16);
        const glm::vec3 expected =
            glm::vec3(1) + specularAlbedo({glm::vec3(m.baseColor), roughness}, 1);
        EXPECT_LT(glm::length(meanOf(renderReference(trace, o).image) - expected), 1e-3f);
        // In spherical harmonics of any number of bands too.
        for (std::uint32_t bands = 2; bands <= 8; ++bands) {
            IndirectField field;
            field.bands = bands;
            field.gridSize = {1, 1, 1};
            field.gridBounds = {glm::vec3(-1), {1, 2, 3}};
            field.grid.assign(field.coefficients(), glm::vec4(0));
            field.grid[0] = glm::vec4(2 * std::sqrt(glm::pi<float>()));
            for (const bool windowed : {true, false}) {
                FieldRenderOptions f = fieldOptions(o);
                f.windowedLobes = windowed;
                EXPECT_LT(glm::length(meanOf(renderField(trace, field, {}, f)) - expected), 1e-3f);
            }
        }
    }
}

// Below a sky that is bright where y > 0 a mirrored direction at an elevation of 30 degrees has a
// share of its lobe under the horizon. For n = 1 the integral is (1 + sin 30) / 2 = 3/4 in closed
// form: the form factor of a half space.
TEST(Glossy, OfALobeTheHorizonCutsItsShare) {
    SceneBuilder b;
    const float roughness = std::pow(2.f / 3, 0.25f); // alpha^2 = 2 / (n + 2), n = 1
    ASSERT_NEAR(lobeExponent(roughness), 1, 1e-5f);
    Material m = metal(glm::vec3(1), roughness);
    m.emission = {4, 5, 6}; // which no surface sees of itself
    b.addMaterial(m);
    b.add(quad({-50, 0, 50}, {100, 0, 0}, {0, 0, -100}));
    b.scene.sky.radiance = {1, 2, 3};
    const TraceScene trace(b.build());
    const glm::vec3 toEye(std::cos(glm::pi<float>() / 6), 0.5f, 0);
    const ReferenceResult r = renderReference(trace, pointOptions(2.f * toEye, {0, 0, 0}, 4096));
    const glm::vec3 expected =
        m.emission + 0.75f * specularAlbedo({glm::vec3(1), roughness}, 0.5f) * glm::vec3(1, 2, 3);
    EXPECT_LT(glm::length(meanOf(r.image) - expected), 2e-3f * glm::length(expected));
}

// Both pictures take a light's highlight from one formula: irradiance times the BRDF.
TEST(Glossy, ALightIsReflectedByTheBrdf) {
    for (const float roughness : kRoughnesses) {
        SceneBuilder b;
        b.addMaterial(metal({0.9f, 0.6f, 0.3f}, roughness));
        b.add(quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}));
        Light sun;
        sun.kind = LightKind::Directional;
        sun.direction = glm::normalize(glm::vec3(1, -1.5f, 0.2f));
        sun.strength = 5;
        b.scene.lights = {sun};
        const TraceScene trace(b.build());
        const ReferenceOptions o = pointOptions({1.5f, 2, 0}, {0, 0, 0}, 4);
        const glm::vec3 n(0, 1, 0);
        const glm::vec3 expected = 5 * -sun.direction.y *
                                   specularBrdf({{0.9f, 0.6f, 0.3f}, roughness}, n,
                                                glm::normalize(o.camera.eye), -sun.direction);
        for (const ImageF& image :
             {renderReference(trace, o).image, renderField(trace, {}, {}, fieldOptions(o))})
            EXPECT_LT(glm::length(meanOf(image) - expected), 1e-3f * glm::length(expected));
    }
}

TEST(Glossy, ReadsTheBandsThatItsMaterialNeedsAndTheFieldHas) {
    SceneBuilder b;
    b.addMaterial(metal(glm::vec3(1), 0.374f));
    b.add(quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}));
    const TraceScene trace(b.build());
    const ReferenceOptions o = pointOptions({1, 2, 0.5f}, {0, 0, 0}, 1);
    const glm::vec3 toEye = glm::normalize(o.camera.eye), mirrored(-toEye.x, toEye.y, -toEye.z);
    for (std::uint32_t bands = 2; bands <= 8; ++bands) {
        IndirectField field;
        field.bands = bands;
        field.gridSize = {1, 1, 1};
        field.gridBounds = {glm::vec3(-5), glm::vec3(5)};
        field.grid.assign(field.coefficients(), glm::vec4(0));
        for (std::uint32_t i = 0; i < field.coefficients(); ++i)
            field.grid[i] = glm::vec4(i == 0 ? 9.f : 1.f / float(i)); // positive everywhere
        float y[kMaxCoefficients];
        shBasis(int(bands), mirrored, y);
        const auto s = windowedLobeFactors(lobeExponent(0.374f), int(bands));
        float expected = 0;
        for (int i = 0, l = 0; i < int(field.coefficients()); l += ++i == (l + 1) * (l + 1))
            expected += s[std::size_t(l)] * y[i] * field.grid[std::size_t(i)].x;
        ASSERT_GT(expected, 0);
        expected *= specularAlbedo({glm::vec3(1), 0.374f}, toEye.y).x;
        EXPECT_NEAR(meanOf(renderField(trace, field, {}, fieldOptions(o))).x, expected,
                    1e-3f * expected)
            << bands;
    }
}
