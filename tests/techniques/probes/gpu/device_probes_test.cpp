// SPDX-License-Identifier: MIT
#include "engine/techniques/probes/gpu/device_probes.h"

#include "engine/techniques/probes/probe_overlay.h"
#include "tests/render/viewport_fixture.h"
#include "tests/techniques/lights_of_each_kind.h"
#include "tests/techniques/probes/lit_by_probes.h"

#include <atomic>
#include <cstdio>

namespace limn::device_probes_test {
namespace {

using Settings = std::map<std::string, double>;

/// Difference of probes' irradiance from the CPU's, of the CPU's mean.
struct Difference {
    double largest = 0, rms = 0;
};

class DeviceProbesTest : public ViewportTest {
protected:
    void prepare(const Scene& scene, Settings settings = {}) {
        settings.try_emplace("probes.count", 64);
        lit = std::make_unique<LitByProbes>(scene, settings);
        light = create();
    }
    void TearDown() override {
        light.reset();
        ViewportTest::TearDown();
    }
    std::unique_ptr<DeviceProbes> create() {
        auto made = DeviceProbes::create(*device, *viewport);
        EXPECT_TRUE(made) << (made ? "" : made.error().message);
        return made ? std::move(*made) : nullptr;
    }
    LightingReport update(const Viewpoint* view = nullptr, const Progress& progress = {}) {
        viewport->setScene(lit->scene, nullptr);
        return light->update({.scene = lit->scene, .bounces = 64, .view = view}, progress);
    }
    void updateCpu() {
        lit->trace = std::make_shared<const TraceScene>(lit->scene);
        lit->update();
    }
    /// Irradiance of all probes that are not in solids, from six sides.
    std::vector<glm::vec3> irradiance() const {
        std::vector<glm::vec3> E;
        const std::vector<ProbeHarmonics> all = light->gpu()->readLight();
        for (std::size_t p = 0; p < all.size(); ++p)
            addSides(p, all[p], E);
        return E;
    }
    std::vector<glm::vec3> irradianceOfCpu() const {
        std::vector<glm::vec3> E;
        const IndirectField& field = *lit->lighting->field();
        for (std::size_t p = 0; p < field.cells(); ++p) {
            ProbeHarmonics c;
            for (std::size_t i = 0; i < c.size(); ++i)
                c[i] = glm::vec3(field.grid[i * field.cells() + p]);
            addSides(p, c, E);
        }
        return E;
    }
    void addSides(std::size_t probe, const ProbeHarmonics& c, std::vector<glm::vec3>& E) const {
        if (light->maps().inSolid[probe])
            return;
        for (int axis = 0; axis < 3; ++axis)
            for (const float side : {-1.f, 1.f}) {
                glm::vec3 n(0);
                n[axis] = side;
                E.push_back(shIrradiance(kIrradianceBands, c.data(), n));
            }
    }
    Difference difference() const {
        const std::vector<glm::vec3> E = irradiance(), expected = irradianceOfCpu();
        EXPECT_EQ(E.size(), expected.size());
        Difference d;
        double mean = 0;
        for (std::size_t k = 0; k < std::min(E.size(), expected.size()); ++k)
            for (int c = 0; c < 3; ++c) {
                const double e = std::abs(double(E[k][c]) - double(expected[k][c]));
                d.largest = std::max(d.largest, e);
                d.rms += e * e;
                mean += double(expected[k][c]);
            }
        const double n = 3 * double(E.size());
        mean /= n;
        EXPECT_GT(mean, 1e-3);
        return {d.largest / mean, std::sqrt(d.rms / n) / mean};
    }

    std::unique_ptr<LitByProbes> lit;
    std::unique_ptr<DeviceProbes> light;
};

// 32-bit sums of some hundred terms in another order, and albedo in 16 bits.
constexpr double kRounding = 1e-4;

/// A corner of floor and two walls under a sky, one of which glows, and a block in it, if it has
/// one. The lights shine into it from outside. Its sides end before they meet: where they did, the
/// texels of a shadow map would show both of them.
Scene corner(bool block) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert({0.7f, 0.5f, 0.3f}));
    b.addMaterial(simple::lambert({0.2f, 0.5f, 0.8f}, {0.3f, 0.1f, 0.2f}));
    b.add(simple::quad({0.1f, 0, 5.5f}, {4, 0, 0}, {0, 0, -5.4f}, 0));
    b.add(simple::quad({0, 0.1f, 5.5f}, {0, 0, -5.4f}, {0, 2.7f, 0}, 1));
    b.add(simple::quad({0.1f, 0.1f, 0}, {4, 0, 0}, {0, 2.7f, 0}, 0));
    if (block)
        b.add(simple::box({1, 0, 1}, {2.2f, 1.4f, 2}, false, 0));
    b.scene.sky.radiance = {0.1f, 0.3f, 0.2f};
    return b.build();
}

Scene litCorner(bool block) {
    return withLightsOfEachKind(corner(block));
}

