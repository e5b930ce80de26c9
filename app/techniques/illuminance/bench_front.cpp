// SPDX-License-Identifier: MIT
#include "app/bench/bench.h"
#include "app/bench/front_page.h"
#include "app/bench/front_scene.h"
#include "app/bench/kept_rows.h"
#include "app/bench/settings_sweep.h"
#include "app/commands/bake_options.h"
#include "app/commands/progress_line.h"
#include "app/program_version.h"
#include "app/techniques/illuminance/illuminance_program.h"

#include "engine/core/parallel.h"
#include "engine/core/replace_file.h"
#include "engine/measure/bounce_times.h"
#include "engine/picture/field_render.h"
#include "engine/scene/surface/receiver_bands.h"
#include "engine/stages/stage_store.h"
#include "engine/techniques/illuminance/illuminance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <thread>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace limn {

namespace {

struct FrontBench {
    SceneOptions common; ///< lights and sky of every scene
    FrontView view;
    std::vector<std::string> scenes;
    std::string output;
    SettingsSweep sweep;
    std::uint32_t liveSamples = 16, gatheredSamples = 64; ///< per pixel of a row's pictures
    int runs = 31, threads = 0;
    std::vector<std::string> presets = {"draft", "medium", "high"};
    bool json = false;
};

/// Values tried if the command line gives none.
const SettingsSweep kFrontSweep = {{"surfels", {"8192", "32768", "131072"}},
                                   {"links", {"16", "64", "256"}},
                                   {"lightmapCaches", {"10000", "36000"}}};

constexpr Column kFrontColumns[] = {{"scene", -12, "scene"},
                                    {"preset", -7, "preset"},
                                    {"surfels", 7, "surfels"},
                                    {"links", 5, "links"},
                                    {"bands", 5, "bands"},
                                    {"chroma", 6, "chroma_bands"},
                                    {"cut", -11, "cut"},
                                    {"kind", -4, "storage"},
                                    {"texels", 7, "caches"},
                                    {"bake [s]", 8, "seconds"},
                                    {"MiB", 8, "bytes", 2, kMiB},
                                    {"ms", 7, "update_ms"},
                                    {"median", 7, "median_ms"},
                                    {"nRMSE", 7, "nrmse", 4},
                                    {"bias %", 7, "bias", 2, 100},
                                    {"gathered", 8, "gathered_nrmse", 4},
                                    {"bias %", 7, "gathered_bias", 2, 100}};

/// The settings to measure: the sweep, and the presets that are not part of it.
std::vector<BakeSettings> frontSettings(const FrontBench& o) {
    std::vector<BakeSettings> rows = sweepRows(o.sweep);
    for (const BakePreset& preset : kBakePresets) {
        BakeSettings s;
        preset.applyTo(s);
        if (std::ranges::count(o.presets, preset.name) > 0 &&
            std::ranges::find(rows, s) == rows.end())
            rows.push_back(s);
    }
    // All bands have colour with 0 chroma bands, with as many as there are, and with more.
    std::vector<BakeSettings> distinct;
    for (BakeSettings s : rows) {
        s.chromaBands = chromaBandsOf(s) == s.bands ? 0 : s.chromaBands;
        if (std::ranges::find(distinct, s) == distinct.end())
            distinct.push_back(s);
    }
    return distinct;
}

std::string presetOf(const BakeSettings& settings) {
    for (const BakePreset& preset : kBakePresets) {
        BakeSettings s;
        preset.applyTo(s);
        if (s == settings)
            return preset.name;
    }
    return {};
}

/// What a row depends on.
std::string keyOf(const FrontBench& o, const FrontScene& front, const BakeSettings& settings) {
    return fmt::format("{}; live {}, gathered {}, runs {}, threads {}; {}", front.key,
                       o.liveSamples, o.gatheredSamples, o.runs,
                       o.threads > 0 ? unsigned(o.threads) : std::thread::hardware_concurrency(),
                       settingsJson(settings).dump());
}

void addError(Json& row, const std::string& prefix, const Comparison& c) {
    row[prefix + "nrmse"] = c.nrmse;
    row[prefix + "nrmse_without_worst_percent"] = c.nrmseTrimmed;
    row[prefix + "bias"] = c.bias;
    row[prefix + "nrmse_noise"] = c.nrmseNoise;
    row[prefix + "bias_noise"] = c.biasNoise;
}

/// Gathered pictures are smaller by this factor, where it divides their size, because a sample
/// takes so long.
constexpr std::uint32_t kGatheredShare = 4;

/// A picture whose pixels are the means of those of `image`, `factor` by `factor` of them. Pixels
/// are boxes, so that it is what a smaller picture of the same view shows.
ImageF smaller(const ImageF& image, std::uint32_t factor) {
    ImageF result{image.width / factor, image.height / factor, {}};
    result.rgb.resize(std::size_t(result.width) * result.height);
    for (std::uint32_t y = 0; y < image.height; ++y)
        for (std::uint32_t x = 0; x < image.width; ++x)
            result.rgb[std::size_t(y / factor) * result.width + x / factor] +=
                image.rgb[std::size_t(y) * image.width + x] / float(factor * factor);
    return result;
}

/// The error of gathered pictures without the noise of their rays: of two pictures t and u whose
/// noise is independent, as that of the references r and s is, nRMSE^2 is the mean of (t - r)(u -
/// s) over the squared mean of the references; 0 where that is negative.
void addGathered(const FrontBench& o, const FrontScene& front, const Lighting& lighting,
                 const LightmapLayout& layout, FieldRenderOptions picture, Json& row) {
    for (const char* key : {"gathered_nrmse", "gathered_bias", "gathered_noise"})
        row[key] = nullptr;
    if (o.gatheredSamples == 0)
        return;
    const bool divides =
        picture.width % kGatheredShare == 0 && picture.height % kGatheredShare == 0;
    const std::uint32_t factor = divides ? kGatheredShare : 1;
    picture.width /= factor;
    picture.height /= factor;
    picture.samplesPerPixel = std::max(o.gatheredSamples / 2, 1U);
    picture.nearRays = kFileSamples.nearRays;
    picture.gatherRays = kFileSamples.gatherRays;
    picture.emitted = lighting.emittedField(front.scene);
    std::array<ImageF, 2> halves;
    for (ImageF& half : halves) {
        half = renderField(*front.trace, *lighting.field(), layout, picture, progressOnStderr());
        ++picture.seed;
    }
    const ImageF r = smaller(front.truth.first(), factor),
                 s = smaller(front.truth.second(), factor);
    double product = 0, noise = 0;
    for (std::size_t p = 0; p < r.rgb.size(); ++p) {
        const glm::dvec3 t = halves[0].rgb[p], u = halves[1].rgb[p], first = r.rgb[p],
                         second = s.rgb[p];
        product += (glm::dot(t - first, u - second) + glm::dot(t - second, u - first)) / 2;
        noise += glm::dot(t - u, t - u) / 4;
    }
    const double values = 3 * double(r.rgb.size()), mean = meanOf(meanImage(r, s));
    row["gathered_nrmse"] = std::sqrt(std::max(product, 0.) / values) / mean;
    row["gathered_bias"] = meanOf(meanImage(halves[0], halves[1])) / mean - 1;
    row["gathered_noise"] = std::sqrt(noise / values) / mean;
}

/// Bakes with the settings and measures what their light costs and how wrong it is.
Result<Json> measureRow(const FrontBench& o, const FrontScene& front, const BakeSettings& settings,
                        StageStore& store) {
    const Technique& technique = kIlluminanceTechnique;
    const auto made = technique.precomputation->prepare(
        *front.trace, {.settings = &settings, .store = &store}, progressOnStderr());
    if (!made)
        return tl::make_unexpected(made.error());
    const PrecomputedReport report = (*made)->report();
    const Prepared prepared{*made, std::make_shared<const Scene>(front.scene)};
    const auto lighting = technique.light(prepared);
    const LightingReport lit = lighting->update({.scene = front.scene,
                                                 .trace = front.trace.get(),
                                                 .bounces = front.scene.relight.maxBounces,
                                                 .reflections = true},
                                                {});
    Json row = {{"scene", front.name}, {"preset", presetOf(settings)}};
    row.update(settingsJson(settings));
    row["chroma_bands"] = chromaBandsOf(settings);
    row["bands_read"] = receiverBands(front.scene, int(settings.bands));
    row["caches"] = std::uint64_t(counterOf(report.counts, "caches"));
    row["seconds"] = totalOf(report.seconds);
    row["bake_bytes"] = totalOf(report.bytes);
    row["bytes"] = totalOf(report.bytes) + counterOf(lit, "light_bytes");
    FieldRenderOptions picture{.view = front.view.view,
                               .camera = front.view.camera,
                               .width = front.view.width,
                               .height = front.view.height,
                               .samplesPerPixel = o.liveSamples};
    const LightmapLayout& layout = (*made)->layout();
    addError(row, "",
             *compareImages(renderField(*front.trace, *lighting->field(), layout, picture),
                            front.truth));
    addGathered(o, front, *lighting, layout, picture, row);
    const BounceTimes times = timeBounces(*lighting, front.scene, *front.trace, o.runs);
    row["update_ms"] = times.least;
    row["median_ms"] = times.median;
    row["p95_ms"] = times.p95;
    row["reference_noise"] = noiseOf(front.truth);
    endProgressLine();
    return row;
}

Result<FrontPageScene> sweepScene(const FrontBench& o, const std::string& path, KeptRows& kept) {
    SceneOptions options = o.common;
    options.scene = path;
    const Result<FrontScene> front = openFrontScene(options, o.view, o.output, progressOnStderr());
    endProgressLine();
    if (!front)
        return tl::make_unexpected(front.error());
    FrontPageScene page{.name = front->name};
    page.note = fmt::format("{} x {} pixels; standard error of a pixel of the reference {:.3f} of "
                            "the mean; surfaces read {} of 8 bands.",
                            front->view.width, front->view.height, noiseOf(front->truth),
                            receiverBands(front->scene, 8));
    StageStore store;
    for (const BakeSettings& settings : frontSettings(o)) {
        const std::string key = keyOf(o, *front, settings);
        if (!kept.find(key)) {
            const Result<Json> row = measureRow(o, *front, settings, store);
            if (!row)
                return fail(
                    fmt::format("{}, {}: {}", path, settingsName(settings), row.error().message));
            if (const Result<void> written = kept.keep(key, *row); !written)
                return tl::make_unexpected(written.error());
        }
        page.rows.push_back(*kept.find(key));
        page.rows.back()["settings"] = settingsName(settings);
        if (!o.json)
            printRow(kFrontColumns, page.rows.back());
    }
    return page;
}

Exit runFrontBench(const FrontBench& o) {
    const ThreadLimit threads(o.threads);
    Result<KeptRows> kept = KeptRows::open(o.output, "front");
    if (!kept)
        return failed(kept.error().message);
    if (!o.json)
        printTitles(kFrontColumns);
    Json rows = Json::array();
    std::vector<FrontPageScene> pages;
    for (const std::string& scene : o.scenes) {
        Result<FrontPageScene> page = sweepScene(o, scene, *kept);
        if (!page)
            return failed(page.error().message);
        markLines(page->rows);
        for (const Json& row : page->rows)
            rows.push_back(row);
        pages.push_back(std::move(*page));
    }
    const std::string note = fmt::format(
        "{}; {} threads; times are the least of {} updates.", programVersion(),
        o.threads > 0 ? unsigned(o.threads) : std::thread::hardware_concurrency(), o.runs);
    if (const Exit written = writeRows(rows, o.output, "front", o.json); written != Exit::Done)
        return written;
    const Result<void> written = replaceFile(o.output + "/front.html", frontPage(pages, note));
    return written ? Exit::Done : failed(written.error().message);
}

} // namespace

