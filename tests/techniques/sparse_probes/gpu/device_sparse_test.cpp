// SPDX-License-Identifier: MIT
#include "engine/techniques/sparse_probes/gpu/device_sparse.h"

#include "engine/field/field_packing.h"
#include "engine/techniques/sparse_probes/sparse_overlay.h"
#include "tests/render/viewport_fixture.h"
#include "tests/techniques/lights_of_each_kind.h"
#include "tests/techniques/sparse_probes/lit_by_sparse.h"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <utility>

namespace limn::device_sparse_test {
namespace {

using Settings = std::map<std::string, double>;

/// Difference of irradiance from the CPU's, of the CPU's mean.
struct Difference {
    double largest = 0, rms = 0;
};

class DeviceSparseTest : public ViewportTest {
protected:
    void prepare(const Scene& scene, const Settings& settings = {}, std::uint32_t texels = 1500) {
        lit = std::make_unique<LitBySparse>(scene, settings, texels);
        layout = std::make_shared<LightmapLayout>(lit->bake().lightmap);
        light = create();
    }
    void TearDown() override {
        light.reset();
        ViewportTest::TearDown();
    }
    std::unique_ptr<DeviceSparse> create() {
        auto made = DeviceSparse::create(
            *device, *viewport, static_cast<const PreparedSparse&>(*lit->prepared.data).bake(),
            *lit->prepared.scene);
        EXPECT_TRUE(made) << (made ? "" : made.error().message);
        return made ? std::move(*made) : nullptr;
    }
    LightingReport update(std::uint32_t bounces = 64, const Progress& progress = {}) {
        viewport->setScene(lit->scene, layout);
        return light->update({.scene = lit->scene, .bounces = bounces}, progress);
    }
    Difference difference() const {
        const std::vector<glm::vec3> E = light->readIrradiance();
        Difference d;
        double mean = 0;
        for (std::size_t r = 0; r < E.size(); ++r) {
            const glm::vec3 expected = lit->ofReceiver(r);
            for (int c = 0; c < 3; ++c) {
                const double e = std::abs(double(E[r][c]) - double(expected[c]));
                d.largest = std::max(d.largest, e);
                d.rms += e * e;
                mean += double(expected[c]);
            }
        }
        const double n = 3 * double(E.size());
        mean /= n;
        d.largest /= mean;
        d.rms = std::sqrt(d.rms / n) / mean;
        EXPECT_GT(mean, 1e-3);
        return d;
    }

    std::unique_ptr<LitBySparse> lit;
    std::unique_ptr<DeviceSparse> light;
};

// 32-bit sums of a few thousand terms in another order, and what the filter of a spot's map makes
// of the rim of its cone, which lies at the edge of the map.
constexpr double kRounding = 3e-4;

/// A corner of floor and two walls under a sky, and a block in it, if it has one. The lights shine
/// into it from outside.
Scene corner(bool block, bool ball = false) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert({0.7f, 0.5f, 0.3f}));
    b.addMaterial(simple::lambert({0.2f, 0.5f, 0.8f}, {0.3f, 0.1f, 0.2f}));
    b.add(simple::quad({0, 0, 5}, {4, 0, 0}, {0, 0, -5}, 0));
    b.add(simple::quad({0, 0, 5}, {0, 0, -5}, {0, 3, 0}, 1));
    b.add(simple::quad({0, 0, 0}, {4, 0, 0}, {0, 3, 0}, 0));
    if (block)
        b.add(simple::box({1, 0, 1}, {2.2f, 1.4f, 2}, false, 0));
    if (ball)
        b.add(simple::sphere(0.2f, 2, false), glm::translate(glm::mat4(1), glm::vec3(3, 1, 3)),
              true);
    b.scene.sky.radiance = {0.1f, 0.3f, 0.2f};
    return b.build();
}

Scene litCorner(bool block, bool ball = false) {
    return withLightsOfEachKind(corner(block, ball));
}

TEST_F(DeviceSparseTest, LightsAsTheCpuDoesWhereNothingCastsAShadow) {
    for (const LightKind kind : kLightKinds) {
        Scene scene = corner(false);
        scene.lights = {lightOf(kind)};
        prepare(scene);
        const LightingReport cpu = lit->update(), gpu = update();
        EXPECT_TRUE(gpu.converged);
        EXPECT_EQ(gpu.bounces, cpu.bounces);
        EXPECT_EQ(counterOf(gpu, "lights_traced"), 1);
        const Difference d = difference();
        std::printf("kind %d: largest difference %.7f, rms %.7f of the mean\n", int(kind),
                    d.largest, d.rms);
        EXPECT_LT(d.largest, kRounding);
    }
}