TEST_F(DeviceProbesTest, LightAsTheCpuDoesWhereNothingCastsAShadow) {
    for (const LightKind kind : kLightKinds) {
        Scene scene = corner(false);
        scene.lights = {lightOf(kind)};
        prepare(scene);
        lit->update();
        const LightingReport report = update();
        EXPECT_TRUE(report.converged && report.whole);
        EXPECT_EQ(counterOf(report, "lights_traced"), 1);
        const Difference d = difference();
        std::printf("kind %d: largest difference %.7f, rms %.7f of the mean\n", int(kind),
                    d.largest, d.rms);
        EXPECT_LT(d.largest, kRounding);
    }
}

TEST_F(DeviceProbesTest, DifferFromTheCpuByTheEdgesOfShadowsAlone) {
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

TEST_F(DeviceProbesTest, AllBouncesAreThoseOfTheCpu) {
    for (const double smooth : {0, 1}) {
        prepare(litCorner(false), {{"probes.bounces", 1}, {"probes.smooth", smooth}});
        lit->scene.relight.tolerance = 0.01f;
        lit->update();
        const LightingReport report = update();
        EXPECT_TRUE(report.converged);
        EXPECT_GT(report.bounces, 2U);
        EXPECT_LT(difference().largest, 10 * kRounding) << smooth;
        lit->scene.technique.settings["probes.bounces"] = 0;
        lit->update();
        update();
        EXPECT_LT(difference().largest, kRounding) << smooth;
    }
}

TEST_F(DeviceProbesTest, AFurnaceIsAsBrightAsItsWalls) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0), glm::vec3(1)));
    b.add(simple::box(glm::vec3(0), {4, 3, 5}, true));
    prepare(b.build());
    update();
    for (const glm::vec3 e : irradiance())
        ASSERT_NEAR(e.y, kPi, 0.01f * kPi);
}

TEST_F(DeviceProbesTest, FollowWhatChangesAndComputeNothingElse) {
    prepare(litCorner(false));
    const auto expect = [&](double recomputed, double traced, const char* what) {
        updateCpu();
        const LightingReport report = update();
        EXPECT_FALSE(report.skipped) << what;
        EXPECT_EQ(counterOf(report, "lights_traced"), recomputed) << what;
        EXPECT_EQ(counterOf(report, "probes_refreshed"), traced) << what;
        EXPECT_LT(difference().largest, kRounding) << what;
    };
    update();
    const double probes = double(light->maps().grid.count());
    light = create();
    expect(4, probes, "at first");
    lit->scene.lights[1].color = {0, 1, 0.5f};
    expect(0, 0, "colour");
    lit->scene.lights[2].position.x -= 0.5f;
    expect(1, 0, "one moved");
    lit->scene.lights[0].enabled = false;
    expect(0, 0, "one off");
    lit->scene.materials[0].baseColor = {0.1f, 0.6f, 0.4f, 1};
    lit->scene.materials[1].emission = {0, 2, 0};
    expect(0, 0, "materials");
    lit->scene.sky.radiance = {1, 0.2f, 0};
    expect(0, 0, "sky");
    lit->scene.lights.clear();
    lit->scene.instances[1].toWorld[3].x -= 0.3f;
    expect(0, probes, "a wall moved");
    lit->scene.technique.settings["probes.count"] = 100;
    updateCpu();
    update();
    EXPECT_LT(difference().largest, kRounding);
}

TEST_F(DeviceProbesTest, ScaleDoesNotChangeIrradianceAndTwiceTheLightIsTwiceTheIrradiance) {
    const auto mean = [&] {
        double sum = 0;
        const std::vector<glm::vec3> E = irradiance();
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
        prepare(b.build());
        update();
        found.push_back(mean());
    }
    EXPECT_GT(found[1], 0.1);
    EXPECT_NEAR(found[0], found[1], 0.01 * found[1]);
    EXPECT_NEAR(found[2], found[1], 0.01 * found[1]);
    lit->scene.lights[0].strength *= 2;
    update();
    EXPECT_NEAR(mean(), 2 * found[2], 1e-5 * found[2]);
}

TEST_F(DeviceProbesTest, DoNothingWhileNothingChanges) {
    prepare(litCorner(true));
    EXPECT_TRUE(update().converged);
    const std::vector<glm::vec3> before = irradiance();
    const LightingReport idle = update();
    EXPECT_TRUE(idle.skipped);
    EXPECT_EQ(counterOf(idle, "dispatches"), 0);
    EXPECT_EQ(counterOf(idle, "rays"), 0);
    EXPECT_EQ(irradiance(), before);
    EXPECT_GT(counterOf(idle, "probe_bytes"), 1e6);
}

