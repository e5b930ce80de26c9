// SPDX-License-Identifier: MIT
#include "app/bench/bench.h"
#include "app/commands/progress_line.h"
#include "app/commands/scene_options.h"
#include "app/techniques/illuminance/illuminance_program.h"

#include "engine/core/parallel.h"
#include "engine/files/image_file.h"
#include "engine/picture/field_render.h"
#include "engine/reference/reference.h"
#include "engine/scene/bake_settings_fields.h"
#include "engine/scene/tone_map.h"
#include "engine/shading/pixel_rays.h"
#include "engine/stages/stage_store.h"
#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/relight/relight.h"

#include <cmath>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

namespace limn {

namespace {

struct GlossyBench {
    SceneOptions scene;
    CameraOptions camera{.width = 256, .height = 256};
    std::string object, output;
    std::vector<float> roughnesses = {0.1f, 0.3f, 0.5f, 0.7f, 0.9f};
    std::vector<std::uint32_t> bands = {2, 3, 4, 5, 6, 7, 8};
    std::vector<std::string> storages = {"rtp", "sh"};
    std::uint32_t samplesPerPixel = 256, surfels = 32768, links = 512, lightmap = 40000;
    int threads = 0;
    bool pictures = false, json = false;
};

/// A picture of a metal object, and the pixels that show only that object.
struct GlossyView {
    Scene scene;
    Camera camera;
    std::vector<bool> shown;
    std::uint32_t pixels = 0; ///< shown
    ImageF truth;
    double mean = 0;  ///< of what the truth shows there besides direct light
    double noise = 0; ///< standard error of `truth` there, over `mean`
};

/// Makes the instances of a node a metal with a reflectance of 0.9; returns false if there are
/// none.
bool makeMetal(Scene& scene, const Document& document, const std::string& name, float roughness) {
    Material metal;
    metal.baseColor = {0.9f, 0.9f, 0.9f, 1};
    metal.metallic = 1;
    metal.roughness = roughness;
    scene.materials.push_back(metal);
    bool any = false;
    for (Instance& instance : scene.instances)
        if (objectName(document.objects.at(instance.node)) == name) {
            instance.material = std::uint32_t(scene.materials.size() - 1);
            any = true;
        }
    return any;
}

void findPixels(GlossyView& view, const GlossyBench& o, const TraceScene& trace) {
    const PixelRays rays(view.camera, o.camera.width, o.camera.height);
    const auto metal = std::uint32_t(view.scene.materials.size() - 1);
    for (std::uint32_t y = 0; y < o.camera.height; ++y)
        for (std::uint32_t x = 0; x < o.camera.width; ++x) {
            bool all = true;
            for (const glm::vec2 corner : {glm::vec2(0, 0), {1, 0}, {0, 1}, {1, 1}}) {
                const Hit hit =
                    trace.closestHit(rays.through(glm::vec2(float(x), float(y)) + corner));
                all &= hit && view.scene.instances[hit.instance].material == metal;
            }
            view.shown.push_back(all);
            view.pixels += all;
        }
}

struct PictureError {
    double nrmse = 0, bias = 0;
};

PictureError errorOf(const GlossyView& view, const ImageF& image) {
    double square = 0, sum = 0;
    for (std::size_t i = 0; i < view.shown.size(); ++i)
        if (view.shown[i])
            for (int c = 0; c < 3; ++c) {
                const double d = double(image.rgb[i][c]) - double(view.truth.rgb[i][c]);
                square += d * d;
                sum += d;
            }
    const double values = 3 * view.pixels;
    return {std::sqrt(square / values) / view.mean, sum / values / view.mean};
}

/// Renders two references with different seeds, whose difference is their noise.
void findTruth(GlossyView& view, const GlossyBench& o, const TraceScene& trace) {
    ReferenceOptions options;
    options.camera = view.camera;
    options.width = o.camera.width;
    options.height = o.camera.height;
    options.samplesPerPixel = std::max(o.samplesPerPixel / 2, 1U);
    ImageF half[2];
    for (std::uint32_t k = 0; k < 2; ++k) {
        options.seed = k + 1;
        half[k] = renderReference(trace, options, progressOnStderr()).image;
    }
    FieldRenderOptions direct;
    direct.camera = view.camera;
    direct.width = o.camera.width;
    direct.height = o.camera.height;
    const ImageF lights = renderField(trace, {}, {}, direct); // there is no bounced light
    endProgressLine();
    view.truth = half[0];
    double sum = 0, square = 0;
    for (std::size_t i = 0; i < view.shown.size(); ++i) {
        view.truth.rgb[i] = 0.5f * (half[0].rgb[i] + half[1].rgb[i]);
        if (!view.shown[i])
            continue;
        const glm::vec3 bounced = view.truth.rgb[i] - lights.rgb[i],
                        d = half[0].rgb[i] - half[1].rgb[i];
        sum += double(bounced.x + bounced.y + bounced.z);
        square += double(glm::dot(d, d)) / 4;
    }
    const double values = 3 * view.pixels;
    view.mean = sum / values;
    view.noise = std::sqrt(square / values) / view.mean;
}

Result<void> keepPicture(const GlossyBench& o, const std::string& name, const ImageF& image) {
    if (!o.pictures)
        return {};
    return writePng(fmt::format("{}/{}.png", o.output, name),
                    toneMappedImage(image, Tonemap::Aces, 0));
}

Result<void> measureBake(const GlossyBench& o, const GlossyView& view, float roughness,
                         const BakeSettings& settings, StageStore& store, Json& rows) {
    const TraceScene trace(view.scene);
    Result<Bake> made = bake(trace, progressOnStderr(), &store, &settings);
    endProgressLine();
    if (!made)
        return tl::make_unexpected(made.error());
    const auto baked = std::make_shared<const Bake>(std::move(*made));
    Relighter relighter(baked, LitBands::All);
    relighter.relight(view.scene, trace, view.scene.relight.maxBounces);
    FieldRenderOptions options;
    options.camera = view.camera;
    options.width = o.camera.width;
    options.height = o.camera.height;
    options.allBands = true;
    Json row = {{"name", std::filesystem::path(o.scene.scene).stem().string()},
                {"object", o.object},
                {"roughness", roughness},
                {"bands", settings.bands},
                {"storage", kStorageNames[std::size_t(settings.storage)]}};
    for (const bool windowed : {true, false}) {
        options.windowedLobes = windowed;
        const ImageF image = renderField(trace, relighter.field(), baked->lightmap, options);
        const PictureError error = errorOf(view, image);
        const char* kind = windowed ? "" : "_cut_off";
        row[fmt::format("nrmse{}", kind)] = error.nrmse;
        row[fmt::format("bias{}", kind)] = error.bias;
        const auto kept =
            keepPicture(o,
                        fmt::format("roughness{}-bands{}-{}{}", roughness, settings.bands,
                                    row["storage"].get<std::string>(), kind),
                        image);
        if (!kept)
            return kept;
    }
    row["reference_noise"] = view.noise;
    if (!o.json) {
        fmt::print("{:>9} {:>5} {:<4} {:>8.4f} {:>+7.2f} % {:>8.4f} {:>+7.2f} %\n", roughness,
                   settings.bands, row["storage"].get<std::string>(), row["nrmse"].get<double>(),
                   100 * row["bias"].get<double>(), row["nrmse_cut_off"].get<double>(),
                   100 * row["bias_cut_off"].get<double>());
        std::fflush(stdout);
    }
    rows.push_back(std::move(row));
    return {};
}

Result<void> measureRoughness(const GlossyBench& o, const ImportedScene& imported, float roughness,
                              StageStore& store, Json& rows) {
    GlossyView view;
    view.scene = flatten(imported.document, imported.assets);
    if (!makeMetal(view.scene, imported.document, o.object, roughness))
        return fail(fmt::format("--object: {} has no object {}", o.scene.scene, o.object));
    const Result<Camera> camera = chooseCamera(view.scene, o.camera);
    if (!camera)
        return tl::make_unexpected(camera.error());
    view.camera = *camera;
    const TraceScene trace(view.scene);
    findPixels(view, o, trace);
    if (view.pixels == 0)
        return fail(fmt::format("--object: the camera does not see {}", o.object));
    findTruth(view, o, trace);
    if (!o.json)
        fmt::print("roughness {}: {} pixels of {}, noise of the reference {:.4f}\n", roughness,
                   view.pixels, o.object, view.noise);
    if (const auto kept =
            keepPicture(o, fmt::format("roughness{}-reference", roughness), view.truth);
        !kept)
        return kept;
    BakeSettings settings;
    settings.surfels = o.surfels;
    settings.links = o.links;
    settings.lightmapCaches = o.lightmap;
    for (const std::string& storage : o.storages)
        for (const std::uint32_t bands : o.bands) {
            settings.storage = named<LinkStorage>(kStorageNames, storage);
            settings.bands = bands;
            if (const auto measured = measureBake(o, view, roughness, settings, store, rows);
                !measured)
                return measured;
        }
    return {};
}

Exit runGlossyBench(const GlossyBench& o) {
    const ThreadLimit threads(o.threads);
    const Result<ImportedScene> imported = openScene(o.scene);
    if (!imported)
        return failed(imported.error().message);
    Json rows = Json::array();
    if (const Exit made = writeRows(rows, o.output, "glossy", false); made != Exit::Done)
        return made; // before anything is traced for it
    if (!o.json)
        fmt::print("{:>9} {:>5} {:<4} {:>8} {:>9} {:>8} {:>9}\n", "roughness", "bands", "kind",
                   "nRMSE", "bias", "cut off", "bias");
    StageStore store;
    for (const float roughness : o.roughnesses)
        if (const auto measured = measureRoughness(o, *imported, roughness, store, rows); !measured)
            return failed(measured.error().message);
    return writeRows(rows, o.output, "glossy", o.json);
}

} // namespace

void addGlossyBench(Command& bench) {
    const auto o = std::make_shared<GlossyBench>();
    Command command = bench.addCommand(
        "glossy",
        "Error of reflections in a metal object against the reference, over its roughness "
        "and the bands of bounced light");
    addSceneOptions(command, o->scene);
    addCameraOptions(command, o->camera);
    command.option("--object", o->object, "Name of the node to make metal").required();
    command.option("-o,--output", o->output, "Folder for glossy.csv and glossy.json").required();
    command.option("--roughness", o->roughnesses, "Roughness of the metal, a list")
        .list()
        .within(0.0, 1.0);
    command.option("--bands", o->bands, "SH bands of the caches, a list").list().within(2, 8);
    command.option("--storage", o->storages, "How links are stored, a list")
        .list()
        .oneOf(namesIn(kStorageNames));
    command.option("--spp", o->samplesPerPixel, "Samples per pixel of the reference")
        .within(1, 1 << 24);
    command.option("--surfels", o->surfels, "Surfels n_S").within(64, 1 << 20);
    command.option("--links", o->links, "Links per cache n_L").within(1, 4096);
    command.option("--lightmap", o->lightmap, "Target number of lightmap caches")
        .within(1, 1 << 24);
    command.option("--threads", o->threads, "Threads to use; 0: all").within(0, 1024);
    command.flag("--pictures", o->pictures, "Also write every picture, tone-mapped");
    command.flag("--json", o->json, "Print one JSON object to stdout");
    command.onRun([o] { return runGlossyBench(*o); });
}

} // namespace limn
