// SPDX-License-Identifier: MIT
#include "engine/math/lobe.h"
#include "engine/scene/receiver_bands.h"
#include "engine/scene/specular.h"
#include "tests/render/viewport_fixture.h"

namespace limn {
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
        const Gloss gloss{glm::mix(glm::vec3(0.04f), glm::vec3(m.baseColor), m.metallic),
                          m.roughness};
        const glm::vec3 toEye = glm::normalize(options.camera.eye - p);
        const glm::vec3 lobe = shLobe(read, c.data(), {-toEye.x, toEye.y, -toEye.z},
                                      windowedLobeFactors(lobeExponent(m.roughness), read));
        const glm::vec3 albedo = glm::vec3(m.baseColor) * (1 - m.metallic);
        return albedo / kPi * shIrradiance(std::min(int(bands), 3), c.data(), {0, 1, 0}) +
               specularAlbedo(gloss, toEye.y) * lobe;
    }
};

TEST_F(ViewportGlossy, ReflectsBouncedLightAsTheCpuDoesInEveryNumberOfBands) {
    options.camera.eye = {1, 3, 4};
    for (const float metallic : {1.f, 0.5f, 0.f})
        for (const float roughness : {0.1f, 0.5f, 0.731f, 1.f})
            for (std::uint32_t bands = 2; bands <= 8; ++bands) {
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

} // namespace
} // namespace limn
