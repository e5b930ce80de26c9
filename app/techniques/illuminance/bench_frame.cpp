// SPDX-License-Identifier: MIT
#include "app/bench/moving_lights.h"
#include "app/techniques/illuminance/bench_bakes.h"
#include "app/techniques/illuminance/illuminance_program.h"

#include "engine/files/relight_choice.h"
#include "engine/gpu/device.h"
#include "engine/lighting/fastest_update.h"
#include "engine/techniques/illuminance/gpu/viewport_relighter.h"
#include "engine/techniques/illuminance/relight/seen_caches.h"

#include <chrono>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace limn {

namespace {

struct FrameBench {
    BenchBakes bakes;
    CameraOptions camera;
    std::string output, device, view = "lit";
    std::vector<std::uint32_t> lights = {0};      ///< points in the scene; 0: its own lights
    std::vector<std::string> relightOn = {"gpu"}; ///< "cpu", "gpu"
    std::vector<std::string> caches = {"seen"};   ///< "all", "seen"
    std::uint32_t bounces = 1;                    ///< a frame
    int runs = 15;
    bool coarse = false; ///< shadow maps, as the editor has them while things move
    bool movingCamera = false;
    bool json = false;
};

/// Times of a frame: GPU times of passes, except for relighting on the CPU [ms].
struct FrameTimes {
    double shadowMaps = 0;
    double lightsOnSurfels = 0; ///< from shadow maps, or by rays on the CPU
    double surfels = 0, pull = 0, caches = 0, field = 0;
    double upload = 0; ///< of the field where it comes from the CPU
    double geometry = 0, indirect = 0, direct = 0, tonemap = 0;
    double perLight = 0; ///< shadow maps and lights on surfels over the lights
    double total = 0;    ///< of the clock on the wall
    std::uint32_t cachesUnseen = 0;
    std::uint32_t bandsLit = 0; ///< of the bake's, those that some surface needs
};

struct Pass {
    const char* name;
    double FrameTimes::*ms;
};
constexpr Pass kPasses[] = {{"shadow_maps", &FrameTimes::shadowMaps},
                            {"lights_on_surfels", &FrameTimes::lightsOnSurfels},
                            {"surfels", &FrameTimes::surfels},
                            {"pull", &FrameTimes::pull},
                            {"caches", &FrameTimes::caches},
                            {"field", &FrameTimes::field},
                            {"upload", &FrameTimes::upload},
                            {"geometry", &FrameTimes::geometry},
                            {"indirect", &FrameTimes::indirect},
                            {"direct", &FrameTimes::direct},
                            {"tonemap", &FrameTimes::tonemap},
                            {"per_light", &FrameTimes::perLight},
                            {"", &FrameTimes::total}};

/// A viewport with bounced light from one device or the other.
struct FrameScene {
    gpu::Device& device;
    Viewport viewport{device};
    ViewportOptions options;
    const TraceScene& trace;
    std::unique_ptr<Relighter> cpu;
    std::unique_ptr<ViewportRelighter> gpu; ///< null: `cpu` is not
    std::optional<CacheFlags> seen;         ///< caches to light; none: all

