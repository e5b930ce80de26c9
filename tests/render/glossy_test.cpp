// SPDX-License-Identifier: MIT
#include "engine/math/lobe.h"
#include "engine/picture/field_render.h"
#include "engine/scene/surface/receiver_bands.h"
#include "engine/scene/surface/reflection_lobe.h"
#include "tests/core/sweep.h"
#include "tests/render/viewport_fixture.h"

namespace limn::glossy_test {
namespace {

class ViewportGlossy : public ViewportTest {
protected:
    /// The same coefficients everywhere, of a light that no lobe sees below 0.
    static IndirectField field(std::uint32_t bands) {
        IndirectField f;
        f.bands = bands;
        f.gridSize = glm::uvec3(2);
        f.gridBounds = {glm::vec3(-10), glm::vec3(10)};
        for (std::uint32_t i = 0; i < f.coefficients(); ++i)
            f.grid.insert(f.grid.end(), 8, glm::vec4(coefficient(i), 0));
        f.version = bands;
        return f;
    }
    static glm::vec3 coefficient(std::uint32_t i) {
        const auto k = float(i);
        return i == 0 ? glm::vec3(20, 15, 18)
                      : glm::vec3(std::sin(k), std::cos(2 * k), std::sin(3 * k + 1));
    }

    /// What indirect.frag is to make of the plane y = 0 in a pixel.
    glm::vec3 expected(const Material& m, std::uint32_t bands, glm::vec3 p) const {
        std::vector<glm::vec3> c;
        for (std::uint32_t i = 0; i < bands * bands; ++i)
            c.push_back(coefficient(i));
        const int read = std::min(receiverBands(Assets(), m, kMaxBands), int(bands));
        const float root = (m.ior - 1) / (m.ior + 1);
        const Gloss gloss{glm::mix(glm::vec3(root * root), glm::vec3(m.baseColor), m.metallic),
                          m.roughness};
        const glm::vec3 toEye = glm::normalize(options.camera.eye - p);
        const ReflectionLobe lobe = reflectionLobe(m.roughness, toEye.y);
        const glm::vec3 reflected =
            shLobe(read, c.data(), lobeAxis(lobe, {0, 1, 0}, {-toEye.x, toEye.y, -toEye.z}),
                   windowedFactors(lobe.factors, read));
        const glm::vec3 albedo = glm::vec3(m.baseColor) * ((1 - m.metallic) * (1 - m.transmission));
        return albedo / kPi * shIrradiance(std::min(int(bands), 3), c.data(), {0, 1, 0}) +
               specularAlbedo(gloss, toEye.y) * reflected;
    }
};

TEST_F(ViewportGlossy, ReflectsBouncedLightAsTheCpuDoesInEveryNumberOfBands) {
    options.camera.eye = {1, 3, 4};
    for (const float metallic : {1.f, 0.5f, 0.f})
        for (const float roughness : {0.1f, 0.5f, 0.731f, 1.f})
            for (std::uint32_t bands = 2; bands <= 8; ++bands) {
                if (kSanitized && (bands + std::uint32_t(10 * roughness)) % 3 != 0)
                    continue;
                simple::SceneBuilder b = plane({0.9f, 0.6f, 0.3f});
                Material& m = b.scene.materials[0];
                m.metallic = metallic;
                m.roughness = roughness;
                viewport->setIndirect(field(bands));
                const ImageF image = draw(b.build(), View::Lit);
                for (const std::uint32_t x : {2U, 11U, 30U})
                    for (const std::uint32_t y : {5U, 16U, 29U})
                        expectNear(pixel(image, x, y),
                                   expected(b.scene.materials[0], bands, planePoint(options, x, y)),
                                   2e-4f); // single precision interpolation of the position
            }
}

// Numbers that the surface images hold exactly: 0.4 = 102 / 255, and F0 = (511 / 1022)^2.
TEST_F(ViewportGlossy, GlassKeepsItsDiffuseShareAndReflectsByItsIndex) {
    options.camera.eye = {1, 3, 4};
    for (const float metallic : {1.f, 0.5f, 0.f}) {
        simple::SceneBuilder b = plane({0.9f, 0.6f, 0.3f});
        Material& m = b.scene.materials[0];
        m.metallic = metallic;
        m.roughness = 0.5f;
        m.transmission = 0.4f;
        m.ior = 3;
        viewport->setIndirect(field(4));
        const ImageF image = draw(b.build(), View::Lit), albedo = draw(b.build(), View::Albedo);
        expectNear(pixel(image, 11, 16),
                   expected(b.scene.materials[0], 4, planePoint(options, 11, 16)), 2e-4f);
        expectNear(pixel(albedo, 11, 16), glm::vec3(0.9f, 0.6f, 0.3f) * (0.6f * (1 - metallic)),
                   1e-3f);
    }
}

// Whoever gathers diffuse light itself gets the rest of the picture.
TEST_F(ViewportGlossy, DiffuseLightCanBeLeftOut) {
    simple::SceneBuilder b = plane({0.9f, 0.6f, 0.3f});
    b.scene.materials[0].metallic = 0.5f;
    b.scene.materials[0].roughness = 0.3f;
    b.scene.materials[0].emission = {1, 2, 3};
    viewport->setIndirect(field(4));
    const Scene scene = b.build();
    const ImageF whole = draw(scene, View::Lit), diffuse = draw(scene, View::Indirect);
    options.diffuse = false;
    const ImageF rest = draw(scene, View::Lit);
    for (std::size_t i = 0; i < whole.rgb.size(); i += 37)
        expectNear(rest.rgb[i] + diffuse.rgb[i], whole.rgb[i], 1e-5f);
    EXPECT_GT(diffuse.rgb.back().x, 0.1f);
    EXPECT_GT(rest.rgb.back().x, 1.1f); // more than is emitted
    for (const View view : {View::Indirect, View::Irradiance})
        for (const glm::vec3 none : draw(scene, view).rgb)
            EXPECT_EQ(none, glm::vec3(0));
}

TEST_F(ViewportGlossy, ReadsMoreBandsAsSoonAsAMaterialIsPolished) {
    simple::SceneBuilder b = plane({0.9f, 0.6f, 0.3f});
    b.scene.materials[0].metallic = 1;
    viewport->setIndirect(field(8));
    for (const float roughness : {1.f, 0.3f, 1.f}) {
        b.scene.materials[0].roughness = roughness;
        const ImageF image = draw(b.build(), View::Lit);
        expectNear(pixel(image, 7, 9), expected(b.scene.materials[0], 8, planePoint(options, 7, 9)),
                   2e-4f);
    }
}

TEST_F(ViewportGlossy, GreyBandsAreReadFromFewerLayersAlike) {
    options.camera.eye = {1, 3, 4};
    simple::SceneBuilder b = plane({0.9f, 0.6f, 0.3f});
    b.scene.materials[0].metallic = 1;
    b.scene.materials[0].roughness = 0.2f;
    for (const std::uint32_t bands : {4U, 8U})
        for (const std::uint32_t chroma : {1U, 2U, 3U, 4U}) {
            IndirectField f = field(bands);
            for (std::size_t i = std::size_t(chroma * chroma) * 8; i < f.grid.size(); ++i)
                f.grid[i] = glm::vec4(glm::vec3(f.grid[i].x), 0);
            f.version = 10 * bands + chroma;
            viewport->setIndirect(f);
            const ImageF coloured = draw(b.build(), View::Lit);
            f.chromaBands = chroma;
            viewport->setIndirect(f);
            const ImageF compressed = draw(b.build(), View::Lit);
            for (std::size_t i = 0; i < coloured.rgb.size(); i += 37)
                expectNear(compressed.rgb[i], coloured.rgb[i], 1e-5f);
        }
}

// Light from all above a surface, in any number of bands: none of a lobe is lost below the horizon.
TEST_F(ViewportGlossy, AWhiteHemisphereIsReflectedWhole) {
    constexpr float kHalf[] = {0.5f, 0.75f, 0, -7 / 16.f, 0, 11 / 32.f, 0, -75 / 256.f};
    options.camera.eye = {1, 1.5f, 4};
    layout = std::make_shared<LightmapLayout>();
    layout->width = layout->height = 1;
    layout->instances = {{std::vector<glm::vec2>(4, {0.5f, 0.5f})}};
    layout->meshes = {{{0, 1, 2, 3}, {0, 1, 2, 0, 2, 3}, {0, 0}, {}, {{1, 1}}}};
    for (const float roughness : {0.1f, 1.f})
        for (const std::uint32_t bands : {2U, 3U, 6U, 8U}) {
            simple::SceneBuilder b = plane({0.9f, 0.6f, 0.3f});
            Material& m = b.scene.materials[0];
            m.metallic = 1;
            m.roughness = roughness;
            IndirectField f;
            f.bands = bands;
            f.version = bands;
            f.lightmapWidth = f.lightmapHeight = 1;
            float y[kMaxCoefficients];
            shBasis(int(bands), {0, 1, 0}, y);
            for (int l = 0, i = 0; l < int(bands); ++l)
                for (; i < (l + 1) * (l + 1); ++i)
                    f.lightmap.emplace_back(glm::vec3(4 * kPi / float(2 * l + 1) * kHalf[l] * y[i]),
                                            0);
            viewport->setIndirect(f);
            const ImageF image = draw(b.build(), View::Lit);
            FieldRenderOptions traced;
            traced.camera = options.camera;
            traced.width = traced.height = 32;
            const Scene scene = b.build();
            const ImageF byCpu = renderField(TraceScene(scene), f, *layout, traced);
            for (const std::uint32_t at : {5U, 16U, 29U}) {
                const glm::vec3 toEye =
                    glm::normalize(options.camera.eye - planePoint(options, at, at));
                const glm::vec3 expected = specularAlbedo({{0.9f, 0.6f, 0.3f}, roughness}, toEye.y);
                expectNear(pixel(image, at, at), expected, 2e-4f, "viewport");
                expectNear(pixel(byCpu, at, at), expected, 0.02f, "CPU, elsewhere in the pixel");
            }
        }
}

} // namespace
} // namespace limn::glossy_test
