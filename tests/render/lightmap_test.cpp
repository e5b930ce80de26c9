// SPDX-License-Identifier: MIT
#include "engine/picture/field_render.h"
#include "tests/render/viewport_fixture.h"

namespace limn::lightmap_test {
namespace {

using ViewportLightmap = ViewportTest;

TEST_F(ViewportLightmap, TheLightmapIsReadBetweenTexelCentresLinearlyAndWithVDown) {
    layout = std::make_shared<LightmapLayout>();
    layout->width = 4;
    layout->height = 2;
    layout->meshes.resize(1);
    layout->instances.resize(1);
    // From the middle of texel (0, 0) at x = -10 to that of (3, 0) at x = 10; row 1 is poison.
    layout->instances[0].uv = {{0.125f, 0.25f}, {0.875f, 0.25f}, {0.875f, 0.25f}, {0.125f, 0.25f}};
    IndirectField field;
    field.version = 1;
    field.lightmapWidth = 4;
    field.lightmapHeight = 2;
    field.lightmap.assign(8 * 9, glm::vec4(0));
    for (std::uint32_t x = 0; x < 4; ++x) {
        field.lightmap[x] = glm::vec4(glm::vec3(2 * std::sqrt(kPi) * float(x)), 0);
        field.lightmap[4 + x] = glm::vec4(1e6f);
    }
    viewport->setIndirect(field);
    const ImageF image = draw(plane().build(), View::Irradiance);
    for (std::uint32_t x = 0; x < 32; ++x) {
        const float texel = (planePoint(options, x, 16).x + 10) / 20 * 3;
        // Texture units interpolate with 8 bits of weight.
        EXPECT_NEAR(pixel(image, x, 16).r, kPi * texel, kPi / 256);
    }
}

TEST_F(ViewportLightmap, EachSideOfATwoSidedSurfaceReadsItsOwnTexels) {
    simple::SceneBuilder b = plane();
    b.scene.materials[0].doubleSided = true;
    layout = std::make_shared<LightmapLayout>();
    layout->width = 1;
    layout->height = 2;
    layout->meshes.resize(1);
    layout->instances = {{std::vector<glm::vec2>(4, {0.5f, 0.25f}), 1}};
    IndirectField field;
    field.bands = 2;
    field.lightmapWidth = 1;
    field.lightmapHeight = 2;
    field.lightmap.assign(8, glm::vec4(0));
    const glm::vec3 front(1, 2, 0.5f), back(3, 0.25f, 1);
    field.lightmap[0] = glm::vec4(front * (2 * std::sqrt(kPi)), 0);
    field.lightmap[1] = glm::vec4(back * (2 * std::sqrt(kPi)), 0);
    viewport->setIndirect(field);
    for (const float x : {1.f, -1.f})
        for (const float y : {1.f, -1.f}) { // the camera looks down on it
            b.scene.instances[0].toWorld = glm::scale(glm::mat4(1), glm::vec3(x, y, 1));
            expectNear(pixel(draw(b.build(), View::Irradiance), 16, 16),
                       kPi * (y > 0 ? front : back), 1e-5f + kHalf);
        }
    b.scene.instances[0].toWorld = glm::mat4(1);
    const Scene scene = b.build();
    TraceScene trace(scene);
    FieldRenderOptions traced;
    traced.camera = options.camera;
    traced.width = traced.height = 2;
    traced.view = View::Irradiance;
    layout->meshes[0] = {{0, 1, 2, 3}, {0, 1, 2, 0, 2, 3}, {0, 0}, {}, {{1, 1}}};
    expectNear(renderField(trace, field, *layout, traced).rgb[0], kPi * front, 1e-5f);
    traced.camera.eye = -traced.camera.eye;
    expectNear(renderField(trace, field, *layout, traced).rgb[0], kPi * back, 1e-5f);
}

} // namespace
} // namespace limn::lightmap_test