TEST_F(DeviceSparseTest, DiffersFromTheCpuByTheEdgesOfShadowsAlone) {
    for (const LightKind kind : kLightKinds) {
        Scene scene = corner(true);
        scene.lights = {lightOf(kind)};
        prepare(scene);
        lit->update();
        update();
        const Difference d = difference();
        std::printf("kind %d: largest difference %.5f, rms %.5f of the mean\n", int(kind),
                    d.largest, d.rms);
        EXPECT_LT(d.rms, 0.01);
    }
}

TEST_F(DeviceSparseTest, AnyNumberOfBandsIsGatheredAsOnTheCpu) {
    for (const double bands : {1, 2, 3, 5, 8}) {
        prepare(litCorner(false), {{"sparse-probes.bands", bands}}, 400);
        lit->update();
        update();
        EXPECT_LT(difference().largest, kRounding) << bands;
    }
}

TEST_F(DeviceSparseTest, CompressedTransportIsGatheredAsOnTheCpu) {
    for (const double bands : {3, 4}) {
        prepare(litCorner(false),
                {{"sparse-probes.compression", 20}, {"sparse-probes.bands", bands}}, 3000);
        ASSERT_FALSE(lit->bake().compressed.empty());
        for (const double clamp : {0, 1}) {
            lit->scene.technique.settings["sparse-probes.clamp"] = clamp;
            lit->update();
            update();
            EXPECT_LT(difference().largest, kRounding) << bands << ", clamp " << clamp;
        }
    }
}

TEST_F(DeviceSparseTest, AFurnaceIsAsBrightAsItsWalls) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f), glm::vec3(1)));
    b.add(simple::box(glm::vec3(0), {4, 3, 5}, true));
    prepare(b.build(), {}, 400);
    lit->scene.relight.tolerance = 0.01f;
    update(200);
    double mean = 0;
    const std::vector<glm::vec3> E = light->readIrradiance();
    for (const glm::vec3 e : E)
        mean += double(e.y) / double(E.size());
    std::printf("furnace: %.5f of 2 pi\n", mean / (2 * double(kPi)));
    EXPECT_NEAR(mean, 2 * double(kPi), 0.02 * 2 * double(kPi));
}

TEST_F(DeviceSparseTest, FollowsWhatChangesAndRecomputesNothingElse) {
    prepare(litCorner(false));
    const auto expect = [&](double recomputed, const char* what) {
        lit->update(200);
        const LightingReport report = update(200);
        EXPECT_FALSE(report.skipped) << what;
        EXPECT_EQ(counterOf(report, "lights_traced"), recomputed) << what;
        EXPECT_LT(difference().largest, 10 * kRounding) << what;
    };
    lit->scene.relight.tolerance = 0.01f; // both end at the same light
    expect(4, "at first");
    lit->scene.lights[1].color = {0, 1, 0.5f};
    expect(0, "colour");
    lit->scene.lights[2].position.x -= 0.5f;
    expect(1, "one moved");
    lit->scene.lights[0].enabled = false;
    expect(0, "one off");
    lit->scene.materials[0].baseColor = {0.1f, 0.6f, 0.4f, 1};
    expect(0, "material");
    lit->scene.materials[1].emission = {0, 2, 0};
    expect(0, "emission");
    lit->scene.sky.radiance = {1, 0.2f, 0};
    expect(0, "sky");
    lit->scene.technique.settings["sparse-probes.clamp"] = 1;
    expect(0, "clamp");
    lit->scene.relight.maxBounces = 1; // each change starts from no bounced light
    lit->update(1);
    update(1);
    EXPECT_LT(difference().largest, kRounding);
}

TEST_F(DeviceSparseTest, ScaleDoesNotChangeIrradianceAndTwiceTheLightIsTwiceTheIrradiance) {
    const auto mean = [&] {
        double sum = 0;
        const std::vector<glm::vec3> E = light->readIrradiance();
        for (const glm::vec3 e : E)
            sum += double(e.x) / double(E.size());
        return sum;
    };
    std::vector<double> found;
    for (const float scale : {1e-3f, 1.f, 1e3f}) {
        simple::SceneBuilder b;
        b.addMaterial(simple::lambert(glm::vec3(0.6f)));
        const glm::mat4 toWorld = glm::scale(glm::mat4(1), glm::vec3(scale));
        b.add(simple::box(glm::vec3(0), glm::vec3(4, 3, 5), true), toWorld);
        b.add(simple::box({1, 0, 1}, {1.8f, 1.2f, 1.6f}, false), toWorld);
        b.scene.lights = {pointLight(scale * glm::vec3(2, 2.5f, 2), 5 * scale * scale)};
        prepare(b.build(), {}, 800);
        update(200);
        found.push_back(mean());
    }
    EXPECT_GT(found[1], 0.1);
    EXPECT_NEAR(found[0], found[1], 0.01 * found[1]);
    EXPECT_NEAR(found[2], found[1], 0.01 * found[1]);
    lit->scene.lights[0].strength *= 2;
    lit->scene.relight.tolerance = 0.01f;
    update(200);
    EXPECT_NEAR(mean(), 2 * found[2], 2e-3 * found[2]);
}

