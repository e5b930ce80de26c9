// SPDX-License-Identifier: MIT
// What the viewport shows behind glass is what rays find there.
#include "tests/render/viewport_fixture.h"

#include "engine/picture/field_render.h"
#include "engine/scene/surface/dielectric.h"

#include <glm/geometric.hpp>

namespace limn::glass_test {
namespace {

Material glass(glm::vec3 tint, float transmission = 1) {
    Material m = simple::lambert(tint);
    m.transmission = transmission;
    m.roughness = 0;
    return m;
}

using Glass = ViewportTest;

TEST_F(Glass, ASheetTintsTheSkyFromBothSidesAtAnyAngle) {
    const glm::vec3 tint(0.5f, 0.8f, 1);
    options.width = options.height = 4;
    for (const float ior : {1.5f, 2.f})
        for (const glm::vec3 eye : {glm::vec3(0, 0, 3), glm::vec3(0, 0, -3), glm::vec3(4, 0, 2)}) {
            simple::SceneBuilder b;
            b.addMaterial(glass(tint));
            b.scene.materials[0].ior = ior;
            b.add(simple::quad({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}));
            b.scene.sky.radiance = glm::vec3(1);
            options.camera = {.eye = eye, .target = glm::vec3(0), .fovY = 1e-3f};
            const float cosine = std::abs(glm::normalize(eye).z);
            const glm::vec3 expected = tint * (1 - fresnelDielectric(cosine, ior));
            for (const glm::vec3 p : draw(b.build(), View::Lit).rgb)
                expectNear(p, expected, 2e-3f);
        }
}

/// A pane that also scatters, before a lit plane and under the sky.
TEST_F(Glass, APaneShowsWhatTheRaysOfPicturesFind) {
    simple::SceneBuilder b = plane();
    b.addMaterial(glass({0.9f, 0.6f, 0.3f}, 0.7f));
    b.add(simple::quad({-1, 1, 1}, {2, 0, 0}, {0, 0.5f, -2}, 1));
    Light sun;
    sun.kind = LightKind::Directional;
    sun.strength = 3;
    sun.direction = glm::normalize(glm::vec3(0.7f, -1, -0.5f));
    b.scene.lights = {sun};
    b.scene.sky.radiance = glm::vec3(0.2f);
    const Scene scene = b.build();
    options.camera = {.eye = {0.3f, 4, 2}, .target = {0, 1, 0}, .fovY = 0.5f};
    options.width = options.height = 32;
    const ImageF traced = renderField(TraceScene(scene), {}, {},
                                      {.view = View::Lit,
                                       .camera = options.camera,
                                       .width = 32,
                                       .height = 32,
                                       .samplesPerPixel = 1});
    const ImageF drawn = draw(scene, View::Lit);
    int seen = 0;
    for (std::uint32_t y = 8; y < 24; ++y)
        for (std::uint32_t x = 8; x < 24; ++x) {
            expectNear(pixel(drawn, x, y), pixel(traced, x, y), 0.01f);
            seen += pixel(drawn, x, y).r > 0.05f;
        }
    EXPECT_EQ(seen, 256);
    for (int sample = 0; sample < 3; ++sample)
        viewport->refine();
    const ImageF refined = viewport->readLinear();
    for (const std::uint32_t i : {10U, 16U, 20U})
        expectNear(pixel(refined, i, i), pixel(traced, i, i), 0.02f);
}

TEST_F(Glass, ViewsWithoutReflectionsShowItsOwnSurface) {
    simple::SceneBuilder b = plane();
    b.addMaterial(glass({0.9f, 0.6f, 0.3f}, 0.5f));
    b.add(simple::quad({-2, 1, 2}, {4, 0, 0}, {0, 0, -4}, 1));
    for (const glm::vec3 p : draw(b.build(), View::Albedo).rgb)
        expectNear(p, {0.45f, 0.3f, 0.15f}, 0.01f);
}

} // namespace
} // namespace limn::glass_test
