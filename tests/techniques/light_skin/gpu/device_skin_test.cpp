// SPDX-License-Identifier: MIT
#include "engine/techniques/light_skin/gpu/device_skin.h"

#include "engine/scene/light/unit_light.h"
#include "engine/techniques/light_skin/light_skin.h"
#include "tests/render/viewport_fixture.h"
#include "tests/techniques/light_skin/gpu/glossy_room.h"
#include "tests/techniques/light_skin/lit_by_skin.h"
#include "tests/techniques/lights_of_each_kind.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>

namespace limn::device_skin_test {
namespace {

class DeviceSkinTest : public ViewportTest {
protected:
    DeviceSkinTest() {
        options.camera = {.eye = {3.6f, 1.9f, 4.7f}, .target = {1.5f, 0.8f, 1.5f}, .fovY = 1};
        options.width = 96;
        options.height = 72;
    }
    Viewpoint view() const { return viewpointOf(options.camera, {options.width, options.height}); }
    std::unique_ptr<DeviceSkin> light() {
        return std::move(*DeviceSkin::create(*device, *viewport));
    }
    void show(const Scene& scene) {
        viewport->setScene(scene,
                           std::make_shared<const LightmapLayout>(layoutWithoutLightmap(scene)));
    }
    LightingReport update(DeviceSkin& skin, const Scene& scene, const Viewpoint* of) {
        return skin.update({.scene = scene, .view = of}, {});
    }
};

/// Largest difference of both, and their rms difference, as shares of the largest value.
struct Difference {
    double largest = 0, rms = 0;
};
Difference differenceOf(std::span<const glm::vec3> a, std::span<const glm::vec3> b) {
    double highest = 0, squares = 0;
    Difference found;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const glm::dvec3 d = glm::abs(glm::dvec3(a[i]) - glm::dvec3(b[i]));
        highest = std::max(highest, double(std::max({b[i].x, b[i].y, b[i].z})));
        found.largest = std::max({found.largest, d.x, d.y, d.z});
        squares += glm::dot(d, d) / (3 * double(a.size()));
    }
    return {found.largest / highest, std::sqrt(squares) / highest};
}

/// Mean ways to what caches receive.
std::vector<glm::vec3> waysOf(const std::vector<CacheSums>& sums) {
    std::vector<glm::vec3> all;
    for (const CacheSums& s : sums)
        all.push_back(s.diffuse.first / s.diffuse.weight);
    return all;
}

/// What caches receive, diffuse or glossy.
std::vector<glm::vec3> lightOf(const std::vector<CacheSums>& sums, bool glossy) {
    std::vector<glm::vec3> all;
    for (const CacheSums& s : sums)
        all.push_back(glossy ? s.glossy.light : s.diffuse.light);
    return all;
}

TEST_F(DeviceSkinTest, FindsTheSamplesOfTheCpu) {
    const Scene scene = glossyRoom();
    show(scene);
    auto lights = std::move(*GpuSkinLights::create(*device, *viewport));
    const Viewpoint of = view();
    lights->findSamples(of, scene.bounds, 200);
    const ViewSamples found = lights->readSamples(),
                      expected = samplesOfView(TraceScene(scene), scene, of, 200);
    ASSERT_EQ(found.size(), expected.size());
    std::size_t off = 0;
    for (std::size_t i = 0; i < found.size(); ++i)
        off += glm::distance(found.position[i], expected.position[i]) < 1e-3f &&
                       glm::dot(found.normal[i], expected.normal[i]) > 0.999f
                   ? 0
                   : 1;
    EXPECT_LE(off, 2U) << "pixels on edges";
}

TEST_F(DeviceSkinTest, SeesTheCachesThatTheCpuSees) {
    const Scene scene = glossyRoom();
    show(scene);
    auto lights = std::move(*GpuSkinLights::create(*device, *viewport));
    MeshSkins skins;
    const LightCaches caches = skins.place(scene, {0.04f, 0.5f, false});
    const Viewpoint shown = view();
    lights->findSeenCaches(caches, shown, scene.bounds);
    const ViewSamples found = lights->readSamples(),
                      expected =
                          seenCaches(TraceScene(scene), scene, cachesInView(caches, shown), shown);
    EXPECT_GT(expected.size(), 100U);
    EXPECT_LT(expected.size(), cachesInView(caches, shown).size());
    std::size_t both = 0;
    for (const glm::vec3 p : expected.position)
        both += std::ranges::count(found.position, p);
    std::printf("%zu caches seen, %zu by the CPU, %zu by both\n", found.size(), expected.size(),
                both);
    EXPECT_LE(found.size() - both + expected.size() - both, expected.size() / 100) << "on outlines";
    // None where the view shows none.
    Viewpoint away = shown;
    away.camera.eye = {100, 100, 100};
    away.camera.target = {200, 200, 200};
    lights->findSeenCaches(caches, away, scene.bounds);
    EXPECT_EQ(lights->readSamples().size(), 0U);
}

// Texels on edges of objects may fall to either side.
TEST_F(DeviceSkinTest, GathersWhatTheCpuGathersOfAllTexels) {
    const Scene scene = glossyRoom(true);
    show(scene);
    const TraceScene trace(scene);
    auto lit = std::move(*GpuSkinLights::create(*device, *viewport));
    MeshSkins skins;
    const LightCaches caches = skins.place(scene, {0.05f, 0.5f, false});
    const std::vector<float> exponents = glossExponents(scene, caches);
    lit->setCaches(caches, exponents);
    const glm::vec3 eye = options.camera.eye;
    for (const LightKind kind : kLightKinds) {
        Light lamp = limn::lightOf(kind);
        lamp.position = {2.2f, 2.2f, 3.1f};
        const Light unit = unitLight(lamp);
        const VirtualLights lights = castVirtualLights(trace, scene, unit, 32);
        std::vector<CacheSums> expected, found;
        gatherLights(caches, exponents, gatheringLights(lights, allLights(lights), 1), &eye,
                     expected);
        const MappedLights mapped = lit->cast(unit, scene.bounds, 32);
        ASSERT_TRUE(lit->gather(mapped, {.all = true, .eye = &eye}, found));
        EXPECT_LT(differenceOf(waysOf(found), waysOf(expected)).rms, 2e-3);
        for (const bool glossy : {false, true}) {
            const Difference d = differenceOf(lightOf(found, glossy), lightOf(expected, glossy));
            std::printf("light %d, %s: largest difference %.2e, rms %.2e\n", int(kind),
                        glossy ? "glossy" : "diffuse", d.largest, d.rms);
            EXPECT_LT(d.rms, 2e-3);
            EXPECT_LT(d.largest, 0.05);
        }
    }
}

// Rounding of sums may choose the texel beside one.
TEST_F(DeviceSkinTest, ChoosesTheTexelsOfTheCpu) {
    const Scene scene = glossyRoom(true);
    show(scene);
    const TraceScene trace(scene);
    auto onDevice = std::move(*GpuSkinLights::create(*device, *viewport));
    MeshSkins skins;
    const LightCaches caches = skins.place(scene, {0.05f, 0.5f, false});
    onDevice->setCaches(caches, {});
    const ViewSamples samples = samplesOfSurfaces(scene, 100);
    onDevice->setSamples(samples);
    for (const LightKind kind : kLightKinds) {
        Light lamp = limn::lightOf(kind);
        lamp.position = {2.2f, 2.2f, 3.1f};
        const Light unit = unitLight(lamp);
        const VirtualLights lights = castVirtualLights(trace, scene, unit, 64);
        const ChosenLights chosen =
            chooseLights(lights, importances(lights, samples, 0.2f), {.count = 300});
        std::vector<CacheSums> expected, found;
        gatherLights(caches, {}, gatheringLights(lights, chosen, 1), nullptr, expected);
        const MappedLights mapped = onDevice->cast(unit, scene.bounds, 64);
        ASSERT_TRUE(onDevice->gather(mapped, {.count = 300, .nearest = 0.2f}, found));
        const Difference d = differenceOf(lightOf(found, false), lightOf(expected, false));
        std::printf("light %d, chosen: largest difference %.2e, rms %.2e\n", int(kind), d.largest,
                    d.rms);
        EXPECT_LT(d.rms, 5e-3);
    }
}

// Chosen texels stand for the sum of all.
TEST_F(DeviceSkinTest, ChoosesTexelsThatStandForAll) {
    const Scene scene = glossyRoom();
    show(scene);
    auto lights = std::move(*GpuSkinLights::create(*device, *viewport));
    MeshSkins skins;
    const LightCaches caches = skins.place(scene, {0.05f, 0.5f, false});
    lights->setCaches(caches, {});
    const Viewpoint of = view();
    lights->findSamples(of, scene.bounds, 64);
    const MappedLights mapped = lights->cast(unitLight(scene.lights[0]), scene.bounds, 96);
    std::vector<CacheSums> all, some;
    ASSERT_TRUE(lights->gather(mapped, {.all = true}, all));
    double before = 1;
    for (const std::uint32_t count : {256U, 2048U, 8192U}) {
        ASSERT_TRUE(lights->gather(mapped, {.count = count, .nearest = 0.2f}, some));
        double sum = 0, of_all = 0;
        for (std::size_t c = 0; c < all.size(); ++c) {
            sum += double(some[c].diffuse.light.x);
            of_all += double(all[c].diffuse.light.x);
        }
        const Difference d = differenceOf(lightOf(some, false), lightOf(all, false));
        std::printf("%u of %u: sum %+.3f %%, rms difference %.2e\n", count, mapped.count(),
                    100 * (sum / of_all - 1), d.rms);
        EXPECT_NEAR(sum / of_all, 1, 0.05);
        EXPECT_LT(d.rms, 0.7 * before);
        before = d.rms;
    }
    // By flux alone, and where no sample sees anything.
    ASSERT_TRUE(lights->gather(mapped, {.count = 2048, .defence = 1}, some));
    EXPECT_LT(differenceOf(lightOf(some, false), lightOf(all, false)).rms, 0.02);
    lights->setSamples({});
    ASSERT_TRUE(lights->gather(mapped, {.count = 2048, .defence = 0.1f}, some));
    EXPECT_LT(differenceOf(lightOf(some, false), lightOf(all, false)).rms, 0.02);
    ASSERT_TRUE(lights->gather(mapped, {.count = 2048, .defence = 0}, some));
    for (const CacheSums& s : some)
        EXPECT_EQ(s.diffuse.light, glm::vec3(0));
}

TEST_F(DeviceSkinTest, DrawsTheLightOfTheCpu) {
    Scene scene = glossyRoom();
    scene.technique.settings["light-skin.all"] = 1;
    show(scene);
    const Viewpoint of = view();
    const auto skin = light();
    update(*skin, scene, &of);
    options.view = View::Irradiance;
    viewport->render(options);
    const ImageF mine = viewport->readLinear();
    LitBySkin lit(scene);
    lit.update(&of);
    viewport->setIndirect(*lit.lighting->field(),
                          uploadSkinPart(*device, *viewport, *lit.lighting->field()));
    viewport->render(options);
    const Difference d = differenceOf(mine.rgb, viewport->readLinear().rgb);
    std::printf("picture: largest difference %.2e, rms %.2e\n", d.largest, d.rms);
    EXPECT_LT(d.rms, 2e-3);
    EXPECT_EQ(skin->field(), nullptr);
    EXPECT_TRUE(skin->isOfView());
    const IndirectField read = skin->readField();
    ASSERT_EQ(read.parts.size(), 1U);
    ASSERT_TRUE(skin->snapshot());
}

TEST_F(DeviceSkinTest, RenewsAPartOfTheDrawsUntilAllAreThoseOfTheView) {
    Scene scene = glossyRoom();
    scene.technique.settings["light-skin.vals"] = 200;
    show(scene);
    const auto whole = light(), lazy = light();
    Scene lazily = scene;
    lazily.technique.settings["light-skin.renew"] = 0.25;
    const auto follow = [&](const Viewpoint* from) {
        update(*whole, scene, from);
        return update(*lazy, lazily, from);
    };
    const auto areEqual = [&] { return whole->readField() == lazy->readField(); };
    Viewpoint shown = view();
    EXPECT_TRUE(follow(&shown).converged) << "the first light is whole";
    EXPECT_TRUE(areEqual());
    shown.camera.eye.x -= 0.2f;
    shown.camera.target.z += 0.2f;
    EXPECT_FALSE(follow(&shown).converged);
    for (Scene* moved : {&scene, &lazily})
        moved->lights[0].position.z += 0.2f;
    for (int k = 1; k <= 4; ++k) {
        const LightingReport report = follow(&shown);
        EXPECT_EQ(report.converged, k == 4) << k;
        EXPECT_EQ(report.bounces, k == 4 ? 1U : 0U) << k;
        EXPECT_EQ(areEqual(), k == 4) << k;
    }
    EXPECT_TRUE(follow(&shown).skipped);
    // A cancelled update loses no draw.
    shown.camera.eye.x += 0.4f;
    std::atomic<bool> cancel = true;
    EXPECT_FALSE(lazy->update({.scene = lazily, .view = &shown}, {.cancel = &cancel}).converged);
    while (!follow(&shown).converged) {
    }
    EXPECT_TRUE(areEqual());
}

TEST_F(DeviceSkinTest, MakesAgainOnlyWhatChangedWithTheSameBits) {
    Scene scene = glossyRoom();
    show(scene);
    Viewpoint of = view();
    const auto skin = light();
    EXPECT_EQ(skin->snapshot(), nullptr);
    const LightingReport first = update(*skin, scene, &of);
    EXPECT_EQ(counterOf(first, "lights_traced"), 1);
    EXPECT_EQ(counterOf(first, "map_views"), 2) << "the spot's and the camera's";
    EXPECT_GT(counterOf(first, "dispatches"), 0);
    EXPECT_GT(counterOf(first, "bytes"), 1000);
    const IndirectField before = skin->readField();
    EXPECT_TRUE(update(*skin, scene, &of).skipped);
    scene.lights[0].strength *= 2;
    const LightingReport colour = update(*skin, scene, &of);
    EXPECT_EQ(counterOf(colour, "dispatches"), 0);
    EXPECT_EQ(counterOf(colour, "map_views"), 0);
    of.camera.eye.x -= 0.3f;
    const LightingReport looked = update(*skin, scene, &of);
    EXPECT_EQ(counterOf(looked, "lights_traced"), 0);
    EXPECT_EQ(counterOf(looked, "map_views"), 1);
    scene.lights[0].strength /= 2;
    of.camera.eye.x += 0.3f;
    of = view();
    update(*skin, scene, &of);
    EXPECT_TRUE(skin->readField() == before) << "repeats are equal";
    std::atomic<bool> cancel = true;
    scene.lights[0].position.x -= 0.2f;
    EXPECT_FALSE(skin->update({.scene = scene, .view = &of}, {.cancel = &cancel}).whole);
    EXPECT_TRUE(update(*skin, scene, &of).whole);
    EXPECT_TRUE(update(*skin, scene, nullptr).whole) << "without a view";
}

} // namespace
} // namespace limn::device_skin_test
