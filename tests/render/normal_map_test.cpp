// SPDX-License-Identifier: MIT
// The viewport, the pictures of the CPU and the reference bend normals alike.
#include "engine/measure/compare.h"
#include "engine/reference/reference.h"
#include "engine/shading/surface_point.h"
#include "tests/render/viewport_fixture.h"

namespace limn {

class NormalMaps : public ViewportTest {
protected:
    void SetUp() override {
        ViewportTest::SetUp();
        options.width = options.height = 48;
    }
};

/// A plane whose normal map holds random normals within about 60 degrees of the vertices'.
static simple::SceneBuilder bumpyPlane(const glm::mat4& toWorld, float handedness) {
    simple::SceneBuilder b;
    Material m = simple::lambert({0.2f, 0.4f, 0.8f});
    m.doubleSided = true;
    m.normalTexture = {.image = 0, .offset = {0.1f, 0.3f}, .scale = {1.5f, 1.2f}, .rotation = 0.4f};
    m.normalTexture.nearest = true;
    m.normalScale = 0.8f;
    b.addMaterial(m);
    Mesh mesh = simple::quad({-10, 0, 10}, {20, 0, 0}, {0, 0, -20});
    mesh.normals = {glm::normalize(glm::vec3(0.2f, 1, 0)),
                    glm::normalize(glm::vec3(0, 1, 0.3f)),
                    {0, 1, 0},
                    glm::normalize(glm::vec3(-0.1f, 1, -0.1f))};
    mesh.tangents.assign(4, glm::vec4(glm::normalize(glm::vec3(1, 0.1f, 0.5f)), handedness));
    b.addInstance(b.addMesh(std::move(mesh)), toWorld);
    Image image{.name = "bumps", .width = 8, .height = 8, .rgba = {}};
    for (std::uint32_t i = 0; i < 64; ++i) {
        const auto v = [&](std::uint32_t k) { return std::uint8_t((i * 37 + k * 91) % 200 + 28); };
        image.rgba.insert(image.rgba.end(), {v(0), v(1), 220, 255});
    }
    b.assets->images.push_back(image);
    return b;
}

TEST_F(NormalMaps, BendTheNormalAsTheTracerDoes) {
    const glm::mat4 one(1);
    const std::array<glm::mat4, 4> transforms{
        one, glm::scale(one, glm::vec3(-1, 1, 1)), glm::scale(one, glm::vec3(1, -1, 1)),
        glm::scale(glm::rotate(one, 0.5f, glm::vec3(0, 1, 0)), glm::vec3(1, 1, 2))};
    for (const float handedness : {1.f, -1.f})
        for (std::size_t k = 0; k < transforms.size(); ++k) {
            const Scene scene = bumpyPlane(transforms[k], handedness).build();
            const TraceScene trace(scene);
            const ImageF drawn = draw(scene, View::Normals);
            int different = 0;
            for (std::uint32_t y = 0; y < options.height; ++y)
                for (std::uint32_t x = 0; x < options.width; ++x) {
                    const glm::vec3 eye = options.camera.eye;
                    const Hit hit =
                        trace.closestHit({eye, glm::normalize(planePoint(options, x, y) - eye)});
                    ASSERT_TRUE(hit);
                    const glm::vec3 n = shadingNormalAt(scene, hit);
                    different += glm::distance(pixel(drawn, x, y) * 2.f - 1.f, n) > 0.01f;
                }
            // Nearest texels differ where a pixel's middle meets a texel's edge.
            EXPECT_LE(different, 48 * 48 / 50) << k << ' ' << handedness;
        }
}

/// Direct light of one lamp has no noise, whatever the material.
TEST_F(NormalMaps, ShowInTheReferenceAsInTheViewport) {
    for (const auto& [metallic, roughness] :
         {std::pair(0.f, 1.f), std::pair(0.f, 0.4f), std::pair(0.8f, 0.5f)}) {
        simple::SceneBuilder b = bumpyPlane(glm::mat4(1), 1);
        b.scene.materials[0].metallic = metallic;
        b.scene.materials[0].roughness = roughness;
        Light lamp;
        lamp.position = {1, 3, 0.5f};
        lamp.strength = 40;
        b.scene.lights = {lamp};
        const Scene scene = b.build();
        const TraceScene trace(scene);
        // Both take the mean over a pixel, in which a texel may end.
        options.view = View::Lit;
        viewport->setScene(scene, layout);
        viewport->render(options);
        while (viewport->refine() < 64) {
        }
        const ReferenceResult reference = renderReference(trace, {.camera = options.camera,
                                                                  .width = options.width,
                                                                  .height = options.height,
                                                                  .samplesPerPixel = 64});
        const Result<Comparison> c = compareImages(viewport->readLinear(), reference.image);
        ASSERT_TRUE(c);
        EXPECT_LT(c->nrmse, 0.02) << metallic << ' ' << roughness;
        EXPECT_LT(std::abs(c->bias), 2e-3) << metallic << ' ' << roughness;
    }
}

} // namespace limn