    FrameTimes draw(const Scene& lit, std::uint32_t bounces);
};

FrameTimes FrameScene::draw(const Scene& lit, std::uint32_t bounces) {
    const auto start = std::chrono::steady_clock::now();
    viewport.setLighting(lit);
    const CacheFlags* wanted = seen ? &*seen : nullptr;
    const RelightStats light = gpu ? gpu->relight(viewport, lit, bounces, {}, wanted)
                                   : cpu->relight(lit, trace, bounces, {}, wanted);
    if (cpu)
        viewport.setIndirect(cpu->field());
    viewport.render(options);
    device.waitIdle();
    const std::chrono::duration<double, std::milli> total =
        std::chrono::steady_clock::now() - start;
    const ViewportStats& drawn = viewport.stats();
    FrameTimes t;
    t.shadowMaps = drawn.shadowMs + (gpu ? drawn.relightShadowMs : 0);
    t.lightsOnSurfels = light.directMs - (gpu ? drawn.relightShadowMs : 0);
    t.surfels = light.surfelLightMs + light.surfelReadMs;
    t.pull = light.pullMs;
    t.caches = light.cacheLightMs;
    t.field = light.fieldMs;
    t.upload = drawn.uploadMs;
    t.geometry = drawn.geometryMs;
    t.indirect = drawn.indirectMs;
    t.direct = drawn.directMs;
    t.tonemap = drawn.tonemapMs;
    if (!lit.lights.empty())
        t.perLight = (t.shadowMaps + t.lightsOnSurfels) / double(lit.lights.size());
    t.total = total.count();
    t.cachesUnseen = light.cachesUnseen;
    t.bandsLit = light.bandsLit;
    return t;
}

Json describe(const FrameBench& o, const BenchBake& baked, const FrameScene& frame,
              const Scene& scene, const std::vector<FrameTimes>& frames) {
    const ViewportStats& stats = frame.viewport.stats();
    Json row = {{"name", baked.name},
                {"device", frame.device.properties.deviceName},
                {"relight", frame.gpu ? "gpu" : "cpu"},
                {"view", o.view},
                {"width", frame.options.width},
                {"height", frame.options.height}};
    row.update(settingsOf(baked));
    row.update({{"lights", scene.lights.size()},
                {"lights_left_out", stats.lightsLeftOut},
                {"coarse_shadows", o.coarse},
                {"bounces", o.bounces},
                {"caches_lit", frame.seen ? "seen" : "all"},
                {"caches_unseen", frames.back().cachesUnseen},
                {"bands_lit", frames.back().bandsLit},
                {"frames", frames.size()},
                {"geometry_drawn", stats.geometryDrawn - 1}, // but for the first
                {"bytes", stats.gpuBytes}});
    for (const Pass& pass : kPasses) {
        std::vector<double> ms;
        for (const FrameTimes& t : frames)
            ms.push_back(t.*pass.ms);
        addSpread(row, pass.name, ms);
    }
    return row;
}

constexpr Column kFrameColumns[] = {{"scene", -14, "name"},
                                    {"relight", -7, "relight"},
                                    {"lit", -4, "caches_lit"},
                                    {"unseen", 6, "caches_unseen"},
                                    {"lights", 6, "lights"},
                                    {"surfels", 7, "surfels"},
                                    {"links", 5, "links"},
                                    {"bands", 5, "bands_lit"},
                                    {"kind", -4, "storage"},
                                    {"shadows", 7, "shadow_maps_median_ms"},
                                    {"direct", 7, "lights_on_surfels_median_ms"},
                                    {"surfels", 7, "surfels_median_ms"},
                                    {"pull", 7, "pull_median_ms"},
                                    {"caches", 7, "caches_median_ms"},
                                    {"field", 7, "field_median_ms"},
                                    {"drawn", 5, "geometry_drawn"},
                                    {"geom", 7, "geometry_median_ms"},
                                    {"bounced", 7, "indirect_median_ms"},
                                    {"shade", 7, "direct_median_ms"},
                                    {"tone", 7, "tonemap_median_ms"},
                                    {"/light", 8, "per_light_median_ms", 3},
                                    {"all [ms]", 8, "median_ms"},
                                    {"p95", 8, "p95_ms"}};

/// Unit vector to the camera's right.
glm::vec3 across(const Camera& camera) {
    return glm::normalize(rayDirection(camera, 1, 1, 0) - rayDirection(camera, 1, 0, 0));
}

Result<Json> measureFrames(const FrameBench& o, const BenchBake& baked, gpu::Device& device,
                           std::uint32_t lights, const std::string& relightOn,
                           const std::string& caches) {
    Scene lit = baked.scene;
    if (lights > 0)
        lit.lights =
            pointsOver(lit, baked.bake->surfels.position, baked.bake->surfels.normal, lights);
    const Result<Camera> camera = chooseCamera(lit, o.camera);
    if (!camera)
        return tl::make_unexpected(camera.error());
    FrameScene frame{.device = device, .trace = baked.trace};
    frame.options.view = named<View>(kViewNames, o.view);
    frame.options.camera = *camera;
    frame.options.width = o.camera.width;
    frame.options.height = o.camera.height;
    if (relightOn == "gpu") {
        auto made = ViewportRelighter::create(device, baked.bake);
        if (!made)
            return tl::make_unexpected(made.error());
        frame.gpu = std::move(*made);
    } else {
        frame.cpu = std::make_unique<Relighter>(baked.bake);
    }
    if (caches == "seen")
        frame.seen = seenCaches(cacheFootprints(lit, *baked.bake), *camera,
                                float(o.camera.width) / float(o.camera.height));
    frame.viewport.setCoarseShadows(o.coarse);
    frame.viewport.setScene(lit, {baked.bake, &baked.bake->lightmap});
    std::vector<FrameTimes> frames;
    const std::vector<Light> standing = lit.lights;
    for (int k = 0; k <= o.runs; ++k) {
        lit.lights = movedLights(standing, k);
        if (o.movingCamera) // a step to the side and back
            frame.options.camera.eye = camera->eye + 0.1f * float(k % 2) * across(*camera);
        const FrameTimes times = frame.draw(lit, o.bounces);
        if (k > 0) // the first lights materials and makes pipelines too
            frames.push_back(times);
    }
    return describe(o, baked, frame, lit, frames);
}

Exit runFrameBench(const FrameBench& o) {
    const auto device = gpu::createDevice({.name = o.device});
    if (!device)
        return failed("--device: " + device.error().message);
    Json rows = Json::array();
    if (!o.json)
        printTitles(kFrameColumns);
    const Result<void> measured = forEachBake(o.bakes, [&](const BenchBake& baked) -> Result<void> {
        for (const std::uint32_t lights : o.lights)
            for (const std::string& on : o.relightOn)
                for (const std::string& caches : o.caches) {
                    Result<Json> row = measureFrames(o, baked, **device, lights, on, caches);
                    if (!row)
                        return tl::make_unexpected(row.error());
                    rows.push_back(std::move(*row));
                    if (!o.json)
                        printRow(kFrameColumns, rows.back());
                }
        return {};
    });
    if (!measured)
        return failed(measured.error().message);
    return writeRows(rows, o.output, "frame", o.json);
}

} // namespace

