// SPDX-License-Identifier: MIT
#include "engine/lightmap/atlas.h"
#include "engine/picture/field_render.h"
#include "engine/techniques/probes/gpu/device_probes.h"
#include "engine/techniques/probes/gpu/marched_pass.h"
#include "tests/core/sweep.h"
#include "tests/render/viewport_fixture.h"
#include "tests/techniques/probes/lit_by_probes.h"

#include <cstdio>

namespace limn::device_reflections_test {
namespace {

/// Differences of pixels from those of the CPU [W m^-2 sr^-1].
struct Difference {
    double largest = 0, rms = 0;
    double share = 0; ///< of the pixels, of those that differ by more than 1 % of kPanel
};
constexpr std::uint32_t kSide = 64, kParts = 8; ///< pixels of a picture; samples along their sides
constexpr float kPanel = 5, kMetalReflectance = 0.9f;

class DeviceReflectionsTest : public ViewportTest {
protected:
    void prepare(float roughness, double side = 64) {
        lit = std::make_unique<LitByProbes>(
            mirrorAndPanel(roughness),
            std::map<std::string, double>{{"probes.count", 64}, {"probes.side", side}});
        auto made = DeviceProbes::create(*device, *viewport);
        ASSERT_TRUE(made);
        light = std::move(*made);
        options.camera = {.eye = {2, 1.5f, 3.5f}, .target = {2, 0.5f, 1}};
        options.width = options.height = kSide * kParts;
    }
    void TearDown() override {
        light.reset();
        ViewportTest::TearDown();
    }

    /// A floor of metal in a room, half of whose back wall is covered by a glowing panel.
    static Scene mirrorAndPanel(float roughness) {
        simple::SceneBuilder b;
        b.addMaterial(simple::lambert(glm::vec3(0.2f)));
        Material metal = simple::lambert(glm::vec3(kMetalReflectance));
        metal.metallic = 1;
        metal.roughness = roughness;
        b.addMaterial(metal);
        b.addMaterial(simple::lambert(glm::vec3(0), glm::vec3(kPanel)));
        b.add(simple::box({0, 0, 0}, {4, 3, 4}, true));
        b.add(simple::quad({0, 0.01f, 4}, {4, 0, 0}, {0, 0, -4}, 1));
        b.add(simple::quad({0, 0.02f, 0.01f}, {2, 0, 0}, {0, 2.9f, 0}, 2));
        return b.build();
    }

    LightingReport update() {
        viewport->setScene(lit->scene, nullptr);
        return light->update({.scene = lit->scene, .bounces = 64}, {});
    }
    /// The mean of the samples of each pixel.
    ImageF draw() {
        options.view = View::Lit;
        viewport->render(options);
        const ImageF samples = viewport->readLinear();
        ImageF image{kSide, kSide, std::vector<glm::vec3>(kSide * kSide, glm::vec3(0))};
        for (std::uint32_t y = 0; y < samples.height; ++y)
            for (std::uint32_t x = 0; x < samples.width; ++x)
                image.rgb[y / kParts * kSide + x / kParts] +=
                    pixel(samples, x, y) / float(kParts * kParts);
        return image;
    }
    ImageF drawOnCpu() {
        lit->trace = std::make_shared<const TraceScene>(lit->scene);
        lit->lighting->update(
            {.scene = lit->scene, .trace = lit->trace.get(), .bounces = 64, .reflections = true},
            {});
        FieldRenderOptions o;
        o.camera = options.camera;
        o.width = o.height = kSide;
        o.samplesPerPixel = kParts * kParts;
        return renderField(*lit->trace, *lit->lighting->field(), layoutWithoutLightmap(lit->scene),
                           o);
    }
    static Difference difference(const ImageF& image, const ImageF& expected) {
        Difference d;
        for (std::size_t i = 0; i < image.rgb.size(); ++i)
            for (int c = 0; c < 3; ++c) {
                const double e = std::abs(double(image.rgb[i][c]) - double(expected.rgb[i][c]));
                d.largest = std::max(d.largest, e);
                d.rms += e * e / (3 * double(image.rgb.size()));
                d.share += e > 0.01 * double(kPanel) ? 1 / (3 * double(image.rgb.size())) : 0;
            }
        d.rms = std::sqrt(d.rms);
        return d;
    }
    glm::vec3 floorPixel(const ImageF& image, std::uint32_t x) const { return pixel(image, x, 44); }

