// SPDX-License-Identifier: MIT
// Pictures that light their scene themselves, one request after the other, without the thread.
#include "app/editor/render_worker.h"

#include "engine/lighting/converged_light.h"
#include "engine/lightmap/atlas.h"
#include "engine/measure/compare.h"
#include "engine/picture/field_render.h"
#include "engine/scene/exposure.h"
#include "engine/scene/tone_map.h"
#include "engine/techniques/illuminance/baked_illuminance.h"
#include "engine/techniques/technique_table.h"
#include "tests/techniques/illuminance/relight/lit_room.h"

#include <gtest/gtest.h>

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

namespace fs = std::filesystem;

namespace limn::render_worker_test {
namespace {

struct RenderWorkerTest : testing::Test {
    std::shared_ptr<const Scene> first = litRoom(500, 800), moved = lampMoved();
    std::shared_ptr<const TraceScene> trace = std::make_shared<const TraceScene>(*first);
    std::shared_ptr<const Precomputed> made = precomputed(*trace);

    static std::shared_ptr<const Precomputed> precomputed(const TraceScene& trace) {
        return *precomputingTechnique({}).precomputation->prepare(trace, {}, {});
    }

    std::shared_ptr<const Scene> lampMoved() const {
        Scene scene = *first;
        scene.lights[0].position = {3.2f, 1.8f, 4};
        return std::make_shared<const Scene>(std::move(scene));
    }

    /// Of bounced light alone, to +z or to -z.
    PictureRequest looking(float z, std::shared_ptr<const Scene> scene) const {
        PictureRequest request;
        request.scene = std::move(scene);
        request.layout = {made, &made->layout()};
        request.options.view = View::Irradiance;
        request.options.camera.eye = {2, 1.5f, 2.5f};
        request.options.camera.target = {2, 1.5f, 2.5f + z};
        request.options.width = request.options.height = 64;
        request.technique = &made->technique();
        request.lit = {made, first, trace};
        request.relight = true;
        return request;
    }
};

/// A folder in which times are kept until the end.
class CacheFolder {
public:
    CacheFolder() {
        if (const char* before = std::getenv(kName))
            m_before = before;
        setenv(kName, path.c_str(), 1);
    }
    ~CacheFolder() {
        if (m_before.empty())
            unsetenv(kName);
        else
            setenv(kName, m_before.c_str(), 1);
        std::error_code error;
        fs::remove_all(path, error);
    }

