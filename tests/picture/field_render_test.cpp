// SPDX-License-Identifier: MIT
#include "engine/picture/field_render.h"

#include "engine/core/parallel.h"
#include "engine/measure/compare.h"
#include "engine/reference/reference.h"
#include "engine/scene/surface/dielectric.h"
#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/relight/relight.h"
#include "tests/field/second_grid.h"
#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <memory>

#include <glm/gtc/constants.hpp>

namespace limn::field_render_test {

using namespace simple;

namespace {

/// Every cell sees radiance 1, 2, 3 from everywhere: E = pi (1, 2, 3).
IndirectField uniformGrid() {
    IndirectField field;
    field.gridSize = {2, 2, 2};
    field.gridBounds = {glm::vec3(-4), glm::vec3(4)};
    field.grid.assign(9 * 8, glm::vec4(0));
    const float c0 = 2 * std::sqrt(glm::pi<float>());
    for (std::size_t i = 0; i < 8; ++i)
        field.grid[i] = c0 * glm::vec4(1, 2, 3, 0);
    return field;
}

Scene floorAndBlock() {
    SceneBuilder b;
    b.addMaterial(lambert({0.2f, 0.5f, 0.8f}, {0.3f, 0.2f, 0.1f}));
    b.addMaterial(lambert(glm::vec3(0.6f)));
    b.add(quad({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}));
    b.add(box({-0.5f, 0, -1}, {0.5f, 1, 0}, false, 1));
    Light light;
    light.position = {1, 3, 1};
    light.strength = 20;
    b.scene.lights = {light};
    b.scene.sky.radiance = {0.1f, 0.2f, 0.3f};
    return b.build();
}

FieldRenderOptions optionsFor(View view) {
    FieldRenderOptions o;
    o.view = view;
    o.camera.eye = {2, 3, 4};
    o.camera.target = {0, 0, 0};
    o.width = 48;
    o.height = 32;
    o.samplesPerPixel = 16;
    return o;
}

ReferenceOptions referenceFor(const FieldRenderOptions& o, std::uint32_t spp) {
    ReferenceOptions r;
    r.view = o.view;
    r.camera = o.camera;
    r.width = o.width;
    r.height = o.height;
    r.samplesPerPixel = spp;
    return r;
}

double rmsDifference(const ImageF& a, const ImageF& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.rgb.size(); ++i)
        sum += double(glm::dot(a.rgb[i] - b.rgb[i], a.rgb[i] - b.rgb[i])) / 3;
    return std::sqrt(sum / double(a.rgb.size()));
}

} // namespace

TEST(FieldRender, DirectAndAlbedoAreThoseOfTheReference) {
    const TraceScene trace(floorAndBlock());
    for (View view : {View::Direct, View::Albedo}) {
        FieldRenderOptions options = optionsFor(view);
        options.samplesPerPixel = 256;
        const ImageF image = renderField(trace, uniformGrid(), {}, options);
        const ImageF reference = renderReference(trace, referenceFor(options, 256)).image;
        // Only the pixels on edges and shadow borders differ, by their sampling noise.
        EXPECT_LT(rmsDifference(image, reference), 0.01 * meanOf(reference));
    }
}

TEST(FieldRender, ViewsAddUp) {
    const TraceScene trace(floorAndBlock());
    const auto render = [&](View view) {
        return renderField(trace, uniformGrid(), {}, optionsFor(view)).rgb;
    };
    const auto lit = render(View::Lit), direct = render(View::Direct),
               indirect = render(View::Indirect), irradiance = render(View::Irradiance),
               albedo = render(View::Albedo), normals = render(View::Normals);
    int floor = 0, block = 0;
    for (std::size_t i = 0; i < lit.size(); ++i) {
        const bool onFloor = glm::length(albedo[i] - glm::vec3(0.2f, 0.5f, 0.8f)) < 1e-6f;
        const bool onBlock = glm::length(albedo[i] - 0.6f) < 1e-6f;
        if (!onFloor && !onBlock)
            continue;
        ++(onFloor ? floor : block);
        const glm::vec3 emission = onFloor ? glm::vec3(0.3f, 0.2f, 0.1f) : glm::vec3(0);
        EXPECT_LT(glm::length(irradiance[i] - glm::pi<float>() * glm::vec3(1, 2, 3)), 1e-4f);
        EXPECT_LT(glm::length(indirect[i] - albedo[i] * glm::vec3(1, 2, 3)), 1e-4f);
        // Reflection of a dielectric only adds, and less than a tenth of what arrives.
        for (int c = 0; c < 3; ++c) {
            const float glossy = lit[i][c] - direct[i][c] - indirect[i][c] - emission[c];
            EXPECT_GE(glossy, 0);
            EXPECT_LE(glossy, 0.1f * (direct[i][c] + indirect[i][c]) / albedo[i][c]);
        }
        if (onFloor) {
            EXPECT_LT(glm::length(normals[i] - glm::vec3(0.5f, 1, 0.5f)), 1e-5f);
        }
    }
    EXPECT_GT(floor, 300);
    EXPECT_GT(block, 20);
}

