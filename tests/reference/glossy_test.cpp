// SPDX-License-Identifier: MIT
#include "engine/math/lobe.h"
#include "engine/picture/field_render.h"
#include "engine/reference/reference.h"
#include "engine/scene/surface/reflection_lobe.h"
#include "engine/shading/sampler.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <cmath>

#include <glm/gtc/constants.hpp>

namespace limn::glossy_test {

using namespace simple;

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

glm::vec3 meanColor(const ImageF& image) {
    glm::dvec3 sum(0);
    for (const glm::vec3 c : image.rgb)
        sum += glm::dvec3(c);
    return glm::vec3(sum / double(image.rgb.size()));
}

constexpr float kRoughnesses[] = {0.15f, 0.4f, 0.7f, 1.f};

/// Integral over the hemisphere about y of specularBrdf() times the cosine times 1 and d.y, by
/// rings about the mirrored direction.
struct Reflected {
    glm::vec3 light{0}, height{0};
};
Reflected reflected(const Gloss& gloss, glm::vec3 toEye) {
    constexpr int kRings = 600, kSpokes = 180;
    const float pi = glm::pi<float>();
    const glm::vec3 n(0, 1, 0);
    Reflected sum;
    for (int i = 0; i < kRings; ++i) {
        const float t = (float(i) + 0.5f) / kRings, theta = pi * t * t * t;
        const float solidAngle = std::sin(theta) * 3 * pi * t * t / kRings * 2 * pi / kSpokes;
        for (int j = 0; j < kSpokes; ++j) {
            const glm::vec3 d = directionAbout(glm::reflect(-toEye, n), std::sin(theta),
                                               std::cos(theta), (float(j) + 0.5f) / kSpokes);
            if (!(d.y > 0))
                continue;
            const glm::vec3 f = specularBrdf(gloss, n, toEye, d) * (d.y * solidAngle);
            sum.light += f;
            sum.height += f * d.y;
        }
    }
    return sum;
}

} // namespace

// What a ball of clear glass does not mirror of an even sky it lets through, so that it vanishes
// before it. Schlick's term stands for Fresnel's equations in what is mirrored, which is as much
// where one looks straight at it.
TEST(Glossy, ABallOfGlassVanishesBeforeAnEvenSky) {
    SceneBuilder b;
    Material glass;
    glass.roughness = 0;
    glass.transmission = 1;
    glass.thickness = 1;
    b.addMaterial(glass);
    b.add(sphere(1, 4, false));
    b.scene.sky.radiance = {1, 2, 3};
    const TraceScene trace(b.build());
    const glm::vec3 seen = meanColor(renderReference(trace, pointOptions({0, 0, 4}, {}, 64)).image);
    EXPECT_LT(glm::length(seen - glm::vec3(1, 2, 3)), 0.01f);
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
        const ReferenceOptions o = pointOptions({0, 0.5f, 0}, {0, 0.5f, -1}, 256);
        const Gloss gloss{glm::vec3(m.baseColor), roughness};
        const glm::vec3 truth = glm::vec3(1) + reflected(gloss, {0, 1, 0}).light;
        EXPECT_LT(glm::length(meanColor(renderReference(trace, o).image) - truth), 4e-3f)
            << roughness;
        // In spherical harmonics of any number of bands too.
        const glm::vec3 expected = glm::vec3(1) + specularAlbedo(gloss, 1);
        EXPECT_LT(glm::length(expected - truth), 0.01f) << "the table's error";
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
                f.samplesPerPixel = 1;
                EXPECT_LT(glm::length(meanColor(renderField(trace, field, {}, f)) - expected),
                          1e-3f);
            }
        }
    }
}

