// SPDX-License-Identifier: MIT
#include "engine/scene/scene.h"

#include "engine/scene/surface/dielectric.h"

#include <cmath>

#include <gtest/gtest.h>

namespace limn::surface_material_test {
namespace {

/// A row of grey texels with alpha 255.
Assets rowOf(std::vector<std::uint8_t> greys) {
    Assets assets;
    Image image{"row", std::uint32_t(greys.size()), 1, {}};
    for (const std::uint8_t g : greys)
        image.rgba.insert(image.rgba.end(), {g, g, g, 255});
    assets.images.push_back(std::move(image));
    return assets;
}

TextureRef texture(Wrap wrap, bool nearest) {
    TextureRef t;
    t.image = 0;
    t.wrapU = t.wrapV = wrap;
    t.nearest = nearest;
    return t;
}

float at(const Assets& assets, const TextureRef& t, float u) {
    return sampleTexture(assets, t, {u, 0.5f}, false).x * 255;
}

TEST(SampleTexture, TexelCentresGiveTheTexels) {
    const Assets row = rowOf({10, 20, 40, 80});
    for (const bool nearest : {true, false})
        for (int i = 0; i < 4; ++i)
            EXPECT_NEAR(at(row, texture(Wrap::Repeat, nearest), (float(i) + 0.5f) / 4), 10 << i,
                        1e-4);
}

TEST(SampleTexture, BilinearIsLinearBetweenCentres) {
    const Assets row = rowOf({0, 100});
    EXPECT_NEAR(at(row, texture(Wrap::Clamp, false), 0.5f), 50, 1e-4);
    EXPECT_NEAR(at(row, texture(Wrap::Clamp, false), 0.375f), 25, 1e-4);
}

TEST(SampleTexture, WrapModesContinueTheTexture) {
    const Assets row = rowOf({10, 20, 40, 80});
    // Texel number i lies at (i + 0.5) / 4.
    const auto texel = [&](Wrap wrap, int i) {
        return at(row, texture(wrap, true), (float(i) + 0.5f) / 4);
    };
    EXPECT_NEAR(texel(Wrap::Repeat, -1), 80, 1e-4);
    EXPECT_NEAR(texel(Wrap::Repeat, 5), 20, 1e-4);
    EXPECT_NEAR(texel(Wrap::Clamp, -7), 10, 1e-4);
    EXPECT_NEAR(texel(Wrap::Clamp, 9), 80, 1e-4);
    EXPECT_NEAR(texel(Wrap::Mirror, -1), 10, 1e-4);
    EXPECT_NEAR(texel(Wrap::Mirror, 4), 80, 1e-4);
    EXPECT_NEAR(texel(Wrap::Mirror, 8), 10, 1e-4);
    // Halfway over the border the bilinear neighbour is the wrapped one.
    EXPECT_NEAR(at(row, texture(Wrap::Repeat, false), 0), 45, 1e-4);
    EXPECT_NEAR(at(row, texture(Wrap::Clamp, false), 0), 10, 1e-4);
    EXPECT_NEAR(at(row, texture(Wrap::Mirror, false), 1), 80, 1e-4);
}

TEST(SampleTexture, SrgbIsDecodedBeforeItIsFiltered) {
    const Assets row = rowOf({0, 255, 188, 10});
    const TextureRef t = texture(Wrap::Clamp, false);
    EXPECT_NEAR(sampleTexture(row, t, {0.625f, 0.5f}, true).x, 0.502886,
                1e-5); // ((188/255 + .055) / 1.055)^2.4
    EXPECT_NEAR(sampleTexture(row, t, {0.875f, 0.5f}, true).x, 10 / 255.0 / 12.92, 1e-7);
    EXPECT_NEAR(sampleTexture(row, t, {0.25f, 0.5f}, true).x, 0.5, 1e-5);
    EXPECT_EQ(sampleTexture(row, t, {0.25f, 0.5f}, true).w, 1);
}

TEST(SampleTexture, FarCoordinatesAndMissingImagesAreDefined) {
    const Assets row = rowOf({10, 20});
    for (const float u : {1e30f, -1e30f, 3e38f})
        EXPECT_TRUE(std::isfinite(at(row, texture(Wrap::Repeat, false), u)));
    EXPECT_EQ(sampleTexture(row, TextureRef{}, {0, 0}, true), glm::vec4(1));
    TextureRef gone = texture(Wrap::Repeat, false);
    gone.image = 5;
    EXPECT_EQ(sampleTexture(row, gone, {0, 0}, true), glm::vec4(1));
}

TEST(SampleTexture, TheTransformIsTheExtensionsExample) {
    // KHR_texture_transform's example: offset (0, 1), rotation a quarter, scale one half shows only
    // the lower left quadrant. 2 x 2 texels, row 0 on top; the lower left is the third.
    Assets assets;
    assets.images.push_back(
        {"quad", 2, 2, {10, 0, 0, 255, 20, 0, 0, 255, 30, 0, 0, 255, 40, 0, 0, 255}});
    TextureRef t = texture(Wrap::Repeat, true);
    t.offset = {0, 1};
    t.scale = {0.5f, 0.5f};
    t.rotation = glm::half_pi<float>();
    for (const float u : {0.1f, 0.5f, 0.9f})
        for (const float v : {0.1f, 0.5f, 0.9f})
            EXPECT_NEAR(sampleTexture(assets, t, {u, v}, false).x * 255, 30, 1e-4) << u << " " << v;
}

/// One triangle with corner colours, a two-texel texture along u, and `material`.
Scene triangleOf(const Material& material) {
    auto assets = std::make_shared<Assets>(rowOf({0, 255}));
    assets->images[0].rgba[3] = 51; // the black texel has alpha 0.2
    Mesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.normals.assign(3, {0, 0, 1});
    mesh.uv0 = {{0.25f, 0.5f}, {0.75f, 0.5f}, {0.25f, 0.5f}};
    mesh.uv1 = {{0.75f, 0.5f}, {0.75f, 0.5f}, {0.75f, 0.5f}};
    mesh.indices = {0, 1, 2};
    assets->meshes.push_back(mesh);
    Document document;
    addObject(document, material);
    Node node;
    node.meshes = {0};
    addObject(document, node);
    return flatten(document, assets);
}

TEST(SurfaceMaterial, AlbedoIsBaseColorWithoutItsMetalAndBelowOne) {
    Material m;
    m.baseColor = {1, 0.5f, 0.2f, 1};
    Scene scene = triangleOf(m);
    EXPECT_EQ(surfaceMaterial(scene, scene.instances[0], 0, 0.2f, 0.2f).albedo,
              glm::vec3(0.99f, 0.5f, 0.2f));
    scene.materials[0].metallic = 0.5f;
    EXPECT_EQ(surfaceMaterial(scene, scene.instances[0], 0, 0.2f, 0.2f).albedo,
              glm::vec3(0.5f, 0.25f, 0.1f));
}

TEST(SurfaceMaterial, TexturesAreReadAtTheBarycentricPoint) {
    Material m;
    m.baseColorTexture = texture(Wrap::Clamp, false);
    const Scene scene = triangleOf(m);
    const auto albedo = [&](float u, float v) {
        return surfaceMaterial(scene, scene.instances[0], 0, u, v).albedo.x;
    };
    EXPECT_NEAR(albedo(0, 0), 0, 1e-6);
    EXPECT_NEAR(albedo(1, 0), 0.99f, 1e-6);
    EXPECT_NEAR(albedo(0.5f, 0), 0.5f, 1e-6);
    EXPECT_NEAR(albedo(0, 1), 0, 1e-6);
    Material second = m;
    second.baseColorTexture.texCoord = 1;
    const Scene other = triangleOf(second);
    EXPECT_NEAR(surfaceMaterial(other, other.instances[0], 0, 0, 0).albedo.x, 0.99f, 1e-6);
}

TEST(SurfaceMaterial, EmissionIsFactorTimesTextureAndMayExceedOne) {
    Material m;
    m.emission = {40, 20, 0};
    m.emissiveTexture = texture(Wrap::Clamp, false);
    const Scene scene = triangleOf(m);
    EXPECT_EQ(surfaceMaterial(scene, scene.instances[0], 0, 1, 0).emission, glm::vec3(40, 20, 0));
    EXPECT_NEAR(surfaceMaterial(scene, scene.instances[0], 0, 0.5f, 0).emission.x, 20, 1e-4);
}

TEST(SurfaceMaterial, MaskAndBlendAreHolesBelowTheirCutoff) {
    Material m;
    m.baseColorTexture = texture(Wrap::Clamp, false);
    const auto alpha = [&](AlphaMode mode, float cutoff, float factor, float u) {
        m.alphaMode = mode;
        m.alphaCutoff = cutoff;
        m.baseColor.w = factor;
        const Scene scene = triangleOf(m);
        const float full = surfaceMaterial(scene, scene.instances[0], 0, u, 0).alpha;
        EXPECT_EQ(full, surfaceAlpha(scene, scene.instances[0], 0, u, 0));
        return full;
    };
    // Alpha runs from 0.2 at u = 0 to 1 at u = 1.
    EXPECT_EQ(alpha(AlphaMode::Opaque, 0.5f, 0, 0), 1);
    EXPECT_EQ(alpha(AlphaMode::Mask, 0.5f, 1, 0), 0);
    EXPECT_EQ(alpha(AlphaMode::Mask, 0.15f, 1, 0), 1);
    EXPECT_EQ(alpha(AlphaMode::Mask, 0.15f, 0.5f, 0), 0);
    EXPECT_EQ(alpha(AlphaMode::Mask, 0.5f, 1, 1), 1);
    EXPECT_EQ(alpha(AlphaMode::Blend, 0, 1, 0.3f), 0); // 0.44
    EXPECT_EQ(alpha(AlphaMode::Blend, 1, 1, 0.5f), 1); // 0.6
}

TEST(SurfaceMaterial, VertexColorsMultiplyTheBaseColor) {
    Material m;
    m.baseColor = {0.5f, 0.5f, 0.5f, 1};
    Scene scene = triangleOf(m);
    auto assets = std::make_shared<Assets>(*scene.assets);
    assets->meshes[0].colors = {{1, 0, 0, 1}, {0, 1, 0, 1}, {0, 0, 1, 1}};
    scene.assets = assets;
    const glm::vec3 albedo = surfaceMaterial(scene, scene.instances[0], 0, 0.25f, 0.5f).albedo;
    EXPECT_NEAR(albedo.x, 0.125f, 1e-6);
    EXPECT_NEAR(albedo.y, 0.125f, 1e-6);
    EXPECT_NEAR(albedo.z, 0.25f, 1e-6);
}

TEST(SurfaceMaterial, TransmissionIsTakenFromTheDiffuseShare) {
    Material m;
    m.baseColor = {0.8f, 0.4f, 0.2f, 1};
    m.metallic = 0.5f;
    m.transmission = 0.75f;
    m.ior = 1.3f;
    const Scene scene = triangleOf(m);
    const Instance& instance = scene.instances[0];
    const glm::vec3 albedo = surfaceMaterial(scene, instance, 0, 0.2f, 0.3f).albedo;
    EXPECT_NEAR(albedo.x, 0.1f, 1e-6f); // 0.8 * 0.5 * 0.25
    EXPECT_NEAR(albedo.y, 0.05f, 1e-6f);
    const Transmission t = surfaceTransmission(scene, instance, 0, 0.2f, 0.3f);
    EXPECT_NEAR(t.tint.x, 0.3f, 1e-6f); // 0.8 * 0.5 * 0.75
    EXPECT_NEAR(t.tint.z, 0.075f, 1e-6f);
    EXPECT_EQ(t.ior, 1.3f);
    EXPECT_TRUE(t.isThin);
}

TEST(SurfaceMaterial, OnlyAThickMaterialBendsLight) {
    Material m;
    m.transmission = 1;
    m.thickness = 0.01f;
    const Scene body = triangleOf(m);
    EXPECT_FALSE(surfaceTransmission(body, body.instances[0], 0, 0, 0).isThin);
    m.transmission = 0;
    const Scene opaque = triangleOf(m);
    EXPECT_FALSE(surfaceTransmission(opaque, opaque.instances[0], 0, 0, 0));
}

} // namespace
} // namespace limn::surface_material_test
