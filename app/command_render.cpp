// SPDX-License-Identifier: MIT
#include "app/command.h"
#include "app/output_file.h"
#include "app/overlay_options.h"
#include "app/progress_line.h"
#include "app/render_image.h"
#include "app/scene_options.h"

#include "engine/core/log.h"
#include "engine/files/bake_file.h"
#include "engine/files/image_file.h"
#include "engine/measure/compare.h"
#include "engine/relight/relight.h"
#include "engine/relight/seen_caches.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace limn {

namespace {

struct Options {
    SceneOptions scene;
    CameraOptions camera;
    OverlayFlags overlay;
    std::string bake, output, view = "lit", tonemap = "aces", device = "auto", relight = "auto";
    float exposureEv = 0;
    bool noDimming = false, allCaches = false, json = false;
};

/// What a picture needs of a bake: indirect light, and what is drawn over it. Empty: nothing.
struct Baked {
    std::shared_ptr<const Bake> bake;
    std::shared_ptr<const TraceScene> trace;
    bool light = false;                   ///< the picture shows bounced light
    std::optional<CacheFlags> seen;       ///< caches that the picture looks up; none: light all
    std::unique_ptr<Relighter> relighter; ///< made when the CPU has to light the bake
    std::shared_ptr<const OverlayData> overlay;
};

template <class Names>
std::size_t indexOf(const Names& names, const std::string& name) {
    return std::size_t(std::find(names.begin(), names.end(), name) - names.begin());
}

template <class Names>
std::vector<std::string> strings(const Names& names) {
    return {names.begin(), names.end()};
}

bool needsIndirect(View view) {
    switch (view) {
    case View::Lit:
    case View::Indirect:
    case View::Irradiance:
        return true;
    case View::Direct:
    case View::Albedo:
    case View::Normals:
        return false;
    }
    return false;
}

// Reads the bake, or makes one with the document's settings.
Result<Bake> obtainBake(const Options& options, Scene& scene, const TraceScene& trace) {
    if (options.bake.empty()) {
        Result<Bake> made = bake(trace, progressOnStderr());
        endProgressLine();
        return made;
    }
    Result<Bake> read = readBake(options.bake);
    if (!read)
        return read;
    const bool dimming = scene.bake.dimming; // the document's, not that of the time of the bake
    scene.bake = read->settings;
    scene.bake.dimming = dimming;
    if (read->sceneHash != bakeInputHash(scene))
        return fail(
            fmt::format("{}: is the bake of another scene than {}, or of an older state of it",
                        options.bake, options.scene.scene));
    return read;
}

CpuLight relight(const Scene& scene, Baked& baked) {
    if (!baked.relighter) // an overlay of light has one already
        baked.relighter = std::make_unique<Relighter>(baked.bake);
    const RelightStats stats =
        baked.relighter->relight(scene, *baked.trace, baked.bake->settings.maxBounces,
                                 progressOnStderr(), baked.seen ? &*baked.seen : nullptr);
    endProgressLine();
    return {baked.relighter->field(), stats};
}

Result<void> addOverlay(const Options& options, const Scene& scene, const TraceScene& trace,
                        const Camera& camera, Baked& baked) {
    const Result<OverlayOptions> wanted = overlayOptions(
        options.overlay, *baked.bake, trace, camera, options.camera.width, options.camera.height);
    if (!wanted)
        return tl::make_unexpected(wanted.error());
    std::optional<LitBake> lit;
    if (showsLight(wanted->kind)) {
        relight(scene, baked);
        const Relighter& r = *baked.relighter;
        lit = {r.radiosity(), r.cacheSh(), int(r.field().bands)};
    }
    baked.overlay = std::make_shared<const OverlayData>(
        makeOverlay(*baked.bake, scene, *wanted, lit ? &*lit : nullptr));
    return {};
}

Result<Baked> prepareBake(const Options& options, Scene& scene, const Camera& camera) {
    const bool light = needsIndirect(View(indexOf(kViewNames, options.view)));
    if (scene.instances.empty() || !(light || options.overlay.wanted()))
        return Baked{}; // nothing receives light, or nobody asks
    Baked baked;
    baked.trace = std::make_shared<const TraceScene>(scene);
    Result<Bake> made = obtainBake(options, scene, *baked.trace);
    if (!made)
        return tl::make_unexpected(made.error());
    baked.bake = std::make_shared<const Bake>(std::move(*made));
    if (options.overlay.wanted())
        if (const Result<void> added = addOverlay(options, scene, *baked.trace, camera, baked);
            !added)
            return tl::make_unexpected(added.error());
    baked.light = light;
    if (light && !options.allCaches)
        baked.seen = seenCaches(cacheFootprints(scene, *baked.bake), camera,
                                float(options.camera.width) / float(options.camera.height));
    return baked;
}

// Before anything is read or baked for it.
Result<void> checkOverlay(const Options& options) {
    if (!options.overlay.wanted())
        return checkOverlayFlags(options.overlay);
    if (std::filesystem::path(options.output).extension() != ".png")
        return fail("--overlay: is drawn on a tone-mapped picture; -o must be a .png");
    if (options.device == "cpu")
        return fail("--overlay: needs a Vulkan device");
    return checkOverlayFlags(options.overlay);
}

Result<void> checkRelight(const Options& options) {
    if (options.relight == "gpu" && options.device == "cpu")
        return fail("--relight gpu: needs a Vulkan device that draws; not --device cpu");
    return {};
}

// "auto" takes the CPU where there is no Vulkan; a device asked for by name must be there.
Result<RenderedImage> draw(const Options& options, const Scene& scene,
                           const RenderRequest& request) {
    if (options.device == "cpu")
        return renderOnCpu(scene, request);
#ifdef LIMN_HAS_VIEWPORT
    Result<RenderedImage> image = renderOnGpu(scene, request);
    if (image || options.device != "auto" || request.overlay || request.relightOn == RelightOn::Gpu)
        return image;
    logWarning(fmt::format("drawing on the CPU: {}", image.error().message));
#else
    if (options.device != "auto" || request.overlay || request.relightOn == RelightOn::Gpu)
        return fail("--device: this program was built without Vulkan; there is: cpu");
#endif
    return renderOnCpu(scene, request);
}

RenderRequest requestOf(const Options& options, const Scene& scene, const Camera& camera,
                        Baked& baked) {
    RenderRequest request;
    request.view = View(indexOf(kViewNames, options.view));
    request.camera = camera;
    request.width = options.camera.width;
    request.height = options.camera.height;
    request.tonemap = Tonemap(indexOf(kTonemapNames, options.tonemap));
    request.exposureEv = options.exposureEv;
    request.tonemapped = std::filesystem::path(options.output).extension() == ".png";
    request.device = options.device == "auto" ? "" : options.device;
    if (baked.light)
        request.relight = [&] { return relight(scene, baked); };
    request.bake = baked.bake;
    request.relightOn = RelightOn(indexOf(kRelightOnNames, options.relight));
    request.overlay = baked.overlay;
    return request;
}

void report(const Options& options, const RenderedImage& image, const OverlayData* overlay,
            double seconds) {
    const std::uint64_t invalid = countInvalidPixels(image.linear);
    if (options.json) {
        nlohmann::ordered_json json;
        json["seconds"] = seconds; // without reading the scene
        json["device"] = image.device;
        json["view"] = options.view;
        json["width"] = image.linear.width;
        json["height"] = image.linear.height;
        json["invalid_pixels"] = invalid;
        if (!image.relightDevice.empty())
            json["relight"] = {{"device", image.relightDevice},
                               {"ms", image.relight.totalMs},
                               {"bounces", image.relight.bounces},
                               {"converged", image.relight.converged},
                               {"caches_unseen", image.relight.cachesUnseen},
                               {"caches_unread", image.relight.cachesUnread}};
        if (overlay)
            json["overlay"] = legendJson(overlay->legend);
        fmt::print("{}\n", json.dump());
        return;
    }
    std::string relit;
    if (!image.relightDevice.empty())
        relit =
            fmt::format("relit on {} in {:.1f} ms, ", image.relightDevice, image.relight.totalMs);
    fmt::print("{}: {}, {} x {} on {}, {}{} invalid pixels, {:.1f} s\n", options.output,
               options.view, image.linear.width, image.linear.height, image.device, relit, invalid,
               seconds);
    if (overlay)
        fmt::print("{}", legendText(overlay->legend));
}

Exit runRender(const Options& options) {
    const std::string extension = std::filesystem::path(options.output).extension().string();
    if (const Result<void> writable = checkOutputFile(options.output, {".exr", ".png"}); !writable)
        return failed(writable.error().message);
    if (const Result<void> possible = checkOverlay(options); !possible)
        return failed(possible.error().message);
    if (const Result<void> possible = checkRelight(options); !possible)
        return failed(possible.error().message);
    const Result<ImportedScene> imported = openScene(options.scene);
    if (!imported)
        return failed(imported.error().message);
    Scene scene = flatten(imported->document, imported->assets, options.scene.seconds);
    scene.bake.dimming = scene.bake.dimming && !options.noDimming;
    const Result<Camera> camera = chooseCamera(scene, options.camera);
    if (!camera)
        return failed(camera.error().message);

    const auto start = std::chrono::steady_clock::now();
    Result<Baked> baked = prepareBake(options, scene, *camera);
    if (!baked)
        return failed(baked.error().message);
    const Result<RenderedImage> image =
        draw(options, scene, requestOf(options, scene, *camera, *baked));
    if (!image)
        return failed(image.error().message);
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const Result<void> written = extension == ".png" ? writePng(options.output, image->picture)
                                                     : writeExr(options.output, image->linear);
    if (!written)
        return failed(written.error().message);
    report(options, *image, baked->overlay.get(), seconds);
    return Exit::Done;
}

} // namespace

