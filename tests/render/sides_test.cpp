// SPDX-License-Identifier: MIT
// Which side of a surface and which alpha is seen: the viewport's picture is the one that rays
// make.
#include "tests/render/viewport_fixture.h"

#include "engine/picture/field_render.h"

#include <algorithm>

namespace limn::sides_test {
namespace {

/// A pane of 1.4 m, tilted a little, in the middle of place `k` of a row along x, 1 m above the
/// plane. Its front looks up, or down where `turned`.
Mesh pane(int k, bool turned, std::uint32_t material) {
    const glm::vec3 x(1.4f, 0.1f, 0), z(0, 0.1f, -1.4f);
    const glm::vec3 o(2.f * float(k) - 5.7f, 1, 0.7f);
    return turned ? simple::quad(o, z, x, material) : simple::quad(o, x, z, material);
}

/// An image of 2 x 2 texels of which those of alpha 0 are opposite.
Image checker() {
    Image image{.name = "checker", .width = 2, .height = 2, .rgba = {}};
    for (const std::uint8_t alpha : std::array<std::uint8_t, 4>{255, 0, 0, 255})
        image.rgba.insert(image.rgba.end(), {255, 255, 255, alpha});
    return image;
}

/// Panes over a plane, from left to right: Blend of alpha 0.3, Blend of 0.7, Mask, one-sided from
/// its front, one-sided from its back, double-sided from its back.
simple::SceneBuilder panes() {
    simple::SceneBuilder b = plane();
    Material m = simple::lambert({0.8f, 0.5f, 0.2f});
    b.addMaterial(m); // 1
    m.doubleSided = true;
    b.addMaterial(m); // 2
    m.doubleSided = false;
    m.alphaMode = AlphaMode::Blend;
    m.baseColor.a = 0.3f;
    b.addMaterial(m); // 3
    m.baseColor.a = 0.7f;
    b.addMaterial(m); // 4
    m.alphaMode = AlphaMode::Mask;
    m.baseColor.a = 1;
    m.baseColorTexture = {.image = 0, .nearest = true};
    b.addMaterial(m); // 5
    b.assets->images.push_back(checker());
    for (int k = 0; k < 3; ++k)
        b.add(pane(k, false, std::uint32_t(3 + k)));
    b.add(pane(3, false, 1));
    b.add(pane(4, true, 1));
    b.add(pane(5, true, 2));
    return b;
}

IndirectField unitGrid() {
    IndirectField field;
    field.gridSize = glm::uvec3(2);
    field.gridBounds = {glm::vec3(-10), glm::vec3(10)};
    field.grid.assign(8 * 9, glm::vec4(0));
    std::fill_n(field.grid.begin(), 8, glm::vec4(glm::vec3(2 * std::sqrt(kPi)), 0));
    field.version = 1;
    return field;
}

Light light(LightKind kind) {
    Light l;
    l.kind = kind;
    l.strength = kind == LightKind::Directional ? 3.f : 20.f;
    l.direction = glm::normalize(glm::vec3(0.2f, -1, -0.5f));
    l.position = kind == LightKind::Spot ? glm::vec3(-1, 5, 2) : glm::vec3(0.4f, 0.4f, 1.8f);
    l.outerAngle = 1;
    return l;
}

class Sides : public ViewportTest {
protected:
    /// Pixels whose colour is none of those that rays find within a pixel of it.
    int pixelsApart(const Scene& scene, View view) {
        constexpr std::uint32_t kFine = 4; // pixels of the traced picture in one of the viewport's
        const IndirectField field = unitGrid();
        viewport->setIndirect(field);
        const ImageF drawn = draw(scene, view);
        const ImageF traced = renderField(TraceScene(scene), field, {},
                                          {.view = view,
                                           .camera = options.camera,
                                           .width = kFine * options.width,
                                           .height = kFine * options.height,
                                           .samplesPerPixel = 1});
        int apart = 0;
        for (std::uint32_t y = 1; y + 1 < options.height; ++y)
            for (std::uint32_t x = 1; x + 1 < options.width; ++x) {
                glm::vec3 lower(1e9f), upper(-1e9f);
                for (std::uint32_t k = 0; k < 9 * kFine * kFine; ++k) {
                    const glm::vec3 p = pixel(traced, kFine * (x - 1) + k % (3 * kFine),
                                              kFine * (y - 1) + k / (3 * kFine));
                    lower = glm::min(lower, p);
                    upper = glm::max(upper, p);
                }
                const glm::vec3 p = pixel(drawn, x, y), slack = 0.02f * upper + 1e-4f;
                apart += glm::any(glm::lessThan(p, lower - slack)) ||
                         glm::any(glm::greaterThan(p, upper + slack));
            }
        return apart;
    }
};

TEST_F(Sides, AndAlphaAreThoseThatRaysSeeFromAboveAndFromBelow) {
    simple::SceneBuilder b = panes();
    options.width = 192;
    options.height = 96;
    for (const glm::vec3 eye : {glm::vec3(0, 5, 6), glm::vec3(0.5f, 0.15f, 5)}) {
        options.camera = {.eye = eye, .target = {0, 1, 0}, .fovY = 0.9f};
        for (const View view : {View::Albedo, View::Irradiance, View::Indirect})
            EXPECT_EQ(pixelsApart(b.build(), view), 0) << kViewNames[std::size_t(view)];
        for (const LightKind kind : {LightKind::Directional, LightKind::Point, LightKind::Spot}) {
            b.scene.lights = {light(kind)};
            EXPECT_EQ(pixelsApart(b.build(), View::Direct), 0) << int(kind);
        }
    }
}

TEST_F(Sides, ARoomSeenFromOutsideIsBlackWhereItsWallsTurnTheirBacks) {
    simple::SceneBuilder b = plane();
    b.add(simple::box({-2, 0.1f, -1}, {0, 2, 1}, true));
    b.add(simple::box({0.5f, 0.1f, -1}, {2, 1, 1}, false));
    b.scene.lights = {light(LightKind::Directional)};
    options.camera = {.eye = {1, 4, 6}, .target = {0, 1, 0}, .fovY = 0.8f};
    options.width = 96;
    options.height = 64;
    for (const View view : {View::Albedo, View::Direct})
        EXPECT_EQ(pixelsApart(b.build(), view), 0) << kViewNames[std::size_t(view)];
}

TEST_F(Sides, AnObjectMirroredByItsTransformShowsItsFront) {
    simple::SceneBuilder b = plane();
    b.addMaterial(simple::lambert(glm::vec3(0.7f)));
    const std::uint32_t mesh = b.addMesh(simple::quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2}, 1));
    for (const float x : {-2.f, 2.f})
        b.addInstance(mesh, glm::translate(glm::mat4(1), glm::vec3(x, 1, 0)) *
                                glm::scale(glm::mat4(1), glm::vec3(x / 2, 1, 1)));
    options.width = 96;
    options.height = 64;
    options.camera.eye = {0, 7, 1};
    EXPECT_EQ(pixelsApart(b.build(), View::Albedo), 0);
}

