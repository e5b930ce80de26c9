// SPDX-License-Identifier: MIT
#include "engine/techniques/photon_lattices/gpu/device_photons.h"

#include "engine/scene/light/unit_light.h"
#include "tests/render/viewport_fixture.h"
#include "tests/techniques/photon_lattices/lit_by_photons.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>

namespace limn::device_photons_test {
namespace {

/// A room with a block and a mirrored ball of metal, a pane of glass, and a lamp of the kind.
Scene room(LightKind kind) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert({0.7f, 0.5f, 0.3f}));
    b.addMaterial(mirror({0.9f, 0.8f, 0.5f}));
    b.scene.materials[1].roughness = 0.3f;
    Material glass = simple::lambert({0.8f, 0.9f, 1});
    glass.transmission = 1;
    glass.roughness = 0;
    glass.ior = 1.4f;
    glass.thickness = 1;
    b.addMaterial(glass);
    if (kind == LightKind::Directional) // a roof would keep its light out
        b.add(simple::quad(glm::vec3(0), {0, 0, 5}, {4, 0, 0}));
    else
        b.add(simple::box(glm::vec3(0), glm::vec3(4, 3, 5), true));
    b.add(simple::box({1, 0, 1}, {1.8f, 1.2f, 1.6f}, false, 1));
    b.add(simple::box({0.3f, 1.7f, 2.4f}, {1.9f, 1.8f, 4.2f}, false, 2));
    const glm::mat4 mirrored(glm::vec4(-1, 0, 0, 0), glm::vec4(0, 0.8f, 0.2f, 0),
                             glm::vec4(0, -0.2f, 1.1f, 0), glm::vec4(3.2f, 0.6f, 3.9f, 1));
    b.add(simple::sphere(0.5f, 3, false, 1), mirrored);
    b.scene.lights = {{.name = "Lamp",
                       .kind = kind,
                       .position = {2.8137f, 2.4821f, 3.0219f},
                       .direction = glm::normalize(glm::vec3(-0.3f, -1, -0.2f)),
                       .color = {1, 0.6f, 0.2f},
                       .strength = 6,
                       .size = {0.7f, 0.4f}}};
    return b.build();
}

class DevicePhotonsTest : public ViewportTest {
protected:
    void TearDown() override {
        lighting.reset();
        ViewportTest::TearDown();
    }
    void light(const Scene& with, const PhotonChoice& choice = {}) {
        scene = with;
        scene.technique = photonChoice(choice);
        layout = std::make_shared<LightmapLayout>(layoutWithoutLightmap(scene));
        lighting = std::make_unique<DevicePhotons>(*device, *viewport);
    }
    LightingReport update(const Progress& progress = {}) {
        viewport->setScene(scene, layout);
        return lighting->update({.scene = scene}, progress);
    }

    Scene scene;
    std::unique_ptr<DevicePhotons> lighting;
};

/// What becomes of photons, by texel.
struct Bounces {
    std::size_t same = 0, all = 0;
    std::array<std::size_t, 4> events{};      ///< of those alike: absorbed, and by PhotonEvent
    double largestPower = 0, largestTurn = 0; ///< difference where the event is the same
};