TEST_F(DeviceSparseTest, NoLightLeaksIntoARoomThatIsDark) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.7f)));
    b.add(simple::box({-4.1f, 0, 0}, {-0.1f, 2, 4}, true));
    b.add(simple::box({0.1f, 0, 0}, {4.1f, 2, 4}, true));
    b.scene.lights = {pointLight({-2, 1.5f, 2}, 10)};
    prepare(b.build(), {{"sparse-probes.count", 54}});
    update();
    double sum[2] = {0, 0};
    const std::vector<glm::vec3> E = light->readIrradiance();
    for (std::size_t r = 0; r < E.size(); ++r)
        sum[lit->bake().receivers.instance[r]] += double(E[r].x);
    std::printf("leak %.6f of the lit room\n", sum[1] / sum[0]);
    EXPECT_GT(sum[0], 0.1);
    EXPECT_LT(sum[1], 1e-3 * sum[0]);
}

TEST_F(DeviceSparseTest, DoesNothingWhileNothingChanges) {
    prepare(litCorner(true, true));
    EXPECT_FALSE(update(1).converged);
    EXPECT_TRUE(update().converged);
    const std::vector<glm::vec3> before = light->readIrradiance();
    const LightingReport idle = update();
    EXPECT_TRUE(idle.skipped);
    EXPECT_EQ(idle.bounces, 0U);
    EXPECT_EQ(counterOf(idle, "dispatches"), 0);
    EXPECT_EQ(counterOf(idle, "probe_updates"), 0);
    EXPECT_EQ(light->readIrradiance(), before);
    EXPECT_GT(counterOf(idle, "light_bytes"), 100e3);
}

TEST_F(DeviceSparseTest, GivesTheSameBitsInEachRun) {
    prepare(litCorner(true, true));
    update();
    const std::vector<glm::vec3> first = light->readIrradiance();
    const IndirectField field = light->readField();
    light = create();
    update();
    EXPECT_EQ(light->readIrradiance(), first);
    EXPECT_TRUE(light->readField() == field);
}

TEST_F(DeviceSparseTest, TransportThatTheDeviceCannotBindAtOnceIsSplit) {
    for (const double compression : {0, 2}) {
        prepare(litCorner(true),
                {{"sparse-probes.compression", compression}, {"sparse-probes.rays", 50}}, 6000);
        ASSERT_EQ(lit->bake().compressed.empty(), compression == 0);
        update(3);
        const std::vector<glm::vec3> whole = light->readIrradiance();
        const std::uint32_t limit = device->properties.limits.maxStorageBufferRange;
        device->properties.limits.maxStorageBufferRange =
            std::uint32_t(lit->bake().receivers.size() * sizeof(shared::GpuReceiver));
        EXPECT_GT(transportBytes(lit->bake()), device->properties.limits.maxStorageBufferRange);
        light = create();
        update(3);
        EXPECT_EQ(light->readIrradiance(), whole) << compression;
        device->properties.limits.maxStorageBufferRange /= 2;
        const auto refused = DeviceSparse::create(
            *device, *viewport, static_cast<const PreparedSparse&>(*lit->prepared.data).bake(),
            *lit->prepared.scene);
        ASSERT_FALSE(refused);
        EXPECT_NE(refused.error().message.find("the receivers of this bake take"),
                  std::string::npos)
            << refused.error().message;
        device->properties.limits.maxStorageBufferRange = limit;
    }
}

TEST_F(DeviceSparseTest, ProbesGiveTheSameBitsInSharedMemoryAndOutsideOfIt) {
    for (const double compression : {0, 20}) {
        const bool software = std::exchange(device->softwareRasteriser, false);
        prepare(litCorner(false), {{"sparse-probes.compression", compression}}, 3000);
        update(3);
        const std::vector<glm::vec3> shared = light->readIrradiance();
        const std::uint32_t limit =
            std::exchange(device->properties.limits.maxComputeSharedMemorySize, 1024U);
        light = create();
        device->softwareRasteriser = software;
        device->properties.limits.maxComputeSharedMemorySize = limit;
        update(3);
        EXPECT_EQ(light->readIrradiance(), shared) << compression;
    }
}

