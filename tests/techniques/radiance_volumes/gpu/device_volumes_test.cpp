// SPDX-License-Identifier: MIT
#include "engine/techniques/radiance_volumes/gpu/device_volumes.h"

#include "engine/shading/pixel_rays.h"
#include "tests/render/viewport_fixture.h"
#include "tests/techniques/lights_of_each_kind.h"
#include "tests/techniques/radiance_volumes/lit_by_volumes.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <tuple>
#include <utility>

namespace limn::device_volumes_test {
namespace {

constexpr const char* kNames[] = {"sun", "point", "spot", "rectangle"};

/// A room with a block, open to a sun.
Scene room(LightKind kind) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert({0.7f, 0.5f, 0.3f}));
    b.addMaterial(simple::lambert({0.2f, 0.4f, 0.8f}));
    b.add(simple::box(glm::vec3(0), glm::vec3(4, 3, 5), kind != LightKind::Directional));
    b.add(simple::box({1, 0, 1}, {1.8f, 1.2f, 1.6f}, false, 1));
    if (kind == LightKind::Directional)
        b.add(simple::quad({-2, 0, -2}, {0, 0, 9}, {8, 0, 0}));
    Light light = lightOf(kind);
    light.position = {2.8137f, 2.4821f, 3.0219f};
    b.scene.lights = {light};
    b.scene.technique.settings = {{"radiance-volumes.read", 16},
                                  {"radiance-volumes.map", 64},
                                  {"radiance-volumes.voxels", 32},
                                  {"radiance-volumes.caches", 500}};
    return b.build();
}

Viewpoint view() {
    return viewpointOf({.eye = {3.3f, 1.7f, 4.4f}, .target = {1, 0.4f, 1.3f}}, {64, 48});
}

class DeviceVolumesTest : public ViewportTest {
protected:
    void TearDown() override {
        lighting.reset();
        ViewportTest::TearDown();
    }
    /// Starts anew with a scene.
    void light(const Scene& with) {
        scene = with;
        layout = std::make_shared<LightmapLayout>(layoutWithoutLightmap(scene));
        viewport->setScene(scene, layout);
        lighting = std::make_unique<DeviceVolumes>(*device, *viewport);
    }
    LightingReport update(const Viewpoint* shown = nullptr, const Progress& progress = {}) {
        viewport->setScene(scene, layout);
        return lighting->update({.scene = scene, .view = shown}, progress);
    }
    void set(const char* key, double value) {
        scene.technique.settings[std::string("radiance-volumes.") + key] = value;
    }
    IndirectField field() const { return lighting->readField(); }
    static const VolumePart& partOf(const IndirectField& field) {
        return static_cast<const VolumePart&>(*field.parts[0]);
    }

    Scene scene;
    std::unique_ptr<DeviceVolumes> lighting;
};

/// Largest and root mean square difference of two caches' lights, as shares of the largest value.
struct Difference {
    double worst = 0, rms = 0;
};
Difference differenceOf(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
    Difference d;
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double x = std::abs(double(a[i][c]) - double(b[i][c]));
            d.worst = std::max(d.worst, x);
            d.rms += x * x;
            largest = std::max(largest, std::abs(double(b[i][c])));
        }
    EXPECT_GT(largest, 0);
    return {d.worst / largest, std::sqrt(d.rms / double(3 * a.size())) / largest};
}

// Without a view, both have the same caches.
TEST_F(DeviceVolumesTest, LightsCachesAsTheCpuDoesByEachKindOfLight) {
    for (const LightKind kind : kLightKinds)
        for (const int shadow : {0, 1, 2}) {
            if (kind != LightKind::Point && shadow != 1)
                continue; // cones do not know of kinds
            Scene lit = room(kind);
            lit.technique.settings["radiance-volumes.shadow"] = shadow;
            lit.technique.settings["radiance-volumes.bands"] = shadow == 1 ? 3 : 2;
            LitByVolumes cpu(lit);
            cpu.update();
            light(lit);
            update();
            const IndirectField onDevice = field();
            ASSERT_EQ(partOf(onDevice).caches->address, cpu.part().caches->address);
            const Difference d =
                differenceOf(partOf(onDevice).light.harmonics, cpu.part().light.harmonics);
            std::printf("%-9s shadow %d: caches differ by %.2g of the largest at most, %.2g rms\n",
                        kNames[int(kind)], shadow, d.worst, d.rms);
            EXPECT_LT(d.worst, 0.02);
            EXPECT_LT(d.rms, 1e-3);
        }
}

