// SPDX-License-Identifier: MIT
#include "app/bench/moving_lights.h"
#include "app/techniques/illuminance/bench_bakes.h"
#include "app/techniques/illuminance/frame_times.h"
#include "app/techniques/illuminance/illuminance_program.h"

#include "engine/files/relight_choice.h"
#include "engine/gpu/device.h"
#include "engine/lighting/fastest_update.h"

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

Json describe(const FrameBench& o, const BenchBake& baked, const FrameOptions& options,
              const DrawnFrames& drawn, std::size_t lights) {
    const std::vector<FrameTimes>& frames = drawn.frames;
    Json row = {
        {"name", baked.name}, {"device", drawn.device}, {"relight", options.onGpu ? "gpu" : "cpu"},
        {"view", o.view},     {"width", options.width}, {"height", options.height}};
    row.update(settingsOf(baked));
    row.update({{"lights", lights},
                {"lights_left_out", drawn.lightsLeftOut},
                {"coarse_shadows", o.coarse},
                {"bounces", o.bounces},
                {"caches_lit", options.seenOnly ? "seen" : "all"},
                {"caches_unseen", frames.back().cachesUnseen},
                {"bands_lit", frames.back().bandsLit},
                {"frames", frames.size()},
                {"geometry_drawn", drawn.geometryDrawn},
                {"bytes", drawn.bytes}});
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

Result<Json> measureFrames(const FrameBench& o, const BenchBake& baked, std::uint32_t lights,
                           const std::string& relightOn, const std::string& caches) {
    Scene lit = baked.scene;
    if (lights > 0)
        lit.lights =
            pointsOver(lit, baked.bake->surfels.position, baked.bake->surfels.normal, lights);
    const Result<Camera> camera = chooseCamera(lit, o.camera);
    if (!camera)
        return tl::make_unexpected(camera.error());
    const FrameOptions options{.device = o.device,
                               .view = named<View>(kViewNames, o.view),
                               .width = o.camera.width,
                               .height = o.camera.height,
                               .onGpu = relightOn == "gpu",
                               .seenOnly = caches == "seen",
                               .coarseShadows = o.coarse,
                               .bounces = o.bounces};
    const Result<DrawnFrames> drawn =
        drawFrames(options, baked.trace, baked.bake, o.runs, [&](int k) {
            FrameScene shown{lit, *camera};
            shown.scene.lights = movedLights(lit.lights, k);
            if (o.movingCamera) // a step to the side and back
                shown.camera.eye = camera->eye + 0.1f * float(k % 2) * across(*camera);
            return shown;
        });
    if (!drawn)
        return tl::make_unexpected(drawn.error());
    return describe(o, baked, options, *drawn, lit.lights.size());
}

Exit runFrameBench(const FrameBench& o) {
    if (const auto device = gpu::createDevice({.name = o.device});
        !device) // before anything is baked
        return failed("--device: " + device.error().message);
    Json rows = Json::array();
    if (!o.json)
        printTitles(kFrameColumns);
    const Result<void> measured = forEachBake(o.bakes, [&](const BenchBake& baked) -> Result<void> {
        for (const std::uint32_t lights : o.lights)
            for (const std::string& on : o.relightOn)
                for (const std::string& caches : o.caches) {
                    Result<Json> row = measureFrames(o, baked, lights, on, caches);
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