// Light that grows with the height it comes from, 1 + 2 y, is of two bands, which the lobe of a
// white metal has exactly: path tracing and harmonics agree with the integral, at any angle.
TEST(Glossy, AGradientIsReflectedAsTheBrdfDoes) {
    for (const float roughness : kRoughnesses)
        for (const float NoV : {0.2f, 0.5f, 0.9f}) {
            SceneBuilder b;
            b.addMaterial(metal(glm::vec3(1), roughness));
            b.add(quad({-50, 0, 50}, {100, 0, 0}, {0, 0, -100}));
            b.scene.sky.kind = SkyKind::Gradient;
            b.scene.sky.radiance = glm::vec3(3);
            b.scene.sky.horizon = glm::vec3(1);
            const TraceScene trace(b.build());
            const glm::vec3 toEye(std::sqrt(1 - NoV * NoV), NoV, 0);
            const Reflected r = reflected({glm::vec3(1), roughness}, toEye);
            const glm::vec3 truth = r.light + 2.f * r.height;
            const ReferenceOptions o = pointOptions(2.f * toEye, {0, 0, 0}, 1024);
            EXPECT_LT(glm::length(meanColor(renderReference(trace, o).image) - truth),
                      4e-3f * glm::length(truth))
                << roughness << " " << NoV;

            IndirectField field;
            field.bands = 2;
            field.gridSize = {1, 1, 1};
            field.gridBounds = {glm::vec3(-50), glm::vec3(50)};
            field.grid.assign(field.coefficients(), glm::vec4(0));
            const float pi = glm::pi<float>();
            field.grid[0] = glm::vec4(2 * std::sqrt(pi));
            field.grid[1] = glm::vec4(2 * std::sqrt(4 * pi / 3)); // of y
            FieldRenderOptions f = fieldOptions(o);
            f.windowedLobes = false;
            f.samplesPerPixel = 1;
            EXPECT_LT(glm::length(meanColor(renderField(trace, field, {}, f)) - truth),
                      0.012f * glm::length(truth))
                << roughness << " " << NoV;
        }
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
            EXPECT_LT(glm::length(meanColor(image) - expected), 1e-3f * glm::length(expected));
    }
}

TEST(Glossy, ReadsTheBandsThatItsMaterialNeedsAndTheFieldHas) {
    SceneBuilder b;
    b.addMaterial(metal(glm::vec3(1), 0.2f));
    b.add(quad({-5, 0, 5}, {10, 0, 0}, {0, 0, -10}));
    const TraceScene trace(b.build());
    const ReferenceOptions o = pointOptions({1, 2, 0.5f}, {0, 0, 0}, 1);
    const glm::vec3 toEye = glm::normalize(o.camera.eye), mirrored(-toEye.x, toEye.y, -toEye.z);
    const ReflectionLobe lobe = reflectionLobe(0.2f, toEye.y);
    for (std::uint32_t bands = 2; bands <= 8; ++bands) {
        IndirectField field;
        field.bands = bands;
        field.gridSize = {1, 1, 1};
        field.gridBounds = {glm::vec3(-5), glm::vec3(5)};
        field.grid.assign(field.coefficients(), glm::vec4(0));
        for (std::uint32_t i = 0; i < field.coefficients(); ++i)
            field.grid[i] = glm::vec4(i == 0 ? 9.f : 1.f / float(i)); // positive everywhere
        float y[kMaxCoefficients];
        shBasis(int(bands), lobeAxis(lobe, {0, 1, 0}, mirrored), y);
        const auto s = windowedFactors(lobe.factors, int(bands));
        float expected = 0;
        for (int i = 0, l = 0; i < int(field.coefficients()); l += ++i == (l + 1) * (l + 1))
            expected += s[std::size_t(l)] * y[i] * field.grid[std::size_t(i)].x;
        ASSERT_GT(expected, 0);
        expected *= specularAlbedo({glm::vec3(1), 0.2f}, toEye.y).x;
        EXPECT_NEAR(meanColor(renderField(trace, field, {}, fieldOptions(o))).x, expected,
                    1e-3f * expected)
            << bands;
    }
}

} // namespace limn::glossy_test