TEST_F(DeviceVolumesTest, LetsVoxelsFadeAsTheCpuDoes) {
    Scene lit = room(LightKind::Point);
    lit.technique.settings["radiance-volumes.rate"] = 0.3;
    LitByVolumes cpu(lit);
    cpu.update();
    light(lit);
    EXPECT_TRUE(update().converged);
    scene.instances[1].toWorld[3].z += 1.f;
    cpu.scene = scene;
    cpu.retrace();
    for (int k = 0; k < 4; ++k) { // by 77 of 255 each
        EXPECT_EQ(update().converged, k == 3);
        EXPECT_EQ(cpu.update().converged, k == 3);
        const IndirectField onDevice = field();
        const Difference d =
            differenceOf(partOf(onDevice).light.harmonics, cpu.part().light.harmonics);
        EXPECT_LT(d.worst, 0.02);
        EXPECT_LT(d.rms, 1e-3);
    }
    EXPECT_TRUE(update().skipped);
    const std::vector<glm::vec3> arrived = partOf(field()).light.harmonics;
    light(Scene(scene));
    update();
    EXPECT_EQ(partOf(field()).light.harmonics, arrived);
}

TEST_F(DeviceVolumesTest, PlacesCachesByWhatTheViewShows) {
    const Viewpoint v = view();
    const Scene lit = room(LightKind::Point);
    LitByVolumes cpu(lit);
    cpu.set("caches", 4096);
    cpu.update(&v);
    light(cpu.scene);
    const LightingReport report = update(&v);
    const IndirectField onDevice = field();
    const CacheAllocation& mine = *partOf(onDevice).caches;
    const CacheAllocation& expected = *cpu.part().caches;
    EXPECT_EQ(mine.grids, expected.grids);
    std::size_t differing = 0, off = 0;
    double places = 0;
    for (std::size_t i = 0; i < mine.address.size(); ++i) {
        const std::uint32_t a = mine.address[i], b = expected.address[i];
        differing += (a == kNoCache) != (b == kNoCache) ? 1 : 0;
        if (a == kNoCache || b == kNoCache)
            continue;
        EXPECT_EQ(mine.places[a].position, expected.places[b].position);
        const float d = glm::distance(mine.places[a].normal, expected.places[b].normal) +
                        glm::distance(mine.places[a].shift, expected.places[b].shift) +
                        std::abs(mine.places[a].height - expected.places[b].height);
        places += double(d);
        off += d > 1e-2f ? 1 : 0;
    }
    std::printf("%zu of %zu nodes differ; %zu places do, by %.2g on average\n", differing,
                expected.caches(), off, places / double(expected.caches()));
    EXPECT_LT(differing, expected.caches() / 100);
    EXPECT_LT(off, expected.caches() / 20);
    EXPECT_EQ(counterOf(report, "caches"), double(mine.caches()));

    // Irradiance where the view looks.
    const PixelRays rays(v.camera, v.size.x, v.size.y);
    double worst = 0, largest = 0;
    for (std::uint32_t i = 0; i < v.size.x * v.size.y; ++i) {
        const Hit hit =
            cpu.trace->closestHit(rays.through(glm::vec2(i % v.size.x, i / v.size.x) + 0.5f));
        const glm::vec3 n = hit.geometricNormal * (hit.frontFace ? 1.f : -1.f);
        FieldPoint p = cpu.point(hit.position, n);
        const glm::vec3 e = sampleIrradiance(p);
        const FieldPoint q{.field = onDevice,
                           .layout = cpu.layout,
                           .scene = cpu.scene,
                           .instance = 0,
                           .triangle = 0,
                           .u = 0.3f,
                           .v = 0.3f,
                           .position = hit.position,
                           .normal = n};
        worst = std::max(worst, double(glm::distance(sampleIrradiance(q), e)));
        largest = std::max(largest, double(glm::length(e)));
    }
    std::printf("irradiance differs by %.2g of the largest at most\n", worst / largest);
    EXPECT_LT(worst, 0.02 * largest);
}

// Two lights, so that the second adds to the first's maps.
TEST_F(DeviceVolumesTest, CountsPixelsWithoutCaches) {
    const Viewpoint v = view();
    Scene lit = room(LightKind::Point);
    for (const int caches : {4096, 150, 30}) {
        lit.technique.settings["radiance-volumes.caches"] = caches;
        LitByVolumes cpu(lit);
        const double expected = counterOf(cpu.update(&v), "pixels_missed");
        light(lit);
        const double missed = counterOf(update(&v), "pixels_missed");
        std::printf("%d caches: %g of 3072 pixels find none, on the CPU %g\n", caches, missed,
                    expected);
        EXPECT_EQ(missed > 0, caches < 4096);
        EXPECT_NEAR(missed, expected, 5);
    }
}