TEST(FieldRender, APartOfTheFieldIsDrawnAsItsGridIs) {
    const TraceScene trace(floorAndBlock());
    IndirectField part;
    part.parts = {std::make_shared<SecondGrid>(uniformGrid())};
    for (const View view : {View::Lit, View::Irradiance}) {
        const ImageF ofPart = renderField(trace, part, {}, optionsFor(view));
        const ImageF ofGrid = renderField(trace, uniformGrid(), {}, optionsFor(view));
        EXPECT_LT(rmsDifference(ofPart, ofGrid), 1e-6 * meanOf(ofGrid));
    }
}

TEST(FieldRender, WithoutAFieldThereIsNoIndirectLight) {
    const TraceScene trace(floorAndBlock());
    EXPECT_EQ(meanOf(renderField(trace, {}, {}, optionsFor(View::Irradiance))), 0);
    FieldRenderOptions up = optionsFor(View::Lit);
    up.camera.target = {2, 9, 4.01f};
    for (glm::vec3 p : renderField(trace, {}, {}, up).rgb)
        EXPECT_LT(glm::length(p - glm::vec3(0.1f, 0.2f, 0.3f)), 1e-6f);
}

TEST(FieldRender, ThreadsChangeNoByteAndCancellingGivesNothing) {
    const TraceScene trace(floorAndBlock());
    const auto render = [&](int threads) {
        const ThreadLimit limit(threads);
        return renderField(trace, uniformGrid(), {}, optionsFor(View::Lit));
    };
    EXPECT_EQ(render(1), render(2));
    const std::atomic<bool> cancel = true;
    Progress progress;
    progress.cancel = &cancel;
    EXPECT_TRUE(renderField(trace, uniformGrid(), {}, optionsFor(View::Lit), progress).rgb.empty());
}

/// A ball of clear glass, or a sheet of it, under an even sky of radiance 1.
Scene glassUnderTheSky(bool isBall, glm::vec3 tint) {
    SceneBuilder b;
    Material glass = lambert(tint);
    glass.transmission = 1;
    glass.roughness = 0;
    glass.thickness = isBall ? 1 : 0;
    b.addMaterial(glass);
    if (isBall)
        b.add(sphere(1, 4, false));
    else
        b.add(quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}));
    b.scene.sky.radiance = glm::vec3(1);
    return b.build();
}

FieldRenderOptions lookingAtTheMiddle(glm::vec3 eye) {
    FieldRenderOptions o = optionsFor(View::Lit);
    o.camera = {.eye = eye, .target = glm::vec3(0), .fovY = 1e-3f};
    o.width = o.height = 4;
    return o;
}

// What enters a body of clear glass leaves it again, so each ray of the eye finds the sky after all
// but the share that was mirrored on entry.
TEST(FieldRender, ABallOfGlassShowsAllOfAnEvenSkyThatItDoesNotMirror) {
    FieldRenderOptions options = lookingAtTheMiddle({0, 0, 5});
    for (const float x : {0.f, 0.5f, 0.8f}) {
        options.camera.eye = {x, 0, 5};
        options.camera.target = {x, 0, 0};
        const float transmitted = 1 - fresnelDielectric(std::sqrt(1 - x * x), 1.5f);
        const TraceScene trace(glassUnderTheSky(true, glm::vec3(1)));
        for (const glm::vec3 p : renderField(trace, {}, {}, options).rgb)
            EXPECT_NEAR(p.x, transmitted, 4e-3f) << x; // the ball is made of flat triangles
    }
}

