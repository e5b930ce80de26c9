// SPDX-License-Identifier: MIT
#include "engine/techniques/lpv/gpu/device_lpv.h"

#include "engine/field/sample_field.h"
#include "engine/files/project_file.h"
#include "engine/lighting/fastest_update.h"
#include "engine/lightmap/atlas.h"
#include "engine/techniques/lpv/lpv.h"
#include "tests/core/source_path.h"
#include "tests/render/viewport_fixture.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <fmt/format.h>

namespace limn::device_lpv_test {
namespace {

/// A room with a block, a lamp, and a material that may glow; `scale` times as large, lit alike.
Scene room(LightKind kind = LightKind::Point, float scale = 1) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert({0.7f, 0.5f, 0.3f}));
    b.addMaterial(simple::lambert({0.2f, 0.4f, 0.8f}));
    b.add(simple::box(glm::vec3(0), scale * glm::vec3(4, 3, 5), kind != LightKind::Directional));
    b.add(simple::box(scale * glm::vec3(1, 0, 1), scale * glm::vec3(1.8f, 1.2f, 1.6f), false))
        .material = 1;
    Light light;
    light.name = "Lamp";
    light.kind = kind;
    light.position = scale * glm::vec3(2.8137f, 2.4821f, 3.0219f);
    light.direction = glm::normalize(glm::vec3(-0.3f, -1, -0.2f));
    light.color = {1, 0.6f, 0.2f};
    light.strength = kind == LightKind::Point || kind == LightKind::Spot ? 6 * scale * scale : 6;
    light.size = scale * glm::vec2(0.7f, 0.4f);
    b.scene.lights = {light};
    b.scene.technique.settings = {{"lpv.resolution", 16}, {"lpv.map_size", 32}, {"lpv.rounds", 16}};
    return b.build();
}

/// Points on the planes of the room and in the air, with six normals each.
std::vector<glm::vec3> irradiances(const IndirectField& field, const Scene& scene,
                                   const LightmapLayout& layout, float scale = 1) {
    std::vector<glm::vec3> all;
    for (float x = 0; x <= 4; x += 0.5f)
        for (float y = 0; y <= 3; y += 0.5f)
            for (float z = 0; z <= 5; z += 0.5f)
                for (int k = 0; k < 6; ++k) {
                    glm::vec3 n(0);
                    n[k / 2] = k % 2 == 0 ? 1.f : -1.f;
                    all.push_back(sampleIrradiance({.field = field,
                                                    .layout = layout,
                                                    .scene = scene,
                                                    .instance = 0,
                                                    .triangle = 0,
                                                    .u = 0,
                                                    .v = 0,
                                                    .position = scale * glm::vec3(x, y, z),
                                                    .normal = n}));
                }
    return all;
}

class DeviceLpvTest : public ViewportTest {
protected:
    void SetUp() override {
        ViewportTest::SetUp();
        if (device)
            light(room());
    }
    void TearDown() override {
        lighting.reset();
        ViewportTest::TearDown();
    }
    std::unique_ptr<DeviceLpv> create() {
        auto made = DeviceLpv::create(*device, *viewport);
        EXPECT_TRUE(made) << (made ? "" : made.error().message);
        return made ? std::move(*made) : nullptr;
    }
    /// Starts anew with a scene.
    void light(const Scene& with) {
        scene = with;
        layout = std::make_shared<LightmapLayout>(layoutWithoutLightmap(scene));
        viewport->setScene(scene, layout);
        lighting = create();
    }
    LightingReport update(const Progress& progress = {}) {
        viewport->setScene(scene, layout);
        return lighting->update({.scene = scene}, progress);
    }
    std::vector<glm::vec4> grid() const { return lighting->gpu().readField().grid; }

    Scene scene;
    std::unique_ptr<DeviceLpv> lighting;
};

/// The same light on the CPU.
struct OnCpu {
    TraceScene trace;
    std::unique_ptr<Lighting> lighting = kLpvTechnique.light({});

    explicit OnCpu(const Scene& scene) : trace(scene) {
        lighting->update({.scene = scene, .trace = &trace}, {});
    }
};