/// Photons of the scene's light that bounce on the device beside those of the CPU.
Bounces bouncesOf(gpu::Device& device, Viewport& viewport, const Scene& scene) {
    const Light shape = unitLight(scene.lights[0]);
    const std::uint32_t side = photonMapSide(shape, scene.bounds, 6000);
    GpuBounces gpu(device, viewport);
    const auto bounces = gpu.bounce(scene, shape, side);
    Bounces found;
    EXPECT_TRUE(bounces);
    if (!bounces)
        return found;
    const TraceScene trace(scene);
    const PhotonScene photons{trace, scene, {.photons = 6000, .bounces = 1, .specular = 8}};
    const std::vector<PathStart> starts = lightStarts(photons, shape, {});
    float brightest = 0;
    for (const PathStart& start : starts)
        brightest = std::max(brightest, start.flight.power.x);
    for (const PathStart& start : starts) {
        const shared::GpuBounce& bounce = bounces->at(start.sample);
        ++found.all;
        const auto scattered = scatter(*start.surface, start.flight.direction, start.flight.power,
                                       {0, start.sample}, kStartPairs);
        const std::uint32_t event = scattered ? std::uint32_t(scattered->event) : 0;
        const bool narrow = scattered && scattered->narrow;
        if (!(bounce.incident > 0) || (bounce.event & PHOTON_EVENTS) != event ||
            ((bounce.event & PHOTON_NARROW) != 0) != narrow || bounce.instance != start.instance)
            continue;
        ++found.same;
        ++found.events[event];
        EXPECT_NEAR(bounce.incident, start.flight.power.x, 1e-5f * brightest);
        EXPECT_LT(glm::distance(bounce.position, start.surface->position), 2e-4f);
        if (!scattered)
            continue;
        found.largestPower = std::max(
            found.largestPower, double(glm::distance(bounce.power, scattered->power) / brightest));
        found.largestTurn = std::max(found.largestTurn,
                                     double(glm::distance(bounce.direction, scattered->direction)));
    }
    std::printf("%zu of %zu photons alike, power to %.1e, direction to %.1e\n", found.same,
                found.all, found.largestPower, found.largestTurn);
    EXPECT_GT(found.all, 2000U);
    return found;
}

// Shadow maps that a device draws hold the texels of rays but for edges. With the same random
// numbers, nearly all photons bounce as on the CPU.
TEST_F(DevicePhotonsTest, BouncesPhotonsAsTheCpuDoes) {
    for (const LightKind kind :
         {LightKind::Directional, LightKind::Point, LightKind::Spot, LightKind::Rectangle}) {
        light(room(kind));
        viewport->setScene(scene, layout);
        const Bounces found = bouncesOf(*device, *viewport, scene);
        for (const std::size_t count : found.events)
            EXPECT_GT(count, 20U);
        EXPECT_GT(double(found.same), 0.998 * double(found.all));
        // Colours and normals have 16 bits.
        EXPECT_LT(found.largestPower, 1e-4);
        EXPECT_LT(found.largestTurn, 1e-3);
    }
}

// Texels of the texture are large beside those of the map, so that the device samples no mipmap.
TEST_F(DevicePhotonsTest, BouncesPhotonsOfTexturedSurfacesAsTheCpuDoes) {
    constexpr std::uint32_t kSize = 4;
    Scene textured = room(LightKind::Point);
    Assets assets = *textured.assets;
    Image colours{.name = "colours", .width = kSize, .height = kSize, .rgba = {}};
    Image metal{.name = "metal", .width = kSize, .height = kSize, .rgba = {}};
    for (std::uint32_t i = 0; i < kSize * kSize; ++i) {
        const auto step = [&](std::uint32_t k) { return std::uint8_t(60 + 190 * (i * k % 7) / 6); };
        colours.rgba.insert(colours.rgba.end(), {step(1), step(2), step(3), 255});
        // Green is roughness, blue is metallic.
        metal.rgba.insert(metal.rgba.end(), {0, step(5), std::uint8_t(i % 2 ? 230 : 20), 255});
    }
    assets.images = {colours, metal};
    assets.meshes.push_back(simple::quad({0.1f, 0.05f, 0.1f}, {0, 0, 4.8f}, {3.8f, 0, 0}));
    Material floor = simple::lambert({0.9f, 0.9f, 0.9f});
    floor.metallic = 1;
    floor.baseColorTexture.image = 0;
    floor.metallicRoughnessTexture.image = 1;
    textured.instances.push_back(textured.instances[0]);
    textured.instances.back().mesh = std::uint32_t(assets.meshes.size() - 1);
    textured.instances.back().material = std::uint32_t(textured.materials.size());
    textured.instances.back().toWorld = glm::mat4(1);
    textured.materials.push_back(floor);
    textured.assets = std::make_shared<const Assets>(std::move(assets));
    light(textured);
    viewport->setScene(scene, layout);
    const Bounces found = bouncesOf(*device, *viewport, scene);
    EXPECT_GT(double(found.same), 0.99 * double(found.all));
    // Devices weight texels in steps of 1/256, which a rough metal's directions show most.
    EXPECT_LT(found.largestPower, 0.01);
    EXPECT_LT(found.largestTurn, 0.05);
}