TEST_F(DeviceVolumesTest, MakesMapsForReflectionsAsTheCpuDoes) {
    const Viewpoint v = view();
    Scene lit = room(LightKind::Point);
    lit.lights.push_back(lit.lights[0]);
    lit.lights[1].position = {0.7231f, 1.8123f, 3.9137f};
    lit.technique.settings["radiance-volumes.caches"] = 200;
    for (const auto& [glossy, tile, fill] : {std::tuple(1, 16, 0), std::tuple(2, 32, 5)}) {
        lit.technique.settings["radiance-volumes.glossy"] = glossy;
        lit.technique.settings["radiance-volumes.tile"] = tile;
        lit.technique.settings["radiance-volumes.fill"] = fill;
        LitByVolumes cpu(lit);
        cpu.update(&v);
        light(lit);
        const LightingReport report = update(&v);
        EXPECT_EQ(report.lacks, nullptr);
        const IndirectField onDevice = field();
        const auto& mine = partOf(onDevice).light.glossy;
        const auto& expected = cpu.part().light.glossy;
        ASSERT_EQ(mine.size(), expected.size());
        // Light that falls next to the edge of a texel adds to either.
        glm::dvec3 sum(0), truth(0);
        std::size_t off = 0;
        double largest = 0;
        for (const glm::vec3 t : expected)
            largest = std::max(largest, double(t.x));
        for (std::size_t i = 0; i < mine.size(); ++i) {
            sum += glm::dvec3(mine[i]);
            truth += glm::dvec3(expected[i]);
            off += std::abs(double(mine[i].x - expected[i].x)) > 1e-4 * largest ? 1 : 0;
        }
        std::printf("tile %d, fill %d: %zu of %zu texels differ, sums by %.2g\n", tile, fill, off,
                    mine.size(), std::abs(sum.x / truth.x - 1));
        EXPECT_GT(truth.x, 0);
        EXPECT_NEAR(sum.x, truth.x, 1e-3 * truth.x);
        EXPECT_LT(double(off), 2e-3 * double(mine.size()));
    }
}

TEST_F(DeviceVolumesTest, ShowsItsLightWhereItWasWritten) {
    const Viewpoint v = view();
    light(room(LightKind::Point));
    set("caches", 4096);
    update(&v);
    options.camera = v.camera;
    options.width = v.size.x;
    options.height = v.size.y;
    viewport->setLighting(scene);
    const ImageF written = draw(scene, View::Irradiance);
    viewport->setIndirect(field(), uploadVolumePart(*device, *viewport, field()));
    const ImageF uploaded = draw(scene, View::Irradiance);
    EXPECT_EQ(written.rgb, uploaded.rgb);
    EXPECT_GT(written.rgb[v.size.x * v.size.y / 2].x, 0);
}

TEST_F(DeviceVolumesTest, DoesOnlyWhatChangedAndRepeatsItsBits) {
    const Viewpoint v = view();
    light(room(LightKind::Point));
    set("caches", 4096);
    const LightingReport first = update(&v);
    EXPECT_EQ(counterOf(first, "views"), 6);
    // A map and its blocks for each view, the nodes, and the caches.
    EXPECT_EQ(counterOf(first, "dispatches"), 2 * 6 + 1 + 1);
    EXPECT_GT(counterOf(first, "bytes"), 0);
    const LightingReport same = update(&v);
    EXPECT_TRUE(same.skipped);
    EXPECT_EQ(counterOf(same, "dispatches"), 0);
    const std::vector<glm::vec3> before = partOf(field()).light.harmonics;
    scene.lights[0].strength *= 2;
    const LightingReport colour = update(&v);
    EXPECT_EQ(counterOf(colour, "views"), 0);
    EXPECT_EQ(counterOf(colour, "dispatches"), 1);
    const std::vector<glm::vec3> twice = partOf(field()).light.harmonics;
    for (std::size_t i = 0; i < before.size(); ++i)
        EXPECT_EQ(twice[i], 2.f * before[i]);
    Viewpoint there = v;
    there.camera.target = {4, 1, 0};
    EXPECT_EQ(counterOf(update(&there), "views"), 0);
    update(&v);
    EXPECT_EQ(partOf(field()).light.harmonics, twice);
    scene.lights.clear();
    update(&v);
    const IndirectField dark = field();
    for (const glm::vec3 c : partOf(dark).light.harmonics)
        EXPECT_EQ(c, glm::vec3(0));
}

TEST_F(DeviceVolumesTest, ReadsTheSurfacesOfThePictureThatFollows) {
    const Viewpoint v = view();
    light(room(LightKind::Point));
    options = {.view = View::Lit, .camera = v.camera, .width = v.size.x, .height = v.size.y};
    for (const std::uint64_t drawn : {1U, 2U}) {
        update(&v);
        viewport->render(options);
        EXPECT_EQ(viewport->stats().geometryDrawn, drawn);
        scene.instances[0].toWorld[3].x += 0.1f;
    }
}

TEST_F(DeviceVolumesTest, KeepsItsLightWhenCancelledAndCatchesUp) {
    light(room(LightKind::Spot));
    update();
    const std::vector<glm::vec3> before = partOf(field()).light.harmonics;
    scene.lights[0].position.x -= 0.5f;
    const std::atomic<bool> cancel = true;
    const LightingReport report = update(nullptr, {.report = {}, .cancel = &cancel});
    EXPECT_FALSE(report.converged || report.whole || report.skipped);
    EXPECT_EQ(partOf(field()).light.harmonics, before);
    EXPECT_TRUE(update().converged);
    EXPECT_NE(partOf(field()).light.harmonics, before);
    EXPECT_TRUE(lighting->snapshot());
}

} // namespace
} // namespace limn::device_volumes_test