TEST_F(DeviceProbesTest, GiveTheSameBitsInEachRunAndInBlocks) {
    prepare(litCorner(true), {{"probes.bounces", 1}});
    update();
    const std::vector<glm::vec3> first = irradiance();
    light = create();
    update();
    EXPECT_EQ(irradiance(), first);
    const std::uint32_t limit = device->properties.limits.maxStorageBufferRange;
    device->properties.limits.maxStorageBufferRange = 1 << 20;
    lit->scene.lights.pop_back(); // points sample a rectangle's shadow by their number in a block
    light = create();
    update();
    const std::vector<glm::vec3> blocks = irradiance();
    device->properties.limits.maxStorageBufferRange = limit;
    light = create();
    update();
    EXPECT_EQ(irradiance(), blocks);
}

TEST_F(DeviceProbesTest, WhileSomebodyLooksAFewMapsAreTracedInTurn) {
    prepare(litCorner(false), {{"probes.perUpdate", 10}});
    const Viewpoint view{.camera = options.camera, .aspect = 1};
    const LightingReport first = update(&view);
    const double probes = double(light->maps().grid.count());
    EXPECT_EQ(counterOf(first, "probes_refreshed"), 10);
    EXPECT_EQ(counterOf(first, "probes_stale"), probes - 10);
    EXPECT_FALSE(first.whole || first.converged);
    int updates = 1;
    while (!update(&view).whole)
        ++updates;
    EXPECT_EQ(updates, int(std::ceil(probes / 10)) - 1);
    lit->update();
    EXPECT_LT(difference().largest, kRounding);
    lit->scene.lights[1].position.x -= 0.5f;
    lit->update();
    EXPECT_EQ(counterOf(update(&view), "probes_refreshed"), 0) << "light follows at once";
    EXPECT_LT(difference().largest, kRounding);
}

TEST_F(DeviceProbesTest, ACancelledUpdateLeavesValidLightAndIsContinued) {
    prepare(litCorner(true), {{"probes.bounces", 1}});
    const std::atomic<bool> cancel = true;
    Progress progress;
    progress.cancel = &cancel;
    const LightingReport cancelled = update(nullptr, progress);
    EXPECT_FALSE(cancelled.whole || cancelled.converged);
    for (const ProbeHarmonics& c : light->gpu()->readLight())
        ASSERT_EQ(c[0], glm::vec3(0));
    EXPECT_TRUE(update().converged);
    const std::vector<glm::vec3> continued = irradiance();
    light = create();
    update();
    EXPECT_EQ(irradiance(), continued);
}

TEST_F(DeviceProbesTest, StrangeLightsAndNothingAtAllAreHarmless) {
    Scene scene = litCorner(true);
    scene.lights[1].strength = 1e30f;
    scene.lights[2].position = {1.5f, 0.7f, 1.5f}; // inside the block
    scene.lights[3].color = glm::vec3(0);
    prepare(scene);
    update();
    for (const glm::vec3 e : irradiance())
        ASSERT_TRUE(std::isfinite(e.x) && std::isfinite(e.y) && std::isfinite(e.z));
    lit->scene.lights.clear();
    lit->update();
    update();
    EXPECT_LT(difference().largest, kRounding);
    prepare({.assets = std::make_shared<Assets>()});
    EXPECT_TRUE(update().skipped);
    EXPECT_EQ(light->snapshot(), nullptr);
}

TEST_F(DeviceProbesTest, RefuseADeviceThatBindsTooFewBuffers) {
    device->properties.limits.maxPerStageDescriptorStorageBuffers = 9;
    const auto refused = DeviceProbes::create(*device, *viewport);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("9 storage buffers"), std::string::npos);
}

TEST_F(DeviceProbesTest, TheViewportShowsThemAsItShowsThoseOfTheCpu) {
    for (const double smooth : {0, 1}) {
        prepare(litCorner(false), {{"probes.smooth", smooth}});
        lit->update();
        update();
        options.camera = {.eye = {7, 5, 9}, .target = {1.5f, 1, 1.5f}, .fovY = 0.7f};
        options.view = View::Irradiance;
        viewport->render(options);
        const ImageF shown = viewport->readLinear();
        viewport->setIndirect(*lit->lighting->field());
        viewport->render(options);
        const ImageF expected = viewport->readLinear();
        float largest = 0;
        for (const glm::vec3 c : expected.rgb)
            largest = std::max(largest, c.x);
        EXPECT_GT(largest, 0.1f);
        for (std::size_t i = 0; i < shown.rgb.size(); ++i)
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(shown.rgb[i][c], expected.rgb[i][c], 4 * kHalf * largest) << i;
    }
}

TEST_F(DeviceProbesTest, TheirOverlaysShowTheLightOfTheDevice) {
    prepare(litCorner(false));
    lit->update();
    update();
    const auto mine = light->snapshot(), expected = lit->lighting->snapshot();
    ASSERT_NE(mine, nullptr);
    EXPECT_EQ(mine->pickCount(), light->maps().grid.count());
    const auto lines = mine->describePick(lit->scene, 5),
               ofCpu = expected->describePick(lit->scene, 5);
    ASSERT_EQ(lines.size(), ofCpu.size());
    for (std::size_t k = 0; k < lines.size(); ++k)
        EXPECT_EQ(lines[k].text, ofCpu[k].text);
}

} // namespace
} // namespace limn::device_probes_test
