// SPDX-License-Identifier: MIT
#include "app/commands/command.h"
#include "app/commands/output_file.h"
#include "app/commands/overlay_options.h"
#include "app/commands/progress_line.h"
#include "app/commands/read_bake_of.h"
#include "app/commands/relight_options.h"
#include "app/commands/render_image.h"
#include "app/commands/scene_options.h"
#include "app/commands/technique_options.h"
#include "app/commands/tone_options.h"

#include "engine/core/log.h"
#include "engine/export/baked_light.h"
#include "engine/files/image_file.h"
#include "engine/json/json.h"
#include "engine/lightmap/atlas.h"
#include "engine/measure/compare.h"
#include "engine/techniques/technique_table.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

namespace limn {

namespace {

struct RenderCommand {
    SceneOptions scene;
    CameraOptions camera;
    OverlayFlags overlay;
    TechniqueOptions technique;
    ToneOptions tone;
    std::string bake, output, view = "lit", inspection = "none", device = "auto", relight = "auto";
    std::uint32_t samplesPerPixel = kFileSamples.perPixel;
    std::uint32_t gatherRays = kFileSamples.gatherRays;
    std::uint32_t nearRays = kFileSamples.nearRays;
    std::uint32_t frames = 1;
    double framesPerSecond = 24;
    GivenSettings relighting; ///< instead of the document's
    bool allCaches = false, bakedLight = false, json = false;
};

/// What a picture needs besides the scene: indirect light and an overlay. Empty if it needs
/// neither.
struct Baked {
    const Technique* technique = nullptr;
    Prepared prepared;                            ///< by the technique, where it precomputes
    std::shared_ptr<const LightmapLayout> layout; ///< of the light
    std::shared_ptr<const TraceScene> trace;
    bool light = false;                 ///< the picture shows bounced light
    Viewpoint view;                     ///< of the picture
    bool lightAll = true;               ///< light must be up to date out of view, too
    std::unique_ptr<Lighting> lighting; ///< made when the CPU has to light
    /// The light of an exported lightmap, which takes the place of all that.
    std::shared_ptr<const BakedLight> exported;
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

// Reads the bake, or makes one with the document's settings.
Result<std::shared_ptr<const Precomputed>> obtainBake(const RenderCommand& options,
                                                      const Precomputation& precomputation,
                                                      Scene& scene, const TraceScene& trace) {
    if (options.bake.empty()) {
        auto made = precomputation.prepare(trace, {}, progressOnStderr());
        endProgressLine();
        return made;
    }
    return readBakeOf(scene, options.scene.scene, precomputation, options.bake,
                      options.scene.import.memory);
}

CpuLight relight(const Scene& scene, Baked& baked, bool reflections) {
    if (!baked.lighting) // an overlay of light has made it already
        baked.lighting = baked.technique->light(baked.prepared);
    LightingReport report = baked.lighting->update(
        {.scene = scene,
         .trace = baked.trace.get(),
         .bounces = scene.relight.maxBounces,
         .view = baked.lightAll ? viewForAll(*baked.lighting, baked.view) : &baked.view,
         .reflections = reflections},
        progressOnStderr());
    endProgressLine();
    return {*baked.lighting->field(), std::move(report)};
}

Result<void> addOverlay(const RenderCommand& options, const Scene& scene, const Camera& camera,
                        Baked& baked) {
    std::shared_ptr<const LightSnapshot> lit;
    if (overlayKindOf(options.overlay)->showsLight) {
        relight(scene, baked, false);
        lit = baked.lighting->snapshot();
    }
    const OverlaySource* source = baked.prepared.data.get();
    if (!source)
        source = lit.get();
    const Result<OverlayRequest> wanted =
        overlayRequest(options.overlay, *source, *baked.trace, camera, options.camera.width,
                       options.camera.height);
    if (!wanted)
        return tl::make_unexpected(wanted.error());
    baked.overlay = std::make_shared<const OverlayData>(source->overlay(*wanted, scene, lit.get()));
    return {};
}

/// Reads the light of an exported scene. Lamps whose direct light it has are put out.
Result<Baked> readExported(const RenderCommand& options, Scene& scene) {
    Result<BakedLight> light =
        readBakedLight(options.scene.scene, scene, options.scene.import.memory);
    if (!light)
        return tl::make_unexpected(light.error());
    if (light->hasDirectLight)
        scene.lights.clear();
    Baked baked;
    baked.exported = std::make_shared<const BakedLight>(std::move(*light));
    baked.layout = {baked.exported, &baked.exported->layout};
    baked.light = showsBouncedLight(View(indexOf(kViewNames, options.view)));
    return baked;
}

Result<Baked> prepareBake(const RenderCommand& options, Scene& scene, const Camera& camera) {
    if (options.bakedLight)
        return readExported(options, scene);
    const bool light = showsBouncedLight(View(indexOf(kViewNames, options.view)));
    if (scene.instances.empty() || !(light || options.overlay.wanted()))
        return Baked{}; // nothing receives light, or nobody asks
    Baked baked;
    baked.view = viewpointOf(camera, {options.camera.width, options.camera.height});
    baked.trace = std::make_shared<const TraceScene>(scene);
    baked.technique = findTechnique(scene.technique.technique);
    if (options.overlay.wanted())
        if (const auto fits = checkOverlayTechnique(options.overlay, *baked.technique); !fits)
            return tl::make_unexpected(fits.error());
    const Precomputation* precomputation = baked.technique->precomputation;
    if (!precomputation) {
        if (!options.bake.empty())
            return fail(fmt::format("--bake: is a bake, and the technique \"{}\" needs none",
                                    baked.technique->name));
        baked.layout = std::make_shared<const LightmapLayout>(layoutWithoutLightmap(scene));
        if (options.overlay.wanted())
            if (const Result<void> added = addOverlay(options, scene, camera, baked); !added)
                return tl::make_unexpected(added.error());
        baked.light = light;
        return baked;
    }
    const auto made = obtainBake(options, *precomputation, scene, *baked.trace);
    if (!made)
        return tl::make_unexpected(made.error());
    baked.prepared = {*made, std::make_shared<const Scene>(scene)};
    baked.layout = {*made, &(*made)->layout()}; // lives as long as the bake
    if (options.overlay.wanted())
        if (const Result<void> added = addOverlay(options, scene, camera, baked); !added)
            return tl::make_unexpected(added.error());
    baked.light = light;
    // What rays meet may be out of view.
    baked.lightAll = options.allCaches || options.nearRays > 0 || options.gatherRays > 0;
    return baked;
}

// Checks the overlay before anything is read or baked for it.
Result<void> checkOverlay(const RenderCommand& options) {
    if (!options.overlay.wanted())
        return checkOverlayFlags(options.overlay);
    if (std::filesystem::path(options.output).extension() != ".png")
        return fail("--overlay: is drawn on a tone-mapped picture; -o must be a .png");
    if (options.device == "cpu")
        return fail("--overlay: needs a Vulkan device");
    if (options.frames > 1)
        return fail("--overlay: is of one picture; not with --frames");
    return checkOverlayFlags(options.overlay);
}

bool inspects(const RenderCommand& options) {
    return options.inspection != kInspectionNames[0];
}

Result<void> checkInspection(const RenderCommand& options) {
    if (!inspects(options))
        return {};
    if (std::filesystem::path(options.output).extension() != ".png")
        return fail("--inspect: is drawn on a tone-mapped picture; -o must be a .png");
    if (options.device == "cpu")
        return fail("--inspect: needs a Vulkan device");
    return {};
}

/// Baked light is drawn on the CPU, and nothing else lights the scene.
Result<void> checkBakedLight(const RenderCommand& options) {
    if (!options.bakedLight)
        return {};
    if (!options.bake.empty() || options.overlay.wanted() || inspects(options))
        return fail("--baked-light: goes with no --bake, --overlay or --inspect");
    if (options.device != "auto" && options.device != "cpu")
        return fail("--baked-light: is drawn on the CPU; not with another --device");
    return {};
}

Result<void> checkRelight(const RenderCommand& options) {
    if (options.relight == "gpu" && options.device == "cpu")
        return fail("--relight gpu: needs a Vulkan device that draws; not --device cpu");
    return {};
}

// "auto" takes the CPU where there is no Vulkan; a device asked for by name must be there.
Result<DrawPicture> chooseDrawing(const RenderCommand& options) {
    const bool cpuWillDo = options.device == "auto" && !options.overlay.wanted() &&
                           !inspects(options) && options.relight != "gpu";
    if (options.device == "cpu" || options.bakedLight)
        return renderOnCpu;
    Result<DrawPicture> onGpu = drawingOnGpu(options.device == "auto" ? "" : options.device);
    if (!cpuWillDo)
        return onGpu;
    if (!onGpu) {
        logWarning(fmt::format("drawing on the CPU: {}", onGpu.error().message));
        return renderOnCpu;
    }
    return
        [gpu = *onGpu](const Scene& scene, const RenderRequest& request) -> Result<RenderedImage> {
            Result<RenderedImage> image = gpu(scene, request);
            if (image)
                return image;
            logWarning(fmt::format("drawing on the CPU: {}", image.error().message));
            return renderOnCpu(scene, request);
        };
}

RenderRequest requestOf(const RenderCommand& options, const Scene& scene, const Camera& camera,
                        Baked& baked) {
    RenderRequest request;
    request.view = View(indexOf(kViewNames, options.view));
    request.inspection = Inspection(indexOf(kInspectionNames, options.inspection));
    request.camera = camera;
    request.width = options.camera.width;
    request.height = options.camera.height;
    request.tonemap = tonemapOf(options.tone);
    request.exposureEv = options.tone.exposureEv;
    request.samplesPerPixel = options.samplesPerPixel;
    request.nearRays = options.nearRays;
    request.gatherRays = options.gatherRays;
    request.tonemapped = std::filesystem::path(options.output).extension() == ".png";
    if (baked.exported) {
        request.nearRays = request.gatherRays = 0;
        if (baked.light)
            request.relight = [&](bool) { return CpuLight{baked.exported->field, {}}; };
        request.layout = baked.layout;
        return request;
    }
    if (baked.light)
        request.relight = [&](bool reflections) { return relight(scene, baked, reflections); };
    request.emitted = [&] { return baked.lighting->emittedField(scene); };
    request.layout = baked.layout;
    request.technique = baked.technique;
    request.prepared = baked.prepared;
    request.lightAll = baked.lightAll;
    request.relightOn = RelightOn(indexOf(kRelightOnNames, options.relight));
    request.overlay = baked.overlay;
    return request;
}

/// {"device", "ms", "bounces", "converged", "grows"}, the steps' "STEP_ms", and the counters.
Json lightingJson(const std::string& device, const LightingReport& report) {
    Json json = {{"device", device},
                 {"ms", report.totalMs},
                 {"bounces", report.bounces},
                 {"converged", report.converged},
                 {"grows", report.diverges}};
    for (const LightingStep& step : report.steps)
        json[std::string(step.id) + "_ms"] = step.ms;
    for (const LightingCounter& counter : report.counters)
        if (counter.unit == CounterUnit::Count || counter.unit == CounterUnit::Bytes)
            json[counter.id] = std::uint64_t(counter.value);
        else
            json[counter.id] = counter.value;
    return json;
}

Json reportJson(const RenderCommand& options, const RenderedImage& image,
                const OverlayData* overlay, double seconds) {
    Json json;
    json["seconds"] = seconds; // without reading the scene
    json["device"] = image.device;
    json["view"] = options.view;
    json["width"] = image.linear.width;
    json["height"] = image.linear.height;
    json["samples_per_pixel"] = options.samplesPerPixel;
    json["near_rays"] = options.nearRays;
    json["gather_rays"] = options.gatherRays;
    json["invalid_pixels"] = countInvalidPixels(image.linear);
    if (!image.relightDevice.empty())
        json["relight"] = lightingJson(image.relightDevice, image.relight);
    if (image.reflections > 0) {
        json["marched_rays"] = image.reflections;
        json["unknown_rays"] = image.unknownReflections;
    }
    if (overlay)
        json["overlay"] = legendJson(overlay->legend);
    return json;
}

void printReport(const std::string& path, const RenderCommand& options, const RenderedImage& image,
                 const OverlayData* overlay, double seconds) {
    std::string relit;
    if (!image.relightDevice.empty())
        relit =
            fmt::format("relit on {} in {:.1f} ms, ", image.relightDevice, image.relight.totalMs);
    if (image.reflections > 0)
        relit += fmt::format("{} of {} marched reflections unknown, ", image.unknownReflections,
                             image.reflections);
    fmt::print("{}: {}, {} x {} on {}, {}{} invalid pixels, {:.1f} s\n", path, options.view,
               image.linear.width, image.linear.height, image.device, relit,
               countInvalidPixels(image.linear), seconds);
    if (overlay)
        fmt::print("{}", legendText(overlay->legend));
}

// "walk.png" becomes "walk-03.png" for frame 3 of 100; a single frame keeps the name.
std::string framePath(const RenderCommand& options, std::uint32_t frame) {
    if (options.frames == 1)
        return options.output;
    std::filesystem::path path = options.output;
    const std::size_t digits = std::to_string(options.frames - 1).size();
    path.replace_filename(
        fmt::format("{}-{:0{}}{}", path.stem().string(), frame, digits, path.extension().string()));
    return path.string();
}

Result<void> writePicture(const std::string& path, const RenderedImage& image) {
    return path.ends_with(".png") ? writePng(path, image.picture) : writeExr(path, image.linear);
}

// Lighting of each frame starts from the previous one, because animated textures change little in
// between.
Result<void> renderFrames(const RenderCommand& options, const Document& document, Scene& scene,
                          const Camera& camera) {
    using Clock = std::chrono::steady_clock;
    Clock::time_point start = Clock::now();
    const Result<DrawPicture> draw = chooseDrawing(options);
    if (!draw)
        return tl::make_unexpected(draw.error());
    Result<Baked> baked = prepareBake(options, scene, camera);
    if (!baked)
        return tl::make_unexpected(baked.error());
    const RenderRequest request = requestOf(options, scene, camera, *baked);
    auto frames = Json::array();
    for (std::uint32_t frame = 0; frame < options.frames; ++frame) {
        const double time = options.scene.seconds + frame / options.framesPerSecond;
        showTime(scene, document, time);
        const Result<RenderedImage> image = (*draw)(scene, request);
        if (!image)
            return tl::make_unexpected(image.error());
        if (image->relight.diverges)
            logWarning("bounced light grew with every bounce and was stopped: bake again");
        if (image->relight.lacks && showsBouncedLight(request.view))
            logWarning(image->relight.lacks);
        const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
        const std::string path = framePath(options, frame);
        if (const Result<void> written = writePicture(path, *image); !written)
            return written;
        if (options.json) {
            frames.push_back(reportJson(options, *image, baked->overlay.get(), seconds));
            if (options.frames > 1)
                frames.back()["time"] = time, frames.back()["file"] = path;
        } else {
            printReport(path, options, *image, baked->overlay.get(), seconds);
        }
        start = Clock::now();
    }
    if (options.json)
        fmt::print("{}\n", (options.frames > 1 ? Json{{"frames", frames}} : frames[0]).dump());
    return {};
}

Exit runRender(const RenderCommand& options) {
    for (const Result<void>& possible :
         {checkOutputFile(options.output, {".exr", ".png"},
                          {options.scene.scene, options.scene.sky, options.bake}),
          checkOverlay(options), checkInspection(options), checkRelight(options),
          checkBakedLight(options)})
        if (!possible)
            return failed(possible.error().message);
    SceneOptions asked = options.scene;
    asked.import.joinsBacks = !options.bakedLight;
    const Result<ImportedScene> imported = openScene(asked);
    if (!imported)
        return failed(imported.error().message);
    Scene scene = flatten(imported->document, imported->assets, options.scene.seconds);
    applyRelightOptions(options.relighting, scene.relight);
    if (const Result<void> chosen = chooseTechnique(options.technique, scene.technique); !chosen)
        return failed(chosen.error().message);
    const Result<Camera> camera = chooseCamera(scene, options.camera);
    if (!camera)
        return failed(camera.error().message);
    const Result<void> done = renderFrames(options, imported->document, scene, *camera);
    return done ? Exit::Done : failed(done.error().message);
}

} // namespace

void addRenderCommand(Command& app) {
    const auto options = std::make_shared<RenderCommand>();
    Command command = app.addCommand(
        "render", "Draw a picture, or the frames of an animation, as the viewport does");
    addSceneOptions(command, options->scene);
    addTimeOption(command, options->scene);
    command
        .option("--frames", options->frames,
                "Number of pictures, from --time on; each picture's number is inserted before "
                "the extension of the output")
        .within(1, 100000);
    command.option("--fps", options->framesPerSecond, "Pictures per second of --frames [1/s]")
        .within(0.001, 10000.0);
    addCameraOptions(command, options->camera);
    command.option("--spp", options->samplesPerPixel, "Samples per pixel").within(1, 65536);
    command
        .option("--near-rays", options->nearRays,
                "Rays of each sample that look for surfaces within half a texel, whose own "
                "light then takes the place of the lightmap's, where --gather-rays is 0 or "
                "something is drawn over the picture; 0: none")
        .within(0, 1024);
    command
        .option("--gather-rays", options->gatherRays,
                "Rays of each sample that gather light from whatever they meet, which takes "
                "the place of the lightmap's where that is worse; 0: none")
        .within(0, 1024);
    addOverlayFlags(command, options->overlay);
    command.option("--bake", options->bake,
                   "Bake of this scene, .limnbake; default: a bake is made in memory where needed");
    command.flag("--baked-light", options->bakedLight,
                 "Draw an export of Limn's in the light of its lightmap, looked up as engines do");
    command
        .option("-o,--output", options->output,
                "Picture to write, .exr (linear) or .png (tone-mapped)")
        .required();
    addTechniqueOptions(command, options->technique);
    command.option("--view", options->view, "What to show").oneOf(namesIn(kViewNames));
    command
        .option("--inspect", options->inspection,
                "Draw over a .png to find faults: the edges of all triangles, or pixels with "
                "a NaN or Inf")
        .oneOf(namesIn(kInspectionNames));
    addToneOptions(command, options->tone);
    command.option("--device", options->device,
                   "What draws: auto, cpu, or part of a Vulkan device's name");
    command
        .option(
            "--relight", options->relight,
            "Where bounced light is computed: cpu, gpu (the Vulkan device that draws), or auto, "
            "whichever the editor has measured to be faster here; cpu where it has not")
        .oneOf(namesIn(kRelightOnNames));
    addRelightOptions(command, options->relighting);
    command.flag("--all-caches", options->allCaches,
                 "Light the whole lightmap, not only the texels that the picture reads; near rays "
                 "and gathering have it lit anyway");
    command.flag("--json", options->json, "Print one JSON object to stdout");
    command.onRun([options] { return runRender(*options); });
}

} // namespace limn
