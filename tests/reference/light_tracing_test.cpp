// SPDX-License-Identifier: MIT
#include "engine/reference/light_tracing.h"

#include "engine/core/parallel.h"
#include "engine/measure/compare.h"
#include "engine/scene/surface/dielectric.h"
#include "tests/core/sweep.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

namespace limn::light_tracing_test {

using namespace simple;

namespace {

/// Root of the mean squared difference, over the mean of `b`.
double difference(const ImageF& a, const ImageF& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i)
        sum += double(glm::dot(a.rgb[i] - b.rgb[i], a.rgb[i] - b.rgb[i])) / 3;
    return std::sqrt(sum / double(a.rgb.size())) / meanOf(b);
}

/// A room that is open to one side, with a coarse ball whose normals are smooth.
SceneBuilder room() {
    SceneBuilder b;
    b.addMaterial(lambert({0.7f, 0.6f, 0.5f}));
    b.addMaterial(lambert({0.3f, 0.6f, 0.3f}));
    b.add(quad({-1, -1, 1}, {2, 0, 0}, {0, 0, -2}));
    b.add(quad({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}));
    b.add(quad({-1, -1, 1}, {0, 0, -2}, {0, 2, 0}));
    b.add(quad({1, -1, -1}, {0, 0, 2}, {0, 2, 0}, 1));
    b.add(sphere(0.4f, 1, false, 1), glm::translate(glm::mat4(1), {0.2f, -0.5f, -0.2f}));
    return b;
}

ReferenceOptions optionsFor(View view) {
    ReferenceOptions o;
    o.view = view;
    o.camera.eye = {0, 0, 3};
    o.camera.target = {0, -0.1f, 0};
    o.camera.fovY = 0.7f;
    o.width = 16;
    o.height = 14;
    o.samplesPerPixel = kSanitized ? 64 : 256;
    return o;
}

/// Both tracers must show the same picture, within the noise that they state.
void expectAgreement(const SceneBuilder& builder, ReferenceOptions o, const char* what) {
    SceneBuilder b = builder;
    const TraceScene trace(b.build());
    const ReferenceResult paths = renderReference(trace, o);
    o.seed = 5;
    const ReferenceResult photons = renderLightTraced(trace, o);
    EXPECT_EQ(photons.samplesPerPixel, o.samplesPerPixel);
    EXPECT_GT(meanOf(paths.image), 0) << what;
    const double noise = std::hypot(paths.noise, photons.noise);
    EXPECT_LT(noise, kSanitized ? 1.2 : 0.6) << what;
    EXPECT_LT(difference(photons.image, paths.image), 1.3 * noise) << what;
    EXPECT_GT(difference(photons.image, paths.image), 0.7 * noise) << what;
    EXPECT_NEAR(meanOf(photons.image) / meanOf(paths.image), 1,
                2 * noise / std::sqrt(double(o.width * o.height)))
        << what;
}

Light lamp(LightKind kind) {
    Light light;
    light.kind = kind;
    light.position = {-0.3f, 0.6f, 0.3f};
    light.direction = glm::normalize(glm::vec3(0.4f, -1, -0.3f));
    light.color = {1, 0.8f, 0.5f};
    light.strength = 4;
    light.size = {0.4f, 0.6f};
    return light;
}

TEST(LightTracing, AgreesWithPathsForEveryKindOfLight) {
    static constexpr const char* kKinds[] = {"sun", "point", "spot", "rectangle"};
    for (const LightKind kind :
         {LightKind::Directional, LightKind::Point, LightKind::Spot, LightKind::Rectangle}) {
        SceneBuilder b = room();
        b.scene.lights = {lamp(kind)};
        if (kind == LightKind::Point)
            b.scene.lights[0].range = 1.6f;
        if (kind == LightKind::Spot)
            b.scene.lights[0].position = {-1, 0.6f, 0.3f}; // in the plane of a wall
        expectAgreement(b, optionsFor(View::Irradiance), kKinds[std::size_t(kind)]);
    }
}

TEST(LightTracing, AgreesWithPathsForEmittersAndTheSky) {
    SceneBuilder panel = room();
    panel.scene.materials.push_back(lambert(glm::vec3(0.2f), {3, 2, 1}));
    panel.scene.materials.back().doubleSided = true;
    panel.add(quad({-0.4f, 0.5f, -0.4f}, {0.8f, 0, 0}, {0, 0, 0.8f}, 2));
    expectAgreement(panel, optionsFor(View::Irradiance), "panel");
    SceneBuilder sky = room();
    sky.scene.sky.kind = SkyKind::Gradient;
    sky.scene.sky.radiance = {0.2f, 0.5f, 1};
    sky.scene.sky.horizon = glm::vec3(1);
    sky.scene.sky.ground = glm::vec3(0.3f);
    expectAgreement(sky, optionsFor(View::Indirect), "sky");
}

/// Below a sheet of clear glass, paths see the sun as without it, and photons what the sheet lets
/// through.
TEST(LightTracing, ASheetOfGlassLetsTheSunThrough) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    Material glass = lambert(glm::vec3(1));
    glass.transmission = 1;
    glass.roughness = 0;
    b.addMaterial(glass);
    b.add(quad({-2, 0, 2}, {4, 0, 0}, {0, 0, -4}));
    b.add(quad({-2, 2, 2}, {4, 0, 0}, {0, 0, -4}, 1));
    Light sun{.kind = LightKind::Directional, .direction = {0, -1, 0}, .strength = 1};
    b.scene.lights = {sun};
    const TraceScene trace(b.build());
    ReferenceOptions o = optionsFor(View::Lit);
    o.camera.eye = {0, 1.5f, 0.1f};
    o.camera.target = {0, 0, 0};
    o.camera.fovY = 0.4f;
    o.samplesPerPixel = kSanitized ? 512 : 4096;
    o.width = o.height = 4;
    const double paths = meanOf(renderReference(trace, o).image);
    const ReferenceResult photons = renderLightTraced(trace, o);
    const double F = double(fresnelDielectric(1, 1.5f));
    EXPECT_NEAR(meanOf(photons.image) / paths, 1 - F, 4 * photons.noise / 4 + 0.01);
    o.view = View::Direct;
    EXPECT_NEAR(meanOf(renderReference(trace, o).image), 0.5 / glm::pi<double>(), 1e-5);
}

