// SPDX-License-Identifier: MIT
#include "engine/math/sh_basis.h"
#include "shaders/shared/sh_normalisation.h"
#include "tests/core/sweep.h"
#include "tests/techniques/illuminance/gpu/relit_scene.h"
#include "tests/techniques/illuminance/gpu/rounding.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace limn::match_test {
namespace {

TEST(ShNormalisation, IsTheSameForShadersToTheLastBit) {
    constexpr std::array kShaders = {SH_NORMALISATION};
    ASSERT_EQ(kShaders.size(), sh_detail::kNormalisation.size());
    for (std::size_t i = 0; i < kShaders.size(); ++i)
        EXPECT_EQ(float(kShaders[i]), sh_detail::kNormalisation[i]) << i;
}

class GpuMatch : public DeviceTest {};

void compare(gpu::Device& device, const Scene& scene, const TraceScene& trace,
             std::shared_ptr<const Bake> bake) {
    Relighter cpu(bake, LitBands::All);
    const auto gpu = gpuRelighter(device, bake);
    ASSERT_TRUE(gpu);
    const RelightStats cpuStats = cpu.relight(scene, trace, 5);
    const GpuRelightStats stats = gpu->relight(surfelValues(*bake, scene, trace).inputs(), 5);
    EXPECT_EQ(stats.bounces, cpuStats.bounces);
    EXPECT_EQ(stats.converged, cpuStats.converged);
    EXPECT_EQ(stats.links, cpuStats.links);
    EXPECT_LE(stats.linksSkipped, cpuStats.linksSkipped);
    const double terms = maxLinks(bake->caches), brightest = largest(cpu.cacheSh());
    ASSERT_GT(brightest, 0);
    expectRounding("radiosity", distance(gpu->readRadiosity(), radiosityOf(cpu)), terms,
                   largest(radiosityOf(cpu)));
    expectRounding("caches", distance(gpu->readCacheSh(), cpu.cacheSh()), terms, brightest);
    const IndirectField field = gpu->readField();
    expectHalves("lightmap", field.lightmap, cpu.field().lightmap, terms, brightest);
    expectHalves("grid", field.grid, cpu.field().grid, terms, brightest);
    EXPECT_EQ(field.gridSize, cpu.field().gridSize);
    EXPECT_EQ(field.lightmapWidth, cpu.field().lightmapWidth);
    EXPECT_EQ(field.version, 1U);
}

// The halfs of the field share a scale, which a change of light may take them out of: all are
// written anew then, also those that are not seen.
TEST_F(GpuMatch, FieldsFollowLightOfAnyStrength) {
    Scene scene = court();
    const TraceScene trace(scene);
    const std::shared_ptr<Bake> made = baked(trace, scene.bake);
    const auto gpu = gpuRelighter(*device, made);
    Relighter cpu(made);
    CacheFlags few(made->caches.lightmapCount, 0);
    few[few.size() / 2] = 1;
    scene.relight.maxBounces = 2;
    for (const float strength : {1.f, 1e8f, 2e8f, 1e-6f, 0.f, 1.f}) {
        Scene lit = scene;
        lit.sky.radiance *= strength;
        for (Light& light : lit.lights)
            light.strength *= strength;
        for (Material& m : lit.materials)
            m.emission *= strength;
        const SurfelValues values = surfelValues(*made, lit, trace);
        SurfelInputs inputs = values.inputs();
        inputs.bands = 3;
        inputs.settings.maxBounces = 2;
        gpu->relight(inputs, 2, {}, &few);
        for (const glm::vec4& c : gpu->readField().lightmap)
            ASSERT_LE(glm::length(glm::vec3(c)), 1e11f * strength + 1e3f) << "older light, finite";
        gpu->relight(inputs, 2);
        cpu.relight(lit, trace, 2, {}, &few);
        cpu.relight(lit, trace, 2);
        const IndirectField field = gpu->readField();
        const double brightest = largest(cpu.cacheSh());
        EXPECT_EQ(brightest > 0, strength > 0);
        expectHalves("lightmap", field.lightmap, cpu.field().lightmap, maxLinks(made->caches),
                     brightest + 1e-30);
    }
}

TEST_F(GpuMatch, PassesOverLinksToASkyForAsLongAsItIsBlack) {
    Scene scene = court();
    const TraceScene trace(scene);
    const std::shared_ptr<Bake> made = baked(trace, scene.bake);
    const auto gpu = gpuRelighter(*device, made);
    Relighter cpu(made);
    for (const glm::vec3 sky : {glm::vec3(0), glm::vec3(0.1f, 0.3f, 0.9f), glm::vec3(0)}) {
        scene.sky.radiance = sky;
        const RelightStats cpuStats = cpu.relight(scene, trace, 30);
        const GpuRelightStats stats = gpu->relight(surfelValues(*made, scene, trace).inputs(), 30);
        EXPECT_EQ(stats.links, cpuStats.links);
        EXPECT_EQ(stats.linksSkipped > 0, sky == glm::vec3(0));
        EXPECT_LE(stats.linksSkipped, cpuStats.linksSkipped);
        expectRounding("caches", distance(gpu->readCacheSh(), cpu.cacheSh()),
                       maxLinks(made->caches), largest(cpu.cacheSh()));
    }
}

TEST_F(GpuMatch, GivesTheLightOfTheCpuInEveryBufferAtEveryStorageAndBandCount) {
    const Scene scene = court();
    const TraceScene trace(scene);
    for (const LinkStorage storage : {LinkStorage::Rtp, LinkStorage::Sh})
        for (const std::uint32_t bands : {2U, 3U, 4U, 5U, 8U}) {
            if (kSanitized && bands != 3 && bands != 8)
                continue;
            BakeSettings settings = scene.bake;
            settings.storage = storage;
            settings.bands = bands;
            const std::shared_ptr<Bake> made = baked(trace, settings);
            const Caches& caches = made->caches;
            EXPECT_GT(made->tree.skyCells, 0U);
            EXPECT_LT(caches.fillBegin[0], caches.fillBegin[caches.lightmapCount]);
            EXPECT_LT(caches.fillBegin[caches.lightmapCount], caches.fillBegin[caches.size()]);
            for (const std::uint32_t chroma : {0U, 1U, 2U, 3U})
                if (chroma < bands) {
                    std::printf("%s, %u bands, %u of chrominance\n",
                                storage == LinkStorage::Rtp ? "cones" : "harmonics", bands, chroma);
                    auto copy = std::make_shared<Bake>(*made);
                    copy->settings.chromaBands = chroma;
                    compare(*device, scene, trace, copy);
                }
        }
}

TEST_F(GpuMatch, LightsTheBandsThatAreAskedForAndOthersLater) {
    const Scene scene = court();
    const TraceScene trace(scene);
    for (const LinkStorage storage : {LinkStorage::Rtp, LinkStorage::Sh}) {
        BakeSettings settings = scene.bake;
        settings.storage = storage;
        settings.bands = 6;
        settings.chromaBands = 4;
        const std::shared_ptr<Bake> made = baked(trace, settings);
        Relighter needed(made), all(made, LitBands::All);
        needed.relight(scene, trace, 4);
        all.relight(scene, trace, 4);
        const auto gpu = gpuRelighter(*device, made);
        ASSERT_TRUE(gpu);
        const SurfelValues values = surfelValues(*made, scene, trace);
        SurfelInputs inputs = values.inputs();
        for (const Relighter* cpu : {&needed, &all}) {
            inputs.bands = cpu->field().bands;
            EXPECT_FALSE(gpu->relight(inputs, cpu == &needed ? 4 : 1).skipped);
            EXPECT_EQ(gpu->field()->bands, inputs.bands);
            const IndirectField field = gpu->readField();
            EXPECT_EQ(field.bands, inputs.bands);
            const double terms = maxLinks(made->caches), brightest = largest(cpu->cacheSh());
            if (cpu == &needed) {
                expectRounding("caches", distance(gpu->readCacheSh(), cpu->cacheSh()), terms,
                               brightest);
                expectHalves("lightmap", field.lightmap, cpu->field().lightmap, terms, brightest);
                expectHalves("grid", field.grid, cpu->field().grid, terms, brightest);
            } else { // one bounce further
                ASSERT_EQ(field.lightmap.size(), cpu->field().lightmap.size());
                EXPECT_LT(distance(field.lightmap, cpu->field().lightmap).max, 0.05 * brightest);
                EXPECT_LT(distance(field.grid, cpu->field().grid).max, 0.05 * brightest);
            }
        }
    }
}

TEST_F(GpuMatch, KnowsNoNegativeIrradianceEither) {
    Scene scene = court();
    const TraceScene trace(scene);
    const auto turned = baked(trace, scene.bake);
    for (glm::vec3& n : turned->surfels.normal) // away from their caches' light: three bands ring
        n = glm::normalize(glm::vec3(n.y, n.z, n.x) - 2.f * n);
    for (std::uint32_t c = 0; c < turned->caches.lightmapCount; ++c)
        turned->caches.normal[c] *= 2; // too long: light that continues below is negative
    compare(*device, scene, trace, turned);
    Relighter cpu(turned, LitBands::All);
    cpu.relight(scene, trace, 5);
    const SurfelValues values = surfelValues(*turned, scene, trace);
    std::size_t unlit = 0; // clamped: nothing but their own light
    for (std::size_t i = 0; i < values.direct.size(); ++i)
        unlit += glm::vec3(cpu.radiosity()[i]) ==
                 values.albedo[i] * values.direct[i] + values.emitted[i];
    EXPECT_GT(unlit, 10U);
}

TEST_F(GpuMatch, FollowsTheLightAsTheCpuDoes) {
    Scene scene = court();
    const TraceScene trace(scene);
    const auto made = baked(trace, scene.bake);
    Relighter cpu(made, LitBands::All);
    const auto gpu = gpuRelighter(*device, made);
    ASSERT_TRUE(gpu);
    const auto expectSame = [&](std::uint32_t bounces) {
        const RelightStats cpuStats = cpu.relight(scene, trace, bounces);
        const auto stats = gpu->relight(surfelValues(*made, scene, trace).inputs(), bounces);
        EXPECT_EQ(stats.bounces, cpuStats.bounces);
        const double terms = maxLinks(made->caches);
        expectRounding("radiosity", distance(gpu->readRadiosity(), radiosityOf(cpu)), terms,
                       largest(radiosityOf(cpu)));
        expectRounding("caches", distance(gpu->readCacheSh(), cpu.cacheSh()), terms,
                       largest(cpu.cacheSh()));
    };
    expectSame(100);
    scene.sky = {.kind = SkyKind::Gradient, .radiance = {2, 1, 0}, .horizon = {1, 1, 5}};
    expectSame(1);
    expectSame(2);
    scene.lights[0].color = {0, 1, 0.5f};
    expectSame(3);
    scene.materials[2].baseColor = {0.9f, 0.8f, 0.1f, 1};
    scene.materials[1].emission = {0, 3, 0};
    expectSame(100);
}

// A white room, in which each bounce passes on nearly all of the one before: both look ahead.
TEST_F(GpuMatch, LooksAheadWhereBouncesAreMany) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.97f)));
    b.add(simple::box(glm::vec3(0), {4, 3, 5}, true));
    Scene room = b.build();
    room.lights = court().lights;
    room.bake = court().bake;
    const TraceScene trace(room);
    const auto made = baked(trace, room.bake);
    Relighter cpu(made, LitBands::All);
    const auto gpu = gpuRelighter(*device, made);
    const RelightStats cpuStats = cpu.relight(room, trace, 1000);
    const SurfelValues values = surfelValues(*made, room, trace);
    const GpuRelightStats stats = gpu->relight(values.inputs(), 1000);
    std::printf("%u bounces, on the CPU %u\n", stats.bounces, cpuStats.bounces);
    EXPECT_TRUE(stats.converged);
    EXPECT_GT(stats.bounces, 20U);
    EXPECT_LT(stats.bounces, 60U) << "without looking ahead, 305";
    EXPECT_NEAR(double(stats.bounces), cpuStats.bounces, 2);
    const double brightest = largest(radiosityOf(cpu));
    EXPECT_LT(distance(gpu->readRadiosity(), radiosityOf(cpu)).max, 1e-3 * brightest);
    // In steps of few bounces, as in an editor, and with a view that sees one cache.
    const auto inSteps = gpuRelighter(*device, made);
    CacheFlags few(made->caches.lightmapCount, 0);
    few[0] = 1;
    std::uint32_t bounces = 0;
    for (GpuRelightStats step; !step.converged && bounces < 200; bounces += step.bounces)
        step = inSteps->relight(values.inputs(), 2, {}, &few);
    EXPECT_NEAR(double(bounces), stats.bounces, 2);
    EXPECT_LT(distance(inSteps->readRadiosity(), radiosityOf(cpu)).max, 1e-3 * brightest);
}

} // namespace
} // namespace limn::match_test