TEST_F(DeviceLpvTest, LightsAsTheCpuDoesByEachKindOfLight) {
    for (const auto& [kind, name] :
         {std::pair(LightKind::Directional, "sun"), std::pair(LightKind::Point, "point"),
          std::pair(LightKind::Spot, "spot"), std::pair(LightKind::Rectangle, "rectangle")}) {
        light(room(kind));
        const LightingReport report = update();
        EXPECT_TRUE(report.converged && report.whole && !report.skipped) << name;
        EXPECT_EQ(report.bounces, 1U);
        const OnCpu cpu(scene);
        const std::vector<glm::vec3> mine =
                                         irradiances(lighting->gpu().readField(), scene, *layout),
                                     expected = irradiances(*cpu.lighting->field(), scene, *layout);
        double largest = 0, most = 0, squares = 0;
        for (std::size_t i = 0; i < mine.size(); ++i)
            for (int c = 0; c < 3; ++c) {
                const double difference = std::abs(double(mine[i][c]) - double(expected[i][c]));
                largest = std::max(largest, double(expected[i][c]));
                most = std::max(most, difference);
                squares += difference * difference;
            }
        const double rms = std::sqrt(squares / double(3 * mine.size()));
        std::printf("%-9s irradiance up to %.3f: max %.1e rms %.1e of that\n", name, largest,
                    most / largest, rms / largest);
        ASSERT_GT(largest, 0) << name;
        // The field's values are halfs: of each, 2^-11 may be lost. Irradiance adds up four, whose
        // magnitudes sum to less than four times the largest irradiance.
        EXPECT_LT(most / largest, 4 * double(kHalf)) << name;
        EXPECT_LT(rms / largest, 0.25 * double(kHalf)) << name;
    }
}

TEST_F(DeviceLpvTest, IsTheSameAtEveryScale) {
    for (const LightKind kind : {LightKind::Directional, LightKind::Point, LightKind::Rectangle}) {
        light(room(kind));
        update();
        const std::vector<glm::vec3> one = irradiances(lighting->gpu().readField(), scene, *layout);
        const glm::vec3 largest =
            *std::ranges::max_element(one, {}, [](glm::vec3 e) { return e.x; });
        for (const float scale : {1e-3f, 0.1f, 10.f, 1e3f}) {
            light(room(kind, scale));
            update();
            const std::vector<glm::vec3> scaled =
                irradiances(lighting->gpu().readField(), scene, *layout, scale);
            for (std::size_t i = 0; i < one.size(); ++i)
                ASSERT_NEAR(scaled[i].x, one[i].x, 0.01f * largest.x) << scale << ", place " << i;
        }
    }
}

TEST_F(DeviceLpvTest, DoublesWithItsLight) {
    update();
    const std::vector<glm::vec4> once = grid();
    scene.lights[0].strength *= 2;
    update();
    const std::vector<glm::vec4> twice = grid();
    for (std::size_t i = 0; i < once.size(); ++i)
        ASSERT_EQ(twice[i], 2.f * once[i]);
}

TEST_F(DeviceLpvTest, HasTheSameBitsEachTime) {
    scene.lights.push_back(scene.lights[0]);
    scene.lights[1].position = {1, 2, 4};
    update();
    const std::vector<glm::vec4> first = grid();
    scene.lights[1].color = {0, 1, 0};
    update();
    EXPECT_NE(grid(), first);
    scene.lights[1].color = scene.lights[0].color;
    update();
    EXPECT_EQ(grid(), first) << "back and forth";
    lighting = create();
    update();
    EXPECT_EQ(grid(), first) << "anew";
}

TEST_F(DeviceLpvTest, DispatchesNothingWhenNothingChanged) {
    const LightingReport first = update();
    EXPECT_GT(counterOf(first, "dispatches"), 0);
    EXPECT_GT(counterOf(first, "bytes_uploaded"), 0);
    EXPECT_GT(counterOf(first, "bytes"), 0);
    const std::uint64_t submitted = device->submitted();
    const LightingReport idle = lighting->update({.scene = scene}, {});
    EXPECT_TRUE(idle.skipped && idle.converged && idle.whole);
    EXPECT_EQ(counterOf(idle, "dispatches"), 0);
    EXPECT_EQ(counterOf(idle, "bytes_uploaded"), 0);
    EXPECT_EQ(counterOf(idle, "bytes"), counterOf(first, "bytes"));
    EXPECT_EQ(device->submitted(), submitted);
}

TEST_F(DeviceLpvTest, SendsOnlyWhatChanged) {
    scene.lights.push_back(scene.lights[0]);
    scene.lights[1].position = {1, 2, 4};
    update();
    const auto changed = [&](double traced, bool uploaded, const char* what) {
        const std::vector<glm::vec4> before = grid();
        const LightingReport report = update();
        EXPECT_FALSE(report.skipped) << what;
        EXPECT_EQ(counterOf(report, "lights_traced"), traced) << what;
        EXPECT_EQ(counterOf(report, "bytes_uploaded") > 0, uploaded) << what;
        EXPECT_NE(grid(), before) << what;
        EXPECT_TRUE(update().skipped) << what;
        const auto anew = create();
        anew->update({.scene = scene}, {});
        EXPECT_EQ(grid(), anew->gpu().readField().grid) << what;
    };
    scene.lights[0].color = {0, 1, 0};
    changed(0, false, "colour");
    scene.lights[1].enabled = false;
    changed(0, false, "off");
    scene.lights[1].enabled = true;
    changed(0, false, "on again");
    scene.lights[0].position.y -= 0.3f;
    changed(1, false, "a light moved");
    scene.materials[1].emission = {0.5f, 0.2f, 0.9f};
    changed(0, true, "emission");
    scene.technique.settings["lpv.emitters"] = 0;
    changed(0, false, "no emitters");
    scene.technique.settings["lpv.rounds"] = 5;
    changed(0, false, "rounds");
    scene.technique.settings["lpv.flux_lookup"] = 0;
    changed(0, false, "lookup");
    scene.materials[0].baseColor.x *= 0.5f;
    changed(2, true, "albedo");
    scene.instances[1].toWorld[3].z += 1.f;
    changed(2, true, "an object moved");
    scene.technique.settings["lpv.resolution"] = 12;
    changed(2, true, "resolution");
}