void addRenderCommand(CLI::App& app, Run& run) {
    const auto options = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("render", "Draws one picture, as the viewport shows it");
    addSceneOptions(*command, options->scene);
    addTimeOption(*command, options->scene);
    addCameraOptions(*command, options->camera);
    addOverlayFlags(*command, options->overlay);
    command->add_option("--bake", options->bake,
                        ".limnbake of this scene; without it, one is made in memory if needed");
    command
        ->add_option("-o,--output", options->output, "picture: .exr (linear) or .png (tone-mapped)")
        ->required();
    command->add_option("--view", options->view, "what it shows")
        ->check(CLI::IsMember(strings(kViewNames)));
    command->add_option("--exposure", options->exposureEv, "stops before tone mapping [EV]")
        ->check(CLI::Range(-64.0, 64.0));
    command->add_option("--tonemap", options->tonemap, "curve of a .png")
        ->check(CLI::IsMember(strings(kTonemapNames)));
    command->add_option("--device", options->device,
                        "auto, cpu, or part of a Vulkan device's name");
    command
        ->add_option(
            "--relight", options->relight,
            "where bounced light is worked out: cpu, gpu (the Vulkan device that draws), or "
            "auto, which the editor has found faster here; cpu until it has")
        ->check(CLI::IsMember(strings(kRelightOnNames)));
    command->add_flag("--no-dimming", options->noDimming,
                      "dynamic objects do not keep bounced light off what is behind them");
    command->add_flag("--all-caches", options->allCaches,
                      "light the whole lightmap on the CPU, not only what the picture looks up");
    command->add_flag("--json", options->json, "one JSON object on stdout");
    command->callback([options, &run] { run = [options] { return runRender(*options); }; });
}

} // namespace limn