TEST_F(Sides, AnAlphaThatCrossesItsCutoffChangesTheShadow) {
    simple::SceneBuilder b = panes();
    b.scene.lights = {light(LightKind::Directional)};
    options.width = 96;
    options.height = 64;
    options.camera = {.eye = {0, 5, 6}, .target = {0, 1, 0}, .fovY = 0.9f};
    Scene scene = b.build();
    EXPECT_EQ(pixelsApart(scene, View::Direct), 0);
    scene.materials[3].baseColor.a = 0.5f;
    EXPECT_EQ(pixelsApart(scene, View::Direct), 0) << "Blend";
    scene.materials[5].alphaCutoff = 0;
    EXPECT_EQ(pixelsApart(scene, View::Direct), 0) << "Mask";
    scene.materials[3].alphaMode = AlphaMode::Opaque;
    scene.materials[3].baseColor.a = 0.2f;
    EXPECT_EQ(pixelsApart(scene, View::Direct), 0) << "Opaque";
}

TEST_F(Sides, ATextureThatIsMostlyHolesCoversAsMuchFromAfarAsRaysSay) {
    constexpr std::uint32_t kSize = 64, kStep = 4;
    simple::SceneBuilder b = plane(glm::vec3(0));
    b.addMaterial(simple::lambert(glm::vec3(0.8f)));
    Image dots{.name = "dots", .width = kSize, .height = kSize, .rgba = {}};
    for (std::uint32_t i = 0; i < kSize * kSize; ++i) {
        const bool solid = i % kStep < 2 && i / kSize % kStep < 2; // a quarter of them
        dots.rgba.insert(dots.rgba.end(), {255, 255, 255, std::uint8_t(solid ? 255 : 0)});
    }
    b.assets->images.push_back(dots);
    Material& m = b.scene.materials[1];
    m.alphaMode = AlphaMode::Mask;
    m.baseColorTexture = {.image = 0, .scale = {8, 8}};
    b.add(simple::quad({-2, 1, 2}, {4, 0, 0}, {0, 0, -4}, 1));
    options.width = options.height = 128; // a pixel is 4 texels wide
    const Scene scene = b.build();
    double drawn = 0, traced = 0;
    for (const glm::vec3 p : draw(scene, View::Albedo).rgb)
        drawn += double(p.r);
    const FieldRenderOptions cpu{
        .view = View::Albedo, .camera = options.camera, .width = 128, .height = 128};
    for (const glm::vec3 p : renderField(TraceScene(scene), {}, {}, cpu).rgb)
        traced += double(p.r);
    // One sample in a pixel: 16384 samples of variance c (1 - c) miss the covered share c = 0.2 by
    // 1.6 % of it where they are independent.
    EXPECT_GT(traced / 0.8 / 16384, 0.1);
    EXPECT_NEAR(drawn / traced, 1, 0.05);
}

} // namespace
} // namespace limn::sides_test