TEST_F(DeviceSparseTest, RefusesADeviceThatBindsTooFewBuffers) {
    prepare(corner(false), {}, 200);
    device->properties.limits.maxPerStageDescriptorStorageBuffers = 14;
    const auto refused = DeviceSparse::create(
        *device, *viewport, static_cast<const PreparedSparse&>(*lit->prepared.data).bake(),
        *lit->prepared.scene);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("14 storage buffers"), std::string::npos);
}

TEST_F(DeviceSparseTest, ACancelledUpdateLeavesValidLightAndIsContinued) {
    prepare(litCorner(true));
    update();
    const std::vector<glm::vec3> before = light->readIrradiance();
    lit->scene.lights[1].position.x -= 1;
    const std::atomic<bool> cancel = true;
    Progress progress;
    progress.cancel = &cancel;
    const LightingReport cancelled = update(64, progress);
    EXPECT_FALSE(cancelled.converged);
    EXPECT_EQ(light->readIrradiance(), before) << "no bounce was begun";
    for (const glm::vec4 c : light->readField().lightmap)
        ASSERT_TRUE(std::isfinite(c.x) && c.x >= 0);
    lit->update(200);
    EXPECT_TRUE(update(200).converged);
    EXPECT_LT(difference().rms, 0.01);
}

TEST_F(DeviceSparseTest, StrangeLightsAreHarmless) {
    Scene scene = litCorner(true);
    scene.lights[1].strength = 1e30f;
    scene.lights[2].position = {1.5f, 0.7f, 1.5f}; // inside the block
    scene.lights[3].color = glm::vec3(0);
    prepare(scene);
    update();
    for (const glm::vec3 e : light->readIrradiance())
        ASSERT_TRUE(std::isfinite(e.x) && std::isfinite(e.y) && std::isfinite(e.z) && e.x >= 0);
    lit->scene.lights.clear();
    lit->update(200);
    update(200);
    EXPECT_LT(difference().largest, 0.01) << "nothing of it is left";
}

TEST_F(DeviceSparseTest, TheViewportShowsItsFieldAndTheGridLightsObjects) {
    prepare(litCorner(false, true));
    lit->scene.relight.tolerance = 0.01f;
    lit->update(200);
    update(200);
    const IndirectField field = light->readField(), &expected = *lit->lighting->field();
    EXPECT_EQ(field.bands, expected.bands);
    ASSERT_EQ(field.grid.size(), expected.grid.size());
    ASSERT_EQ(field.lightmap.size(), expected.lightmap.size());
    const float brightest = brightestOf(expected.grid);
    for (std::size_t k = 0; k < field.grid.size(); ++k)
        for (int c = 0; c < 3; ++c) // the ball's shadow is that of a map
            ASSERT_NEAR(field.grid[k][c], expected.grid[k][c], 0.01f * brightest) << k;
    options.camera = {.eye = {7, 5, 9}, .target = {1.5f, 1, 1.5f}, .fovY = 0.7f};
    options.view = View::Irradiance;
    viewport->render(options);
    const ImageF shown = viewport->readLinear();
    viewport->setIndirect(field);
    viewport->render(options);
    const ImageF copied = viewport->readLinear();
    EXPECT_GT(pixel(shown, 16, 16).x, 0.01f);
    for (std::size_t i = 0; i < shown.rgb.size(); ++i) // packed by another scale
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(shown.rgb[i][c], copied.rgb[i][c], 4 * kHalf * brightest) << i;
}

TEST_F(DeviceSparseTest, ItsOverlayShowsTheLightOfTheDevice) {
    for (const double bands : {3, 4}) {
        prepare(litCorner(false), {{"sparse-probes.bands", bands}}, 400);
        lit->update();
        update();
        const auto gpu = light->snapshot(), cpu = lit->lighting->snapshot();
        const ProbeRadiance &mine = static_cast<const SparseSnapshot&>(*gpu).probes(),
                            &expected = static_cast<const SparseSnapshot&>(*cpu).probes();
        ASSERT_EQ(mine.size(), expected.size());
        const float brightest = std::ranges::max(expected);
        for (std::size_t k = 0; k < mine.size(); ++k)
            ASSERT_NEAR(mine[k], expected[k], float(kRounding) * brightest) << k;
    }
}

} // namespace
} // namespace limn::device_sparse_test