// The floor's shading normals lean towards the lamp, so that it receives more than falls on it.
TEST(LightTracing, AgreesWithPathsWhereShadingNormalsLean) {
    SceneBuilder b = room();
    b.scene.materials[0].baseColor = {0.95f, 0.9f, 0.85f, 1};
    for (glm::vec3& n : b.assets->meshes[0].normals)
        n = glm::normalize(glm::vec3(-0.8f, 1, 0.2f));
    b.scene.lights = {lamp(LightKind::Point)};
    b.scene.lights[0].position = {-0.8f, 0, 0.3f};
    ReferenceOptions o = optionsFor(View::Irradiance);
    o.camera.target = {0, -0.6f, 0};
    o.maxBounces = 2;
    expectAgreement(b, o, "leaning normals");
}

TEST(LightTracing, CountsBouncesAsPathsDo) {
    for (const std::uint32_t bounces : {1U, 2U}) {
        SceneBuilder b = room();
        b.scene.lights = {lamp(LightKind::Point)};
        b.scene.sky.radiance = glm::vec3(0.5f);
        ReferenceOptions o = optionsFor(View::Indirect);
        o.maxBounces = bounces;
        expectAgreement(b, o, bounces == 1 ? "one bounce" : "two bounces");
    }
}

// E = rho / (1 - rho) Phi / (4 pi R^2) all over a sphere with a point light in the middle.
TEST(LightTracing, ASphereIsLitByItsClosedForm) {
    const double rho = 0.5, R = 2, intensity = 3;
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(float(rho))));
    b.add(sphere(float(R), 4, true));
    Light light;
    light.position = glm::vec3(0);
    light.strength = float(intensity);
    b.scene.lights = {light};
    const TraceScene trace(b.build());
    ReferenceOptions o = optionsFor(View::Irradiance);
    o.camera.eye = {0.5f, 0.3f, -0.4f};
    o.camera.target = {0, 1, 0.5f};
    o.camera.fovY = 1.5f;
    o.samplesPerPixel = 256;
    const double one = rho * intensity / (R * R), all = one / (1 - rho);
    o.maxBounces = 1;
    EXPECT_NEAR(meanOf(renderLightTraced(trace, o).image) / one, 1, 0.015);
    o.maxBounces = kMaxBounces;
    const ReferenceResult r = renderLightTraced(trace, o);
    EXPECT_NEAR(meanOf(r.image) / all, 1, 0.015);
    double square = 0;
    for (const glm::vec3 c : r.image.rgb)
        square += std::pow(double(c.x) / all - 1, 2);
    EXPECT_NEAR(std::sqrt(square / double(r.image.rgb.size())), r.noise, 0.3 * r.noise);
}