TEST(FieldRender, ASheetOfGlassTintsWhatIsBehindIt) {
    const TraceScene trace(glassUnderTheSky(false, {0.5f, 0.8f, 1}));
    for (const float z : {3.f, -3.f})
        for (const glm::vec3 p : renderField(trace, {}, {}, lookingAtTheMiddle({0, 0, z})).rgb)
            EXPECT_LT(glm::length(p - 0.96f * glm::vec3(0.5f, 0.8f, 1)), 1e-5f);
    FieldRenderOptions irradiance = lookingAtTheMiddle({0, 0, 3});
    irradiance.view = View::Irradiance;
    EXPECT_EQ(meanOf(renderField(trace, {}, {}, irradiance)), 0) << "that of the sheet itself";
}

// Both look through the same glass, so they agree where the field holds the truth: a lit wall.
TEST(FieldRender, WhatIsBehindGlassIsThatOfTheReference) {
    SceneBuilder b;
    b.addMaterial(lambert({0.6f, 0.4f, 0.2f}));
    Material glass = lambert({0.5f, 1, 1});
    glass.transmission = 1;
    glass.roughness = 0;
    glass.thickness = 1;
    b.addMaterial(glass);
    b.add(quad({-3, -3, -2}, {6, 0, 0}, {0, 6, 0}));
    b.add(sphere(0.8f, 3, false, 1));
    Light spot; // behind the ball, which has no highlight of it
    spot.kind = LightKind::Spot;
    spot.position = {0.5f, 0.5f, -1};
    spot.direction = {0, 0, -1};
    spot.strength = 20;
    b.scene.lights = {spot};
    const TraceScene trace(b.build());
    FieldRenderOptions options = optionsFor(View::Lit);
    options.camera = {.eye = {0, 0, 4}, .target = glm::vec3(0), .fovY = 0.5f};
    options.samplesPerPixel = 64;
    ReferenceOptions reference = referenceFor(options, 64);
    reference.maxBounces = 0;
    const ImageF image = renderField(trace, {}, {}, options);
    const ReferenceResult truth = renderReference(trace, reference);
    EXPECT_GT(meanOf(truth.image), 0.05);
    EXPECT_LT(truth.noise, 0.1);
    EXPECT_LT(rmsDifference(image, truth.image), 2 * truth.noise * meanOf(truth.image));
    EXPECT_NEAR(meanOf(image) / meanOf(truth.image), 1, 0.01);
}

// The whole way: bake, relight, look up, against path tracing.
TEST(FieldRender, ABakedRoomLooksLikeItsPathTracedSelf) {
    SceneBuilder b;
    b.addMaterial(lambert({0.7f, 0.7f, 0.7f}));
    b.addMaterial(lambert({0.7f, 0.2f, 0.1f}));
    b.add(box(glm::vec3(-1), glm::vec3(1), true));
    b.add(quad({-0.99f, -1, 1}, {0, 0, -2}, {0, 2, 0}, 1));
    b.add(box({-0.3f, -1, -0.5f}, {0.2f, -0.2f, 0.1f}, false));
    Light light;
    light.position = {0.3f, 0.6f, 0.2f};
    light.strength = 2;
    b.scene.lights = {light};
    b.scene.bake.surfels = 2048;
    b.scene.bake.lightmapCaches = 1500;
    b.scene.bake.links = 192;
    b.scene.bake.rays = 256;
    b.scene.bake.grid = {2, 2, 2};
    const Scene scene = b.build();
    const TraceScene trace(scene);
    Result<Bake> baked = bake(trace);
    ASSERT_TRUE(baked) << baked.error().message;
    const auto shared = std::make_shared<const Bake>(std::move(*baked));
    Relighter relighter(shared);
    relighter.relight(scene, trace, 64);

    FieldRenderOptions options = optionsFor(View::Irradiance);
    options.camera.eye = {0.2f, 0, 0.95f};
    options.camera.target = {0, -0.2f, 0};
    options.camera.fovY = 1.2f;
    const ImageF image = renderField(trace, relighter.field(), shared->lightmap, options);
    const ReferenceResult reference = renderReference(trace, referenceFor(options, 256));
    // 256 links and rays per cache leave a few per cent of error, the reference 4 % of noise per
    // pixel; what they must share is the energy.
    EXPECT_LT(reference.noise, 0.05);
    EXPECT_NEAR(meanOf(image) / meanOf(reference.image), 1, 0.03);
    EXPECT_LT(rmsDifference(image, reference.image), 0.1 * meanOf(reference.image));
}

} // namespace limn::field_render_test
