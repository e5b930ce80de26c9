// SPDX-License-Identifier: MIT
#include "app/commands/command.h"
#include "app/commands/output_file.h"
#include "app/commands/progress_line.h"
#include "app/commands/scene_options.h"
#include "app/commands/tone_options.h"

#include "engine/core/parallel.h"
#include "engine/files/image_file.h"
#include "engine/json/json.h"
#include "engine/measure/compare.h"
#include "engine/reference/light_tracing.h"
#include "engine/scene/tone_map.h"

#include <chrono>
#include <memory>

#include <fmt/format.h>

namespace limn {

namespace {

struct ReferenceCommand {
    SceneOptions scene;
    CameraOptions camera;
    ToneOptions tone;
    std::string view = "lit", output;
    ReferenceOptions reference;
    int threads = 0;
    bool lightTracing = false, json = false;
};

View viewOf(const std::string& name) {
    for (std::size_t i = 0; i < kViewNames.size(); ++i)
        if (name == kViewNames[i])
            return View(i);
    return View::Lit;
}

double secondsSince(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Json report(const ReferenceResult& r, const std::string& view, double seconds) {
    Json json;
    json["seconds"] = seconds; // without reading the scene
    json["device"] = "cpu";
    json["view"] = view;
    json["width"] = r.image.width;
    json["height"] = r.image.height;
    json["invalid_pixels"] = countInvalidPixels(r.image);
    json["samples_per_pixel"] = r.samplesPerPixel;
    json["noise"] = r.noise; // null: fewer than 2 samples
    json["rays"] = r.rays;
    return json;
}

Exit runReference(ReferenceCommand& o) {
    if (const Result<void> writable =
            checkOutputFile(o.output, {".exr", ".png"}, {o.scene.scene, o.scene.sky});
        !writable)
        return failed(writable.error().message);
    if (o.lightTracing && !canBeLightTraced(viewOf(o.view)))
        return failed("--light-tracing shows --view lit, irradiance or indirect");
    const ThreadLimit limit(o.threads);
    const Result<ImportedScene> imported = openScene(o.scene);
    if (!imported)
        return failed(imported.error().message);
    const Scene scene = flatten(imported->document, imported->assets, o.scene.seconds);
    const Result<Camera> camera = chooseCamera(scene, o.camera);
    if (!camera)
        return failed(camera.error().message);
    o.reference.camera = *camera;
    o.reference.width = o.camera.width;
    o.reference.height = o.camera.height;
    o.reference.view = viewOf(o.view);

    const auto start = std::chrono::steady_clock::now();
    const TraceScene trace(scene);
    const ReferenceResult r = o.lightTracing
                                  ? renderLightTraced(trace, o.reference, progressOnStderr())
                                  : renderReference(trace, o.reference, progressOnStderr());
    endProgressLine();
    const Json json = report(r, o.view, secondsSince(start));
    const Result<void> written =
        o.output.ends_with(".png")
            ? writePng(o.output, toneMappedImage(r.image, tonemapOf(o.tone), o.tone.exposureEv))
            : writeExr(o.output, r.image);
    if (!written)
        return failed(written.error().message);
    if (o.json)
        fmt::print("{}\n", json.dump());
    else
        fmt::print("{}: {} x {}, {} samples per pixel, noise {:.3g}, {} M rays, {:.1f} s\n",
                   o.output, r.image.width, r.image.height, r.samplesPerPixel, r.noise,
                   r.rays / 1000000, json["seconds"].get<double>());
    return Exit::Done;
}

} // namespace

void addReferenceCommand(Command& app) {
    const auto o = std::make_shared<ReferenceCommand>();
    Command command = app.addCommand("reference", "Path-trace ground truth");
    addSceneOptions(command, o->scene);
    addTimeOption(command, o->scene);
    addCameraOptions(command, o->camera);
    command.option("--view", o->view, "What to show: lit, direct, indirect, irradiance or albedo")
        .oneOf({"lit", "direct", "indirect", "irradiance", "albedo"});
    command.option("--spp", o->reference.samplesPerPixel, "Samples per pixel").within(1, 1 << 24);
    command
        .option("--bounces", o->reference.maxBounces,
                "Maximum path segments after the first surface")
        .within(0, 100000);
    command.option("--seed", o->reference.seed,
                   "Seed of the random numbers; another seed gives other noise");
    command.option("--threads", o->threads, "Threads to use; 0: all").within(0, 1024);
    command
        .option("-o,--output", o->output,
                "Picture to write, .exr (linear, 32 bits) or .png (tone-mapped)")
        .required();
    addToneOptions(command, o->tone);
    command.flag("--light-tracing", o->lightTracing,
                 "Follow photons from the lights, through mirrors and glass too, instead of paths "
                 "from the eye: shows caustics. --spp photons a pixel; --bounces counts diffuse "
                 "reflections");
    command.flag("--json", o->json, "Print one JSON object to stdout");
    command.onRun([o] { return runReference(*o); });
}

} // namespace limn