TEST_F(DevicePhotonsTest, LightsAsTheCpuDoes) {
    for (const LightKind kind : {LightKind::Point, LightKind::Rectangle}) {
        light(room(kind), {{"high", 32}});
        const LightingReport report = update();
        EXPECT_TRUE(report.converged && report.whole && !report.skipped);
        LitByPhotons cpu(scene);
        cpu.scene.technique = scene.technique;
        cpu.update();
        const IndirectField field = lighting->readField();
        double squares = 0, mean = 0;
        std::size_t count = 0;
        for (float x = 0.1f; x < 4; x += 0.35f)
            for (float z = 0.1f; z < 5; z += 0.35f)
                for (const float y : {0.f, 3.f}) {
                    const glm::vec3 n(0, y > 0 ? -1 : 1, 0);
                    FieldPoint point = cpu.at({x, y, z}, n);
                    const glm::vec3 expected = sampleIrradiance(point);
                    const FieldPoint mine{field, *layout, scene, 0, 0, 0, 0, {x, y, z}, n};
                    const double difference = double((sampleIrradiance(mine) - expected).x);
                    squares += difference * difference;
                    mean += double(expected.x);
                    ++count;
                }
        mean /= double(count);
        std::printf("kind %d: rms difference %.1e of the mean\n", int(kind),
                    std::sqrt(squares / double(count)) / mean);
        // Of a cell's photons, of which there are some hundreds, hardly any differs.
        EXPECT_LT(std::sqrt(squares / double(count)), 0.01 * mean);
    }
}

TEST_F(DevicePhotonsTest, HasTheSameBitsEachTimeAndDispatchesNothingAtRest) {
    light(room(LightKind::Point));
    const LightingReport first = update();
    EXPECT_EQ(counterOf(first, "map_views"), 6);
    EXPECT_EQ(counterOf(first, "dispatches"), 6);
    EXPECT_GT(counterOf(first, "bytes_uploaded"), 0);
    const PhotonParts before = lighting->readField().parts;
    const std::uint64_t submitted = device->submitted();
    const LightingReport idle = lighting->update({.scene = scene}, {});
    EXPECT_TRUE(idle.skipped && idle.converged && idle.whole);
    EXPECT_EQ(counterOf(idle, "dispatches") + counterOf(idle, "bytes_uploaded"), 0);
    EXPECT_EQ(device->submitted(), submitted);
    scene.lights[0].color = {0, 1, 0};
    const LightingReport recoloured = update();
    EXPECT_EQ(counterOf(recoloured, "map_views"), 0) << "a colour draws nothing";
    EXPECT_GT(counterOf(recoloured, "bytes_uploaded"), 0);
    EXPECT_FALSE(samePartsOf(lighting->readField().parts, before));
    scene.lights[0].color = {1, 0.6f, 0.2f};
    lighting = std::make_unique<DevicePhotons>(*device, *viewport);
    update();
    EXPECT_TRUE(samePartsOf(lighting->readField().parts, before));
    scene.lights[0].position.x -= 0.5f;
    const std::atomic<bool> cancel = true;
    const LightingReport cancelled = update({.report = {}, .cancel = &cancel});
    EXPECT_FALSE(cancelled.converged || cancelled.whole);
    EXPECT_TRUE(samePartsOf(lighting->readField().parts, before));
    scene.instances[1].toWorld[3].z += 1.f;
    EXPECT_EQ(counterOf(update(), "map_views"), 6) << "an object moved";
}

} // namespace
} // namespace limn::device_photons_test
