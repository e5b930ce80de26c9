// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/overlay/overlay.h"
#include "tests/core/sweep.h"
#include "tests/render/viewport_fixture.h"

#include <algorithm>
#include <functional>

#include <glm/vector_relational.hpp>

namespace limn::surface_images_test {
namespace {

/// Two boxes' worth of quads over a plane, a lamp, light from lightmap and grid: what a change of
/// any of them makes of the picture, against a viewport that has seen nothing before.
class KeptSurfaces : public ViewportTest {
protected:
    void SetUp() override {
        ViewportTest::SetUp();
        simple::SceneBuilder b = plane();
        b.addMaterial(simple::lambert({0.7f, 0.5f, 0.3f}));
        b.add(simple::quad({-1, 1, 1}, {1.5f, 0, 0}, {0, 0, -1}));
        scene = b.build();
        scene.instances[1].material = 1;
        scene.materials[1].metallic = 1;
        scene.materials[1].roughness = 0.3f;
        scene.lights = {{.position = {1, 3, 1}, .strength = 9}};
        layout = layoutOfThePlane();
        field = fieldOf(8);
        options.camera.eye = {1, 5, 2};
        options.view = View::Lit;
    }

    static std::shared_ptr<LightmapLayout> layoutOfThePlane() {
        auto made = std::make_shared<LightmapLayout>();
        made->width = made->height = 4;
        made->meshes.resize(2);
        made->instances.resize(2);
        made->instances[0].uv = {{0.2f, 0.2f}, {0.8f, 0.2f}, {0.8f, 0.8f}, {0.2f, 0.8f}};
        return made;
    }

    static IndirectField fieldOf(std::uint32_t bands) {
        IndirectField f;
        f.bands = bands;
        f.lightmapWidth = f.lightmapHeight = 4;
        for (std::uint32_t k = 0; k < 16 * f.coefficients(); ++k)
            f.lightmap.emplace_back(glm::vec3(k < 16 ? 5 + float(k % 5) : 0.1f), 0);
        f.gridSize = {2, 1, 2};
        f.gridBounds = {{-4, -1, -4}, {4, 4, 4}};
        for (std::uint32_t k = 0; k < 4 * f.coefficients(); ++k)
            f.grid.emplace_back(glm::vec3(k < 4 ? 3 + float(k) : 0.2f), 0);
        return f;
    }

    ImageF drawWith(Viewport& v) const {
        v.setScene(scene, layout);
        v.setIndirect(field);
        v.render(options);
        return v.readLinear();
    }

    /// To the last bits: a software rasteriser compiles its shaders more than once.
    static bool same(const ImageF& a, const ImageF& b) {
        return std::ranges::equal(a.rgb, b.rgb, [](glm::vec3 x, glm::vec3 y) {
            return glm::all(glm::lessThanEqual(glm::abs(x - y), 1e-6f * glm::abs(x)));
        });
    }

    /// Whether the viewport, which has drawn before, draws triangles after the change; checks that
    /// the picture is the one of a new viewport, and another than before if it `differs`. With the
    /// sanitizers, making new viewports takes nearly all of the time, so every fourth has one.
    bool drawsAfter(const char* what, const std::function<void()>& change, bool differs = true) {
        drawWith(*viewport);
        const std::uint64_t draws = viewport->stats().geometryDrawn;
        const ImageF before = drawWith(*viewport);
        EXPECT_EQ(viewport->stats().geometryDrawn, draws);
        change();
        const ImageF after = drawWith(*viewport);
        const bool drawn = viewport->stats().geometryDrawn > draws;
        if (!kSanitized || m_changes++ % 4 == 0) {
            Viewport fresh(*device);
            EXPECT_TRUE(same(after, drawWith(fresh))) << what;
            EXPECT_EQ(fresh.stats().geometryDrawn, 1U);
        }
        EXPECT_NE(same(after, before), differs) << what;
        return drawn;
    }