// A furnace: where everything else has radiance L, clear glass and white mirrors have it too, and
// so the floor beneath them is lit by pi L as if they were not there.
TEST(LightTracing, LosslessThingsInAFurnaceCastNoShadow) {
    for (const bool isGlass : {true, false}) {
        SceneBuilder b;
        const glm::vec3 L(1, 2, 0.5f);
        b.addMaterial(lambert(glm::vec3(0), L));
        Material lossless = lambert(glm::vec3(1));
        lossless.roughness = 0;
        (isGlass ? lossless.transmission : lossless.metallic) = 1;
        lossless.thickness = 1;
        b.addMaterial(lossless);
        b.add(quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}));
        b.add(sphere(0.4f, 4, false, 1), glm::translate(glm::mat4(1), {0, 0.5f, 0}));
        b.scene.sky.radiance = L;
        ReferenceOptions o = optionsFor(View::Irradiance);
        o.camera.eye = {0, 0.5f, 3};
        o.camera.target = {0, 0, 0};
        o.camera.fovY = 0.04f; // the floor around the middle, which sees much of the ball
        o.samplesPerPixel = kSanitized ? 512 : 4096;
        const ReferenceResult r = renderLightTraced(TraceScene(b.build()), o);
        const double expected = glm::pi<double>() * 3.5 / 3;
        EXPECT_LT(r.noise, 0.5 * std::sqrt(4096. / o.samplesPerPixel));
        EXPECT_NEAR(meanOf(r.image) / expected, 1,
                    2 * r.noise / std::sqrt(double(o.width * o.height)))
            << (isGlass ? "glass" : "mirror");
    }
}

// Without diffuse reflections only what mirrors and glass lead to a surface is left. The mirror's
// image of a sun lights the wall by F E cos.
TEST(LightTracing, NoBouncesLeaveTheCausticsOfLights) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    Material metal = lambert(glm::vec3(0.8f));
    metal.metallic = 1;
    metal.roughness = 0;
    b.addMaterial(metal);
    b.add(quad({0, 0, 2}, {0, 0, -4}, {0, 4, 0}));    // a wall that faces +x
    b.add(quad({0, 0, 2}, {4, 0, 0}, {0, 0, -4}, 1)); // a floor of metal
    Light light = lamp(LightKind::Directional);
    light.direction = glm::normalize(glm::vec3(-1, -1, 0));
    light.color = glm::vec3(1);
    b.scene.lights = {light};
    const TraceScene trace(b.build());
    ReferenceOptions o = optionsFor(View::Irradiance);
    o.camera.eye = {3, 1, 0};
    o.camera.target = {0, 1, 0};
    o.camera.fovY = 0.3f;
    o.maxBounces = 0;
    o.width = o.height = 8;
    o.samplesPerPixel = 4096;
    EXPECT_EQ(meanOf(renderReference(trace, o).image), 0);
    const float cosine = std::sqrt(0.5f), away = std::pow(1 - cosine, 5.f);
    const double expected = double((0.8f + 0.2f * away) * 4 * cosine);
    EXPECT_NEAR(meanOf(renderLightTraced(trace, o).image) / expected, 1, 0.02);
}

// Emission, direct light and gloss as paths find them, and what photons bring.
TEST(LightTracing, AgreesWithPathsInAWholePicture) {
    SceneBuilder b = room();
    b.scene.materials[0].emission = {0.1f, 0.2f, 0.3f};
    b.scene.lights = {lamp(LightKind::Spot)};
    expectAgreement(b, optionsFor(View::Lit), "lit");
}

TEST(LightTracing, ThreadsChangeNoByteAndAnotherSeedAll) {
    SceneBuilder b = room();
    b.scene.lights = {lamp(LightKind::Point), lamp(LightKind::Directional)};
    const TraceScene trace(b.build());
    ReferenceOptions o = optionsFor(View::Irradiance);
    o.samplesPerPixel = 16;
    const auto render = [&](int threads) {
        const ThreadLimit limit(threads);
        return renderLightTraced(trace, o).image;
    };
    const ImageF one = render(1);
    EXPECT_EQ(one, render(2));
    o.seed = 2;
    EXPECT_NE(one, render(2));
}

TEST(LightTracing, DarknessIsExactAndCancellingGivesWhatThereIs) {
    SceneBuilder dark = room();
    const TraceScene trace(dark.build());
    const ReferenceResult r = renderLightTraced(trace, optionsFor(View::Irradiance));
    EXPECT_EQ(meanOf(r.image), 0);
    EXPECT_EQ(r.noise, 0);
    EXPECT_EQ(r.rays, 0u);
    SceneBuilder lit = room();
    lit.scene.lights = {lamp(LightKind::Point)};
    const std::atomic<bool> cancel = true;
    Progress progress;
    progress.cancel = &cancel;
    const ReferenceResult none =
        renderLightTraced(TraceScene(lit.build()), optionsFor(View::Irradiance), progress);
    EXPECT_EQ(none.samplesPerPixel, 0u);
    EXPECT_EQ(meanOf(none.image), 0);
    EXPECT_TRUE(std::isinf(none.noise));
}

TEST(LightTracing, MoreSamplesHaveLessNoise) {
    SceneBuilder b = room();
    b.scene.lights = {lamp(LightKind::Spot)};
    const TraceScene trace(b.build());
    ReferenceOptions o = optionsFor(View::Irradiance);
    o.samplesPerPixel = 16;
    const double few = renderLightTraced(trace, o).noise;
    o.samplesPerPixel = 256;
    EXPECT_NEAR(renderLightTraced(trace, o).noise / few, 0.25, 0.08);
}

} // namespace
} // namespace limn::light_tracing_test