void addFrontBench(Command& bench) {
    const auto o = std::make_shared<FrontBench>();
    Command command = bench.addCommand(
        "front", "Error over the time of an update and over memory, over a sweep of settings");
    command
        .option("scenes", o->scenes,
                "Scenes (.gltf, .glb), projects (.limn), names of sample projects, or "
                "generated:SEED")
        .required();
    addLightOptions(command, o->common);
    addCameraOptions(command, o->view.camera);
    command
        .option("-o,--output", o->output,
                "Folder for front.html, front.csv and front.json, which also keeps the references "
                "and each finished row: a run that was stopped goes on from them")
        .required();
    addSweepOptions(command, o->sweep);
    std::vector<std::string> presets = {"none"};
    for (const BakePreset& preset : kBakePresets)
        presets.emplace_back(preset.name);
    command
        .option("--presets", o->presets,
                "Presets to measure beside the sweep, a list, or none; default: all")
        .list()
        .oneOf(presets);
    command.option("--spp", o->view.samplesPerPixel, "Samples per pixel of either reference")
        .within(4, 1 << 20);
    command
        .option("--live-spp", o->liveSamples,
                "Samples per pixel of the pictures of live light, which are not gathered")
        .within(1, 1 << 16);
    command
        .option(
            "--gathered-spp", o->gatheredSamples,
            "Samples per pixel of the gathered pictures, which are a quarter as wide, and whose "
            "noise does not count; 0: none")
        .within(0, 1 << 16);
    command
        .option("--glossy", o->view.glossy,
                "Make every surface half a metal of this roughness, and measure the lit picture")
        .within(0.05, 1.);
    command.option("--runs", o->runs, "Number of timed updates; the least time counts")
        .within(1, 100000);
    command.option("--threads", o->threads, "Threads to use; 0: all").within(0, 1024);
    command.flag("--json", o->json, "Print one JSON object to stdout");
    command.onRun([o] {
        if (o->sweep.empty())
            o->sweep = kFrontSweep;
        return runFrontBench(*o);
    });
}

} // namespace limn