void addFrameBench(Command& bench) {
    const auto o = std::make_shared<FrameBench>();
    o->bakes.storages = {"rtp"};
    Command command =
        bench.addCommand("frame", "Time of each pass of the viewport while all lights move");
    addBenchBakes(command, o->bakes);
    addCameraOptions(command, o->camera);
    command.option("-o,--output", o->output, "Folder for frame.csv and frame.json").required();
    command.option("--view", o->view, "What the viewport shows").oneOf(namesIn(kViewNames));
    command
        .option("--lights", o->lights,
                "Number of moving point lights, a list; 0: the lights of the scene")
        .list()
        .within(0, 4096);
    command.option("--relight", o->relightOn, "Where bounced light is computed, gpu or cpu, a list")
        .list()
        .oneOf({"gpu", "cpu"});
    command
        .option("--caches", o->caches,
                "Which caches are lit: those that the picture reads (seen), or all; a list")
        .list()
        .oneOf({"all", "seen"});
    command.option("--bounces", o->bounces, "Bounces per frame").within(1, 64);
    command.option("--device", o->device, "Part of the Vulkan device's name");
    command.option("--runs", o->runs, "Number of frames; their median is printed")
        .within(9, 100000);
    command.flag("--coarse-shadows", o->coarse,
                 "Draw shadow maps of half the width, as the editor does while things move");
    command.flag("--moving-camera", o->movingCamera,
                 "Move the camera by 10 cm per frame, so that every frame draws triangles");
    command.flag("--json", o->json, "Print one JSON object to stdout");
    command.onRun([o] { return runFrameBench(*o); });
}

} // namespace limn