    const fs::path path = fs::temp_directory_path() / ("limn_times" + std::to_string(getpid()));

private:
    static constexpr const char* kName = "XDG_CACHE_HOME";
    std::string m_before;
};

/// Draws until the light rests.
Image drawn(RenderWorker& worker, const PictureRequest& request) {
    const std::atomic<bool> hurry = false;
    Image image = *worker.draw(request, hurry).shown;
    for (int k = 0; worker.bouncing() && k < 1000; ++k)
        image = *worker.draw(request, hurry).shown;
    EXPECT_FALSE(worker.bouncing());
    return image;
}

TEST_F(RenderWorkerTest, MetersThePictureWhereAskedTo) {
    const std::atomic<bool> hurry = false;
    RenderWorker worker(false);
    PictureRequest request = looking(1, first);
    drawn(worker, request);
    EXPECT_FALSE(worker.draw(request, hurry).metered);
    request.meter = request.linear = true;
    for (const float exposure : {0.f, 5.f}) { // it does not depend on the exposure
        request.options.exposureEv = exposure;
        const DrawnImages images = worker.draw(request, hurry);
        ASSERT_TRUE(images.metered && images.linear);
        EXPECT_NEAR(*images.metered, *meteredExposure(images.linear->image), 0.05f);
    }
    request.options.view = View::Normals;
    EXPECT_FALSE(worker.draw(request, hurry).metered) << "no light";
}

TEST_F(RenderWorkerTest, RefinesAPictureThatStandsStill) {
    const std::atomic<bool> calm = false, hurry = true;
    RenderWorker worker(false);
    EXPECT_FALSE(worker.refining());
    PictureRequest request = looking(1, first);
    request.linear = true;
    const Image before = drawn(worker, request);
    ASSERT_TRUE(worker.refining());
    EXPECT_FALSE(worker.refine(hurry));
    int pictures = 0;
    DrawnImages images;
    for (; worker.refining(); ++pictures)
        images = *worker.refine(calm);
    EXPECT_EQ(pictures, 4) << "of 2, 4, 8 and 16 samples";
    EXPECT_NE(images.shown->rgba, before.rgba);

    Viewport& viewport = worker.viewport;
    const ImageF mean = viewport.readLinear();
    EXPECT_EQ(images.linear->image.rgb, mean.rgb);
    viewport.render(request.options);
    for (std::uint32_t n = 1; n < 16; ++n)
        viewport.refine();
    EXPECT_EQ(viewport.readLinear().rgb, mean.rgb);

    worker.draw(looking(1, moved), hurry);
    EXPECT_FALSE(worker.refining()) << "while light bounces";
    request.moving = true;
    drawn(worker, request);
    EXPECT_FALSE(worker.refining());
    request.moving = false;
    request.options.inspection = Inspection::InvalidPixels;
    drawn(worker, request);
    EXPECT_FALSE(worker.refining());
    request.options.inspection = Inspection::None;
    drawn(worker, request);
    EXPECT_TRUE(worker.refining());
}

/// Refines and gathers until nothing is left to do.
DrawnImages finished(RenderWorker& worker) {
    const std::atomic<bool> calm = false;
    DrawnImages images;
    while (worker.refining() || worker.gathering())
        images = *(worker.refining() ? worker.refine(calm) : worker.gather(calm));
    return images;
}

TEST_F(RenderWorkerTest, GathersTheLightOfAPictureThatStandsStill) {
    RenderWorker worker(false);
    EXPECT_FALSE(worker.gathering());
    PictureRequest request = looking(1, first);
    request.linear = true;
    drawn(worker, request);
    EXPECT_FALSE(worker.gathers()) << "nobody asks";
    const ImageF alone = finished(worker).linear->image;
    request.gather = true;
    drawn(worker, request);
    ASSERT_TRUE(worker.gathers());
    EXPECT_FALSE(worker.gathering()) << "before it is refined";
    EXPECT_EQ(worker.gathered(), 0);
    const DrawnImages images = finished(worker);
    EXPECT_EQ(worker.gathered(), 1);
    EXPECT_FALSE(worker.gathering());

    const auto lit = convergeLight(first, trace, made->technique(), request.lit.prepared(),
                                   LitFor::Pictures, {});
    ASSERT_TRUE(lit);
    FieldRenderOptions options;
    options.view = request.options.view;
    options.camera = request.options.camera;
    options.width = request.options.width;
    options.height = request.options.height;
    options.gatherRays = kScreenSamples.gatherRays;
    options.emitted = lit->lighting->emittedField(*first);
    const ImageF whole = renderField(*trace, lit->field(), *lit->layout, options);
    EXPECT_LT(compareImages(images.linear->image, whole)->nrmse, 1e-3);
    EXPECT_GT(compareImages(alone, whole)->nrmse, 0.02);
    EXPECT_EQ(images.shown->rgba, toneMappedImage(images.linear->image, request.options.tonemap,
                                                  request.options.exposureEv)
                                      .rgba);
}

TEST_F(RenderWorkerTest, GathersTheLightOfTheCpuAlike) {
    RenderWorker here(false), there(false);
    PictureRequest request = looking(1, first);
    request.gather = request.linear = true;
    drawn(here, request);
    const ImageF byDevice = finished(here).linear->image;
    const auto lit = convergeLight(first, trace, made->technique(), request.lit.prepared(),
                                   LitFor::Pictures, {});
    ASSERT_TRUE(lit);
    request.relight = false;
    request.field = std::make_shared<const IndirectField>(lit->field());
    drawn(there, request);
    EXPECT_LT(compareImages(finished(there).linear->image, byDevice)->nrmse, 1e-3);
}

TEST_F(RenderWorkerTest, GathersOnlyWhatStandsStillAndIsBakedAsItIs) {
    RenderWorker worker(false);
    const auto gathers = [&](const auto& change) {
        PictureRequest request = looking(1, first);
        request.gather = true;
        change(request);
        drawn(worker, request);
        return worker.gathers();
    };
    EXPECT_TRUE(gathers([](PictureRequest&) {}));
    EXPECT_TRUE(gathers([&](PictureRequest& r) { r.scene = moved; })) << "only a lamp moved";
    EXPECT_FALSE(gathers([](PictureRequest& r) { r.moving = true; }));
    EXPECT_FALSE(gathers([](PictureRequest& r) { r.lit.preview = true; }));
    EXPECT_FALSE(gathers([](PictureRequest& r) { r.options.view = View::Albedo; }));
    EXPECT_FALSE(
        gathers([](PictureRequest& r) { r.options.inspection = Inspection::InvalidPixels; }));
    EXPECT_FALSE(gathers([&](PictureRequest& r) {
        Scene scene = *first;
        scene.instances[0].toWorld[3].x += 0.1f;
        r.scene = std::make_shared<const Scene>(std::move(scene));
    })) << "a wall moved";
}

TEST_F(RenderWorkerTest, GathersNothingWhereThereIsNoLight) {
    const std::atomic<bool> calm = false;
    RenderWorker worker(false);
    Scene scene = *first;
    scene.lights.clear();
    for (Material& m : scene.materials)
        m.emission = glm::vec3(0);
    scene.sky = {};
    PictureRequest request = looking(1, std::make_shared<const Scene>(std::move(scene)));
    request.gather = true;
    drawn(worker, request);
    while (worker.refining())
        worker.refine(calm);
    ASSERT_TRUE(worker.gathering());
    EXPECT_FALSE(worker.gather(calm));
    EXPECT_FALSE(worker.gathering());
}

TEST_F(RenderWorkerTest, RowsThatAreNotGatheredYetStayAsDrawn) {
    const std::atomic<bool> calm = false, hurry = true;
    const auto lit =
        convergeLight(first, trace, made->technique(), {made, first}, LitFor::Pictures, {});
    ASSERT_TRUE(lit);
    FieldRenderOptions options;
    options.view = View::Irradiance;
    options.camera = looking(1, first).options.camera;
    options.width = 20;
    options.height = 20;
    options.gatherRays = 1;
    const glm::vec3 before(1e6f);
    const ImageF drawn{20, 20, std::vector<glm::vec3>(400, before)},
        rest{20, 20, std::vector<glm::vec3>(400, glm::vec3(0))};
    const GatheredFrom from{trace, lit->layout, std::make_shared<const IndirectField>(lit->field()),
                            lit->lighting->emittedField(*first)};
    RestGather gather(from, options);
    gather.begin(drawn, rest);
    for (const std::size_t rows : {0U, 8U, 20U}) { // the last ones learn from each other
        EXPECT_FALSE(gather.done());
        ASSERT_TRUE(gather.addRows(std::chrono::milliseconds(0), calm));
        for (std::size_t i = 0; i < 400; ++i)
            EXPECT_EQ(gather.picture().rgb[i] == before, i >= 20 * rows);
    }
    EXPECT_TRUE(gather.done());
    RestGather stopped(from, options);
    stopped.begin(drawn, rest);
    EXPECT_FALSE(stopped.addRows(std::chrono::milliseconds(0), hurry));
    EXPECT_EQ(stopped.picture().rgb, drawn.rgb);
}

TEST(WorthRefining, EndsAtSixteenSamplesOrWhereTheNextWouldTakeTwentySeconds) {
    EXPECT_TRUE(worthRefining(1, 20'000));
    EXPECT_FALSE(worthRefining(1, 55'000)) << "500 lights on a software rasteriser";
    EXPECT_TRUE(worthRefining(8, 2'400));
    EXPECT_FALSE(worthRefining(8, 2'600));
    EXPECT_FALSE(worthRefining(16, 0));
}

TEST_F(RenderWorkerTest, WhatComesIntoViewIsRightInTheNextPicture) {
    const std::atomic<bool> hurry = true; // a few bounces a picture
    RenderWorker turned(false), still(false);
    drawn(turned, looking(1, first));
    const Image before = drawn(still, looking(-1, first));
    EXPECT_EQ(turned.relight.bounces, still.relight.bounces);
    // The lamp moves while one looks forward and the other back; then both look back.
    turned.draw(looking(1, moved), hurry);
    still.draw(looking(-1, moved), hurry);
    EXPECT_GT(counterOf(turned.relight.last, "caches_unseen"),
              bakeOf(*made)->caches.lightmapCount / 4);
    EXPECT_TRUE(turned.bouncing());
    const Image a = *turned.draw(looking(-1, moved), hurry).shown,
                b = *still.draw(looking(-1, moved), hurry).shown;
    EXPECT_EQ(turned.relight.bounces, still.relight.bounces);
    EXPECT_EQ(a.rgba, b.rgba);
    EXPECT_NE(a.rgba, before.rgba) << "the old light";
}

TEST_F(RenderWorkerTest, TheLinearPictureComesOnRequestAndSaysWhatItShows) {
    const std::atomic<bool> hurry = true;
    RenderWorker worker(false);
    PictureRequest request = looking(1, first);
    EXPECT_FALSE(worker.draw(request, hurry).linear);
    request.linear = true;
    const DrawnImages images = worker.draw(request, hurry);
    ASSERT_TRUE(images.linear);
    EXPECT_EQ(images.linear->image.width, images.shown->width);
    EXPECT_EQ(images.linear->image.height, images.shown->height);
    EXPECT_EQ(images.linear->camera, request.options.camera);
    EXPECT_EQ(images.linear->view, request.options.view);
}

TEST_F(RenderWorkerTest, AtRestEveryViewHasTheNewestLight) {
    const std::atomic<bool> hurry = true;
    RenderWorker turned(false), still(false);
    drawn(turned, looking(1, first));
    drawn(turned, looking(1, moved));
    EXPECT_GT(counterOf(turned.relight.last, "caches_unseen"), 0U)
        << "the bounces were for what is seen";
    const std::uint64_t calls = turned.relight.calls;
    const Image a = *turned.draw(looking(-1, moved), hurry).shown;
    EXPECT_EQ(turned.relight.calls, calls) << "nothing is left to do";
    EXPECT_FALSE(turned.bouncing());
    drawn(still, looking(-1, first));
    EXPECT_EQ(a.rgba, drawn(still, looking(-1, moved)).rgba);
}

// Light propagation volumes need no bake.
TEST_F(RenderWorkerTest, ATechniqueWithoutABakeLightsWhatIsShown) {
    const Technique& lpv = *findTechnique("lpv");
    const auto onDevice = [&](std::shared_ptr<const Scene> scene) {
        PictureRequest request = looking(1, std::move(scene));
        request.layout = std::make_shared<LightmapLayout>(layoutWithoutLightmap(*request.scene));
        request.technique = &lpv;
        request.lit = {};
        return request;
    };
    const auto onCpu = [&](std::shared_ptr<const Scene> scene) {
        const auto lighting = lpv.light({});
        lighting->update({.scene = *scene, .trace = trace.get()}, {});
        PictureRequest request = onDevice(std::move(scene));
        request.field = std::make_shared<const IndirectField>(*lighting->field());
        request.relight = false;
        return request;
    };
    const std::atomic<bool> hurry = false;
    RenderWorker worker(true), other(true), dark(true); // drivers keep caches where times are kept
    const Image before = drawn(worker, onDevice(first));
    EXPECT_EQ(worker.refusal, "");
    EXPECT_EQ(worker.relight.calls, 1U);
    worker.draw(onDevice(first), hurry);
    EXPECT_EQ(worker.relight.calls, 1U) << "nothing changed";
    const Image after = drawn(worker, onDevice(moved));
    EXPECT_EQ(worker.relight.calls, 2U);
    EXPECT_NE(after.rgba, before.rgba);
    const Image expected = drawn(other, onCpu(moved));
    int most = 0;
    for (std::size_t k = 0; k < expected.rgba.size(); ++k)
        most = std::max(most, std::abs(int(after.rgba[k]) - int(expected.rgba[k])));
    EXPECT_LE(most, 3) << "of 255";
    EXPECT_EQ(drawn(worker, onCpu(moved)).rgba, expected.rgba) << "the CPU takes over";
    EXPECT_EQ(drawn(worker, onDevice(moved)).rgba, after.rgba) << "and hands back";
    EXPECT_NE(drawn(worker, looking(1, moved)).rgba, after.rgba) << "a bake";
    const CacheFolder cache;
    PictureRequest measured = onDevice(first);
    measured.measure = trace;
    drawn(worker, measured);
    ASSERT_TRUE(worker.times);
    EXPECT_GT(worker.times->gpuMs, 0);
    const fs::path remembered = cache.path / "limn/relight.json";
    EXPECT_TRUE(fs::remove(remembered));
    Scene unlit = *first;
    unlit.lights.clear();
    measured = onDevice(std::make_shared<const Scene>(unlit));
    measured.measure = trace;
    drawn(dark, measured);
    EXPECT_FALSE(dark.times) << "an update that does nothing says nothing";
    EXPECT_FALSE(fs::exists(remembered));
    EXPECT_EQ(drawn(worker, onDevice(first)).rgba, before.rgba) << "no trace of moved lights";
    for (const RenderWorker* each : {&worker, &other, &dark})
        EXPECT_TRUE(each->device->validationMessages().empty());
}

TEST_F(RenderWorkerTest, OverlaysOfATechniqueWithoutABakeShowTheDevicesLight) {
    const std::atomic<bool> hurry = false;
    RenderWorker worker(false);
    PictureRequest request = looking(1, first);
    request.layout = std::make_shared<LightmapLayout>(layoutWithoutLightmap(*first));
    request.technique = findTechnique("lpv");
    request.lit = {};
    const Image plain = drawn(worker, request);
    EXPECT_FALSE(worker.snapshot) << "nobody asks";
    request.overlay.kind = &request.technique->overlays[0];
    worker.draw(request, hurry);
    ASSERT_TRUE(worker.snapshot && worker.snapshotScene == first);
    request.overlaySource = worker.snapshot;
    request.overlayScene = worker.snapshotScene;
    const Image lobes = *worker.draw(request, hurry).shown;
    ASSERT_TRUE(worker.overlay);
    EXPECT_FALSE(worker.overlay->marks.empty());
    EXPECT_NE(lobes.rgba, plain.rgba);
    EXPECT_EQ(worker.snapshot, request.overlaySource) << "the light has not changed";
    request.scene = moved;
    worker.draw(request, hurry);
    EXPECT_NE(worker.snapshot, request.overlaySource);
}

TEST_F(RenderWorkerTest, SaysWhichTechniqueTheDeviceCannotLight) {
    RenderWorker worker(false);
    PictureRequest request = looking(1, first);
    request.technique = findTechnique("ambient");
    request.lit = {};
    drawn(worker, request);
    EXPECT_NE(worker.refusal.find("ambient"), std::string::npos);
    request.technique = findTechnique("lpv");
    drawn(worker, request);
    EXPECT_EQ(worker.refusal, "");
}

/// The room with a dynamic block at `x`.
std::shared_ptr<const Scene> withBlock(float x, bool occlusion = true) {
    using namespace simple;
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f), glm::vec3(1)));
    b.addMaterial(lambert(glm::vec3(0)));
    b.add(box(glm::vec3(0), glm::vec3(4, 3, 5), true));
    Mesh block = box(glm::vec3(-0.4f), glm::vec3(0.4f), false);
    block.material = 1;
    b.add(block, glm::mat4(1), true).toWorld[3] = {x, 0.7f, 1.5f, 1};
    Scene scene = b.build();
    scene.bake = litRoom(500, 800)->bake;
    scene.relight.dynamicOcclusion = occlusion;
    return std::make_shared<const Scene>(std::move(scene));
}

TEST_F(RenderWorkerTest, AMovedObjectTakesItsOcclusionAlong) {
    first = withBlock(1);
    trace = std::make_shared<const TraceScene>(*first);
    made = precomputed(*trace);
    RenderWorker worker(false);
    const Image before = drawn(worker, looking(-1, first));
    const double occluded = counterOf(worker.relight.last, "links_occluded");
    EXPECT_GT(occluded, 100U);
    const auto there = withBlock(3);
    const Image after = drawn(worker, looking(-1, there));
    EXPECT_NE(after.rgba, before.rgba);
    EXPECT_GT(counterOf(worker.relight.last, "links_occluded"), 100U);
    RenderWorker other(false);
    drawn(other, looking(-1, there));
    EXPECT_EQ(counterOf(worker.relight.last, "links_occluded"),
              counterOf(other.relight.last, "links_occluded"));
    Scene unbaked = *there;
    unbaked.bake.links = 64;
    drawn(worker, looking(-1, std::make_shared<const Scene>(unbaked)));
    EXPECT_EQ(counterOf(worker.relight.last, "links_occluded"),
              counterOf(other.relight.last, "links_occluded"))
        << "until there is another bake";
    const Image off = drawn(worker, looking(-1, withBlock(3, false)));
    EXPECT_EQ(counterOf(worker.relight.last, "links_occluded"), 0U);
    EXPECT_NE(off.rgba, after.rgba);
    drawn(worker, looking(-1, first));
    EXPECT_EQ(counterOf(worker.relight.last, "links_occluded"), occluded);
}

} // namespace
} // namespace limn::render_worker_test