    std::unique_ptr<LitByProbes> lit;
    std::unique_ptr<DeviceProbes> light;
};

// Both pictures sample the edges of what is reflected at other places.
constexpr double kEdges = 0.02;

TEST_F(DeviceReflectionsTest, AreThoseOfTheCpu) {
    for (const float roughness : {0.f, 0.1f, 0.3f, 0.45f})
        for (const double side : {64, 45}) {
            if (kSanitized && (side == 64) != (roughness == 0.1f))
                continue;
            prepare(roughness, side);
            const LightingReport report = update();
            EXPECT_FALSE(report.lacks);
            EXPECT_GT(counterOf(report, "reflection_bytes"),
                      counterOf(report, "probes") * side * side * 28);
            const Difference d = difference(draw(), drawOnCpu());
            std::printf("roughness %.2f, side %.0f: largest difference %.5f, rms %.5f of the "
                        "panel's radiance, %.4f of the pixels\n",
                        double(roughness), side, d.largest / double(kPanel), d.rms / double(kPanel),
                        d.share);
            std::printf("indirect pass %.1f ms at %u pixels a side, maps %.1f MiB\n",
                        viewport->stats().indirectMs, options.width,
                        counterOf(report, "reflection_bytes") / (1 << 20));
            EXPECT_LT(d.rms, 0.01 * double(kPanel));
            EXPECT_LT(d.share, kEdges);
        }
}

TEST_F(DeviceReflectionsTest, MirrorTheHalfOfTheWallThatGlows) {
    prepare(0);
    update();
    const ImageF image = draw();
    EXPECT_NEAR(floorPixel(image, 16).x, kMetalReflectance * kPanel, 0.1f * kPanel);
    EXPECT_LT(floorPixel(image, 48).x, 0.1f * kPanel);
    lit->scene.technique.settings["probes.reflections"] = 0;
    const LightingReport off = update();
    EXPECT_EQ(counterOf(off, "reflection_bytes"), 0);
    EXPECT_FALSE(off.lacks);
    const double marchedMs = viewport->stats().indirectMs;
    const ImageF harmonics = draw();
    std::printf("indirect pass %.1f ms marched, %.1f ms by harmonics, %u pixels a side\n",
                marchedMs, viewport->stats().indirectMs, options.width);
    EXPECT_GT(difference(harmonics, image).share, 0.2);
    EXPECT_LT(floorPixel(harmonics, 16).x, 0.8f * floorPixel(image, 16).x) << "they are blurred";
    lit->scene.technique.settings["probes.reflections"] = 1;
    update();
    EXPECT_EQ(draw().rgb, image.rgb);
}

TEST_F(DeviceReflectionsTest, FollowLightAndObjects) {
    prepare(0);
    update();
    draw();
    const std::uint64_t drawn = viewport->stats().geometryDrawn;
    lit->scene.sky.radiance = {1, 1, 1};
    lit->scene.lights = {pointLight({3, 2, 1}, 5)};
    viewport->setLighting(lit->scene);
    light->update({.scene = lit->scene, .bounces = 64}, {});
    EXPECT_LT(difference(draw(), drawOnCpu()).share, 2 * kEdges);
    EXPECT_EQ(viewport->stats().geometryDrawn, drawn) << "light alone changed";
    lit->scene.lights.clear();
    lit->scene.instances[2].toWorld[3].x += 2; // the panel moves to the other half
    update();
    const ImageF image = draw();
    EXPECT_LT(floorPixel(image, 16).x, 0.1f * kPanel);
    EXPECT_NEAR(floorPixel(image, 48).x, kMetalReflectance * kPanel, 0.1f * kPanel);
    EXPECT_LT(difference(image, drawOnCpu()).share, kEdges);
}

TEST_F(DeviceReflectionsTest, OfAFieldOfTheCpuAreTheSame) {
    prepare(0.1f);
    update();
    const ImageF shown = draw(), expected = drawOnCpu();
    const IndirectField& field = *lit->lighting->field();
    viewport->setIndirect(field, uploadMarchedPart(*device, *viewport, field));
    const ImageF uploaded = draw();
    EXPECT_LT(difference(uploaded, expected).share, kEdges);
    EXPECT_LT(difference(uploaded, shown).share, kEdges);
}

TEST_F(DeviceReflectionsTest, AreHarmonicsWhereTheDeviceCannotBindTheMaps) {
    prepare(0);
    const std::uint32_t limit = device->properties.limits.maxStorageBufferRange;
    device->properties.limits.maxStorageBufferRange = 1 << 21;
    const LightingReport report = update();
    device->properties.limits.maxStorageBufferRange = limit;
    ASSERT_TRUE(report.lacks);
    EXPECT_TRUE(report.converged);
    EXPECT_EQ(counterOf(report, "reflection_bytes"), 0);
    EXPECT_GT(floorPixel(draw(), 16).x, 0.1f * kPanel) << "it is lit nevertheless";
}

} // namespace
} // namespace limn::device_reflections_test