    Scene scene;
    IndirectField field;

private:
    int m_changes = 0;
};

TEST_F(KeptSurfaces, LightThatChangesDrawsNoTriangle) {
    EXPECT_FALSE(drawsAfter("a lamp moves", [&] { scene.lights[0].position.x = -2; }));
    EXPECT_FALSE(drawsAfter("a colour", [&] { scene.lights[0].color = {1, 0.2f, 0}; }));
    EXPECT_FALSE(drawsAfter("another lamp", [&] { scene.lights.push_back(scene.lights[0]); }));
    EXPECT_FALSE(drawsAfter("no lamp", [&] { scene.lights.clear(); }));
    EXPECT_FALSE(drawsAfter("the lightmap", [&] { field.lightmap[5] += glm::vec4(1); }));
    EXPECT_FALSE(drawsAfter("the grid", [&] { field.grid[0] += glm::vec4(1); }));
    options.camera.target = {0, 0, -9}; // into the sky
    options.camera.eye = {0, 1, 0};
    EXPECT_FALSE(drawsAfter("the sky", [&] { scene.sky.radiance = {0.1f, 0.2f, 0.3f}; }));
    EXPECT_FALSE(drawsAfter(
        "exposure", [&] { options.exposureEv = 1; }, false));
}

TEST_F(KeptSurfaces, AreDrawnOnceForWhatReadsThemAndForThePicture) {
    const ImageF wanted = drawWith(*viewport);
    Viewport fresh(*device);
    fresh.setScene(scene, layout);
    fresh.setIndirect(field);
    glm::uvec2 size{options.width, options.height};
    int reads = 0;
    const auto read = [&](VkCommandBuffer, const SurfaceMap& map, std::size_t) {
        EXPECT_GE(map.bytes, std::uint64_t(size.x) * size.y);
        ++reads;
    };
    fresh.readSurfaces(options.camera, size, read);
    EXPECT_EQ(fresh.stats().geometryDrawn, 1U);
    fresh.render(options);
    EXPECT_TRUE(same(fresh.readLinear(), wanted));
    fresh.readSurfaces(options.camera, size, read);
    EXPECT_EQ(fresh.stats().geometryDrawn, 1U);
    EXPECT_TRUE(same(fresh.readLinear(), wanted)) << "the picture before stays";
    Camera other = options.camera;
    other.eye.x += 1;
    size *= 9;
    fresh.readSurfaces(other, size, read);
    EXPECT_EQ(fresh.stats().geometryDrawn, 2U);
    EXPECT_TRUE(same(fresh.readLinear(), wanted));
    fresh.render(options);
    EXPECT_EQ(fresh.stats().geometryDrawn, 3U) << "of another view";
    EXPECT_TRUE(same(fresh.readLinear(), wanted));
    EXPECT_EQ(reads, 3);
}

TEST_F(KeptSurfaces, WhateverElseIsSeenDrawsThemAnew) {
    const glm::mat4 over = glm::translate(glm::mat4(1), glm::vec3(0, 2, 0)) *
                           glm::rotate(glm::mat4(1), kPi, glm::vec3(0, 0, 1));
    const std::pair<const char*, std::function<void()>> changes[] = {
        {"the eye", [&] { options.camera.eye.x += 0.5f; }},
        {"the lens", [&] { options.camera.fovY *= 0.9f; }},
        {"the width", [&] { options.width = 40; }},
        {"the height", [&] { options.height = 24; }},
        {"larger images", [&] { options.width = 300; }},
        {"smaller again", [&] { options.width = 32; }},
        {"fewer bands", [&] { field = fieldOf(2); }},
        {"no grid", [&] { field.gridSize = glm::uvec3(0), field.grid.clear(); }},
        {"an object turns its back, which is black", [&] { scene.instances[1].toWorld = over; }},
        {"two sides", [&] { scene.materials[1].doubleSided = true; }},
        {"a colour", [&] { scene.materials[0].baseColor.r = 0.9f; }},
        {"emission",
         [&] {
             scene.materials[0].emission = {3, 0, 1};
         }},
        {"another material", [&] { scene.instances[1].material = 0; }},
        {"another lightmap",
         [&] {
             (layout = layoutOfThePlane())->instances[0].uv[0] = {0.5f, 0.5f};
         }},
        {"normals", [&] { options.view = View::Normals; }},
        {"albedo", [&] { options.view = View::Albedo; }},
        {"irradiance", [&] { options.view = View::Irradiance; }},
        {"indirect", [&] { options.view = View::Indirect; }},
        {"direct", [&] { options.view = View::Direct; }},
        {"lit", [&] { options.view = View::Lit; }}};
    for (const auto& [what, change] : changes)
        EXPECT_TRUE(drawsAfter(what, change)) << what;
}

TEST_F(KeptSurfaces, MarksDrawnOverThePictureDoNotStayInItsDepths) {
    auto marks = std::make_shared<OverlayData>();
    marks->marks = {{.position = {0, 0.5f, 0}, .radius = 0.4f, .normal = {0, 1, 0}}};
    drawWith(*viewport);
    viewport->setOverlay(marks);
    drawWith(*viewport);
    viewport->setOverlay(nullptr);
    const ImageF after = drawWith(*viewport);
    Viewport fresh(*device);
    EXPECT_TRUE(same(after, drawWith(fresh)));
}

} // namespace
} // namespace limn::surface_images_test