TEST_F(DeviceLpvTest, KeepsItsLightWhenCancelledAndCatchesUp) {
    update();
    const std::vector<glm::vec4> before = grid();
    scene.lights[0].position.x -= 1;
    const std::atomic<bool> cancel = true;
    const LightingReport report = update({.report = {}, .cancel = &cancel});
    EXPECT_FALSE(report.converged || report.whole || report.skipped);
    EXPECT_EQ(grid(), before);
    EXPECT_EQ(lighting->snapshot(), nullptr);
    EXPECT_TRUE(update().converged);
    const std::vector<glm::vec4> after = grid();
    EXPECT_NE(after, before);
    lighting = create();
    update();
    EXPECT_EQ(grid(), after);
}

TEST_F(DeviceLpvTest, IsFiniteForBlackHugeAndBuriedLightsAndWithoutAny) {
    scene.lights[0].strength = kMaxLight;
    scene.lights[0].color = glm::vec3(kMaxLight);
    scene.lights.push_back(
        {.kind = LightKind::Point, .position = glm::vec3(1.4f, 0.5f, 1.3f)}); // in the block
    scene.lights.push_back({.kind = LightKind::Spot, .position = glm::vec3(-50)});
    scene.lights.push_back({.kind = LightKind::Directional, .color = glm::vec3(0)});
    update();
    for (const glm::vec4& value : grid())
        for (int c = 0; c < 3; ++c)
            ASSERT_TRUE(std::isfinite(value[c]));
    scene.lights.clear();
    const LightingReport dark = update();
    EXPECT_EQ(counterOf(dark, "rounds"), 0) << "no light, no round";
    for (const glm::vec4& value : grid())
        EXPECT_EQ(value, glm::vec4(0));
    light(simple::SceneBuilder().build());
    EXPECT_TRUE(update().converged);
}

TEST_F(DeviceLpvTest, TheViewportShowsItsField) {
    options.camera = {.eye = {2, 1.5f, 4.8f}, .target = {2, 1, 0}, .fovY = 1};
    options.view = View::Irradiance;
    update();
    viewport->render(options);
    const ImageF shown = viewport->readLinear();
    viewport->setIndirect(lighting->gpu().readField());
    viewport->render(options);
    const ImageF copied = viewport->readLinear();
    EXPECT_GT(pixel(shown, 16, 16).x, 0.001f);
    EXPECT_TRUE(shown.rgb == copied.rgb);
    update();
    viewport->render(options);
    EXPECT_TRUE(viewport->readLinear().rgb == shown.rgb) << "shown again, though nothing changed";
}

TEST_F(DeviceLpvTest, ItsOverlaysShowWhatThoseOfTheCpuDo) {
    update();
    const OnCpu cpu(scene);
    const auto mine = lighting->snapshot(), expected = cpu.lighting->snapshot();
    ASSERT_TRUE(mine && expected);
    for (const OverlayKind& kind : kLpvTechnique.overlays) {
        const OverlayRequest request{.kind = &kind};
        EXPECT_EQ(mine->overlay(request, scene, mine.get()).marks.size(),
                  expected->overlay(request, scene, expected.get()).marks.size())
            << kind.name;
    }
}

// Prints what docs/light-propagation-volumes.md quotes: the samples, with a lamp in Cornell, and
// every light moved.
TEST_F(DeviceLpvTest, TakesTimeInEachStep) {
    for (const char* name : {"cornell", "atrium"}) {
        const ImportedScene sample =
            *loadProject(sourcePath(fmt::format("projects/{0}/{0}.limn", name)));
        Scene lit = flatten(sample.document, sample.assets);
        if (lit.lights.empty())
            lit.lights = {{.kind = LightKind::Rectangle,
                           .position = {0, 5.3f, 0},
                           .direction = {0, -1, 0},
                           .strength = 20,
                           .size = {1.3f, 1}}};
        light(lit);
        const TraceScene trace(scene);
        const auto cpu = kLpvTechnique.light({});
        for (const bool onDevice : {false, true}) {
            const LightingReport best = fastestUpdate(onDevice ? *lighting : *cpu, scene, trace, 5);
            std::printf("%s, %s: %.1f ms", name, onDevice ? "device" : "cpu", best.totalMs);
            for (const LightingStep& step : best.steps)
                std::printf(", %s %.1f", step.id, step.ms);
            std::printf("\n");
            EXPECT_GT(best.totalMs, 0);
        }
    }
}

} // namespace
} // namespace limn::device_lpv_test
