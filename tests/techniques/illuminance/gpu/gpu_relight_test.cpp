// SPDX-License-Identifier: MIT
#include "tests/techniques/illuminance/gpu/relit_scene.h"

#include <cmath>
#include <cstring>

namespace limn::gpu_relight_test {
namespace {

constexpr double kPi = std::numbers::pi;

class GpuRelight : public DeviceTest {
protected:
    void SetUp() override {
        DeviceTest::SetUp();
        if (!device)
            return;
        scene = court();
        trace = std::make_unique<TraceScene>(scene);
        made = baked(*trace, scene.bake);
        relighter = gpuRelighter(*device, made);
        values = surfelValues(*made, scene, *trace);
    }
    void TearDown() override {
        relighter.reset();
        DeviceTest::TearDown();
    }

    Scene scene;
    std::unique_ptr<TraceScene> trace;
    std::shared_ptr<const Bake> made;
    std::unique_ptr<GpuRelighter> relighter;
    SurfelValues values;
};

template <class T>
bool sameBytes(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

TEST_F(GpuRelight, GivesTheSameBitsEachTime) {
    relighter->relight(values.inputs(), 6);
    const auto again = gpuRelighter(*device, made);
    again->relight(values.inputs(), 6);
    EXPECT_TRUE(sameBytes(relighter->readRadiosity(), again->readRadiosity()));
    EXPECT_TRUE(sameBytes(relighter->readCacheSh(), again->readCacheSh()));
    EXPECT_TRUE(relighter->readField() == again->readField());
}

TEST_F(GpuRelight, GivesTheSameBitsInRowsOfGroupsAsADeviceOfNarrowDispatchesHasThem) {
    relighter->relight(values.inputs(), 3);
    device->properties.limits.maxComputeWorkGroupCount[0] = 7;
    const auto narrow = gpuRelighter(*device, made);
    narrow->relight(values.inputs(), 3);
    EXPECT_TRUE(sameBytes(relighter->readRadiosity(), narrow->readRadiosity()));
    EXPECT_TRUE(sameBytes(relighter->readCacheSh(), narrow->readCacheSh()));
    EXPECT_TRUE(relighter->readField() == narrow->readField());
}

TEST_F(GpuRelight, StandingStillDoesNothing) {
    const GpuRelightStats first = relighter->relight(values.inputs(), 200);
    EXPECT_TRUE(first.converged);
    EXPECT_FALSE(first.skipped);
    EXPECT_GT(first.dispatches, 0U);
    const std::uint64_t version = relighter->fieldVersion(), submitted = device->submitted();
    const GpuRelightStats second = relighter->relight(values.inputs(), 200);
    EXPECT_TRUE(second.converged);
    EXPECT_TRUE(second.skipped);
    EXPECT_EQ(second.dispatches, 0U);
    EXPECT_EQ(second.bytesUploaded, 0U);
    EXPECT_EQ(second.bounces, 0U);
    EXPECT_EQ(relighter->fieldVersion(), version);
    EXPECT_EQ(device->submitted(), submitted);
}

TEST_F(GpuRelight, GoesOnWhereItStoppedUntilItConverges) {
    GpuRelightStats stats;
    std::uint32_t rounds = 0;
    for (; rounds < 200 && !stats.converged; ++rounds) {
        stats = relighter->relight(values.inputs(), 1);
        EXPECT_FALSE(stats.skipped);
        EXPECT_EQ(stats.bounces, 1U);
        EXPECT_EQ(stats.bytesUploaded == 0, rounds > 0);
    }
    EXPECT_TRUE(stats.converged);
    const auto atOnce = gpuRelighter(*device, made);
    EXPECT_EQ(atOnce->relight(values.inputs(), 200).bounces, rounds);
    EXPECT_TRUE(sameBytes(relighter->readCacheSh(), atOnce->readCacheSh()));
}

TEST_F(GpuRelight, UploadsOnlyWhatChanged) {
    relighter->relight(values.inputs(), 200);
    const std::uint64_t surfels = made->surfels.size() * sizeof(glm::vec4);
    values.direct[7].y += 1;
    EXPECT_EQ(relighter->relight(values.inputs(), 200).bytesUploaded, surfels);
    values.albedo[0] = glm::vec3(0.1f);
    EXPECT_EQ(relighter->relight(values.inputs(), 200).bytesUploaded, surfels);
    values.emitted[3] = glm::vec3(4);
    values.sky.back() = {1, 2, 3};
    const GpuRelightStats both = relighter->relight(values.inputs(), 200);
    EXPECT_EQ(both.bytesUploaded, surfels + made->tree.skyCells * sizeof(glm::vec4));
    EXPECT_FALSE(both.skipped);
}

TEST_F(GpuRelight, ASkyThatComesBackReachesTheSurfels) {
    values.direct.assign(values.direct.size(), glm::vec3(0));
    values.emitted = values.direct;
    values.sky.assign(made->tree.skyCells, glm::vec3(0));
    relighter->relight(values.inputs(), 200);
    for (const glm::vec3 b : relighter->readRadiosity())
        ASSERT_EQ(b, glm::vec3(0));
    values.sky.back() = {1, 0, 0};
    EXPECT_GT(relighter->relight(values.inputs(), 200).bounces, 2U);
    EXPECT_GT(relighter->readRadiosity()[0].x, 0);
}

TEST_F(GpuRelight, NoticesTheChangeOfAnySingleSurfel) {
    relighter->relight(values.inputs(), 200);
    const std::size_t surfels = values.emitted.size();
    for (const std::size_t i :
         {std::size_t(0), std::size_t(62), std::size_t(63), std::size_t(64), surfels - 1}) {
        values.emitted[i] += 100.f;
        EXPECT_GT(relighter->relight(values.inputs(), 200).bounces, 1U) << i;
    }
}

TEST_F(GpuRelight, WaitsOnceForTwoBouncesAndTheirField) {
    relighter->relight(values.inputs(), 200);
    for (glm::vec3& e : values.direct)
        e *= 1.1f; // within the field's scale
    const std::uint64_t before = device->submitted();
    const GpuRelightStats stats = relighter->relight(values.inputs(), 2);
    EXPECT_EQ(stats.bounces, 2U);
    EXPECT_GT(stats.fieldMs, 0);
    EXPECT_EQ(device->submitted() - before, 2U) << "the upload of lights, which nothing waits for, "
                                                   "and all the rest";
}

TEST_F(GpuRelight, StopsAfterTheSubmissionInWhichItIsCancelled) {
    const std::atomic<bool> cancel = true;
    const GpuRelightStats stats =
        relighter->relight(values.inputs(), 200, {.report = {}, .cancel = &cancel});
    EXPECT_GE(stats.bounces, 1U);
    EXPECT_LE(stats.bounces, 4U);
    EXPECT_FALSE(stats.converged);
    EXPECT_EQ(relighter->fieldVersion(), 1U);
}

TEST_F(GpuRelight, ExtremeLightsStayFinite) {
    for (const float strength : {1e-6f, 1e6f}) {
        SurfelValues extreme = values;
        for (glm::vec3& e : extreme.direct)
            e *= strength;
        relighter->relight(extreme.inputs(), 20);
        for (const glm::vec3 c : relighter->readCacheSh())
            ASSERT_TRUE(std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z));
    }
}

TEST_F(GpuRelight, TimesItsSteps) {
    const GpuRelightStats stats = relighter->relight(values.inputs(), 3);
    EXPECT_GT(stats.cacheLightMs, 0);
    EXPECT_GT(stats.surfelLightMs, 0);
    EXPECT_GT(stats.pullMs, 0);
    EXPECT_GT(stats.fieldMs, 0);
    EXPECT_LE(stats.cacheLightMs + stats.surfelLightMs + stats.pullMs + stats.fieldMs,
              stats.totalMs);
}

TEST_F(GpuRelight, RefusesABakeThatTheDeviceCannotBindAndNamesTheSizes) {
    device->properties.limits.maxStorageBufferRange = 100 << 10;
    const auto refused = GpuRelighter::create(*device, made);
    ASSERT_FALSE(refused);
    const double mib = double(made->caches.links.size() * sizeof(Link)) / (1 << 20);
    ASSERT_GT(mib, 0.1);
    EXPECT_NE(refused.error().message.find("links"), std::string::npos) << refused.error().message;
    EXPECT_NE(refused.error().message.find(" 0.1 MiB"), std::string::npos)
        << refused.error().message;
    char size[32];
    std::snprintf(size, sizeof size, "%.1f MiB", mib);
    EXPECT_NE(refused.error().message.find(size), std::string::npos) << refused.error().message;
}

TEST_F(GpuRelight, RefusesADeviceThatBindsTooFewBuffers) {
    device->properties.limits.maxPerStageDescriptorStorageBuffers = 15;
    const auto refused = GpuRelighter::create(*device, made);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("15 storage buffers"), std::string::npos);
    EXPECT_NE(refused.error().message.find("16 are needed"), std::string::npos);
}

TEST_F(GpuRelight, PassesOnWhatTheCpuDoesAndStopsLightThatGrows) {
    const RelightStats cpu = Relighter(made).relight(scene, *trace, 64);
    const GpuRelightStats gpu = relighter->relight(values.inputs(), 64);
    EXPECT_GT(cpu.passedOn, 0.1);
    EXPECT_NEAR(gpu.passedOn, cpu.passedOn, 1e-3);
    EXPECT_FALSE(gpu.grows);
    Bake bright = *made;
    for (std::int8_t& e : bright.caches.linkExponent)
        e = std::int8_t(e - 10);
    const auto loud = gpuRelighter(*device, std::make_shared<const Bake>(std::move(bright)));
    const GpuRelightStats stats = loud->relight(values.inputs(), 64);
    EXPECT_TRUE(stats.grows);
    EXPECT_LT(stats.bounces, 8U);
    for (const glm::vec3 b : loud->readRadiosity())
        EXPECT_TRUE(std::isfinite(b.x));
    EXPECT_TRUE(loud->relight(values.inputs(), 64).skipped);
}

TEST_F(GpuRelight, AClosedGlowingRoomReachesItsRadiosityAtEveryBandCount) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f), glm::vec3(1)));
    b.add(simple::box(glm::vec3(0), glm::vec3(4, 3, 5), true));
    Scene room = b.build();
    room.bake.surfels = 100;
    room.bake.lightmapCaches = 80;
    room.bake.rays = 128;
    room.bake.links = 64;
    room.bake.grid = {2, 2, 2};
    const TraceScene roomTrace(room);
    for (const LinkStorage storage : {LinkStorage::Rtp, LinkStorage::Sh})
        for (std::uint32_t bands = 2; bands <= 8; ++bands) {
            room.bake.storage = storage;
            room.bake.bands = bands;
            const auto furnace = baked(roomTrace, room.bake);
            const auto lit = gpuRelighter(*device, furnace);
            SurfelValues in = surfelValues(*furnace, room, roomTrace);
            for (const float albedo : {0.f, 0.5f, 0.9f}) {
                in.albedo.assign(in.albedo.size(), glm::vec3(albedo));
                EXPECT_TRUE(lit->relight(in.inputs(), 400).converged);
                const double expected = kPi / (1 - double(albedo));
                double worst = 0;
                const std::vector<glm::vec3> radiosity = lit->readRadiosity();
                for (std::uint32_t s = 0; s < furnace->tree.surfels; ++s)
                    worst = std::max(worst, std::abs(double(radiosity[s].x) / expected - 1));
                EXPECT_LT(worst, 0.01)
                    << bands << " bands, albedo " << albedo << ", storage " << int(storage);
            }
        }
}

} // namespace
} // namespace limn::gpu_relight_test
