// SPDX-License-Identifier: MIT
#include "app/bench/bench.h"
#include "app/bench/bench_generated.h"
#include "app/bench/settings_sweep.h"
#include "app/commands/progress_line.h"
#include "app/commands/scene_options.h"
#include "app/techniques/illuminance/illuminance_program.h"

#include "engine/core/parallel.h"
#include "engine/json/json.h"
#include "engine/lightmap/atlas_stage.h"
#include "engine/measure/seams.h"
#include "engine/scene/bake_settings_fields.h"
#include "engine/scene/mesh/input_hash.h"
#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/format/bake_bytes.h"
#include "engine/techniques/illuminance/measure/cache_error.h"
#include "engine/techniques/illuminance/relight/relight.h"

#include <algorithm>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

namespace limn {

namespace {

struct ErrorBench {
    SceneOptions common; ///< lights and sky of every scene
    std::vector<std::string> scenes;
    std::string output;
    GeneratedBench generated; ///< instead of scenes, where it has some
    SettingsSweep sweep;
    std::uint32_t caches = 1000, referenceRays = 16384;
    int threads = 0;
    bool json = false;
};

/// Values tried if the command line gives none; generated scenes use only the defaults.
const SettingsSweep kUsualSweep = {{"surfels", {"16384", "32768", "131072"}},
                                   {"links", {"32", "64", "128", "256", "512"}},
                                   {"cut", {"solid-angle", "detail"}},
                                   {"clustering", {"kd", "agglomerative"}},
                                   {"rays", {"1024"}},
                                   {"lightmapCaches", {"10000"}}};

/// Result of the same bake with a link to every visible sender, which isolates the error of the
/// cut.
CacheReference withoutCut(const TraceScene& trace, const std::shared_ptr<const Bake>& bake) {
    Relighter relighter(bake, LitBands::All);
    relighter.relight(trace.scene(), trace, 1); // reflected once
    const std::vector<glm::vec3>& sh = relighter.cacheSh();
    const int bands = int(bake->settings.bands);
    CacheReference result;
    for (std::uint32_t c = 0; c < bake->caches.lightmapCount; ++c) {
        result.cache.push_back(c);
        result.irradiance.push_back(cacheIrradiance(bake->caches, bands, sh, c));
    }
    return result;
}

Json describe(const std::string& scene, const BakeSettings& s, const Bake& bake,
              const CacheError& error, const CacheError& cutError) {
    double seconds = 0, cut = 0;
    for (const auto& [stage, t] : bake.seconds) {
        seconds += t;
        cut = stage == "cut" ? t : cut;
    }
    return {{"name", scene},
            {"surfels", s.surfels},
            {"linker", kLinkerNames[std::size_t(s.linker)]},
            {"clustering", kClusteringNames[std::size_t(s.clustering)]},
            {"cut", kCutNames[std::size_t(s.cut)]},
            {"links", s.links},
            {"nrmse", error.nrmse},
            {"nrmse_without_worst_percent", error.nrmseTrimmed},
            {"bias", error.bias},
            {"cut_nrmse", cutError.nrmse},
            {"cut_nrmse_without_worst_percent", cutError.nrmseTrimmed},
            {"seconds", seconds},
            {"cut_seconds", cut},
            {"rays", bake.counts.rays},
            {"links_in_all", bake.counts.links},
            {"bytes", bytesOf(bake).total()}};
}

constexpr Column kErrorColumns[] = {{"scene", -14, "name"},
                                    {"surfels", 7, "surfels"},
                                    {"linker", -11, "linker"},
                                    {"clustering", -13, "clustering"},
                                    {"cut", -11, "cut"},
                                    {"links", 5, "links"},
                                    {"nRMSE", 8, "nrmse", 4},
                                    {"-1 %", 8, "nrmse_without_worst_percent", 4},
                                    {"bias [%]", 8, "bias", 2, 100},
                                    {"cut only", 8, "cut_nrmse", 4},
                                    {"-1 %", 8, "cut_nrmse_without_worst_percent", 4},
                                    {"seam", 6, "seam", 3},
                                    {"bake [s]", 8, "seconds"},
                                    {"cut [s]", 7, "cut_seconds"},
                                    {"MiB", 8, "bytes", 2, kMiB}};

Result<void> measureScene(const ErrorBench& o, const std::string& path, Json& rows) {
    SceneOptions options = o.common;
    options.scene = path;
    const Result<ImportedScene> imported = openScene(options);
    if (!imported)
        return tl::make_unexpected(imported.error());
    Scene scene = flatten(imported->document, imported->assets);
    const std::string name = std::filesystem::path(path).stem().string();
    StageStore store;
    CacheReference reference, uncut;
    BakeSettings uncutFor;
    uncutFor.surfels = 0;
    for (const BakeSettings& settings : sweepRows(o.sweep)) {
        scene.bake = settings;
        const TraceScene trace(scene);
        if (reference.cache.empty()) {
            std::uint64_t rays = 0;
            const auto atlas = atlasStage(trace, scene, hashMeshes(scene), {}, &store, rays);
            CachePoints points;
            const Caches caches = placeCaches(scene, atlas->atlas, points);
            reference = referenceIrradiance(trace, caches, points, o.caches, o.referenceRays,
                                            progressOnStderr());
            endProgressLine();
            if (!o.json)
                fmt::print("{}: {} of {} caches, noise of the reference {:.4f}\n", name,
                           reference.cache.size(), caches.size(), reference.noise);
        }
        if (uncutFor.surfels != settings.surfels || uncutFor.linker != settings.linker ||
            uncutFor.clustering != settings.clustering) {
            uncutFor = settings;
            scene.bake.cut = CutCriterion::SolidAngle;
            scene.bake.links = 4096;
            const TraceScene whole(scene);
            Result<Bake> made = bake(whole, {}, &store);
            if (!made)
                return fail(fmt::format("{}: {}", path, made.error().message));
            uncut = withoutCut(whole, std::make_shared<const Bake>(std::move(*made)));
        }
        Result<Bake> made = bake(trace, {}, &store);
        if (!made)
            return fail(fmt::format("{}: {}", path, made.error().message));
        const auto baked = std::make_shared<const Bake>(std::move(*made));
        Relighter relighter(baked, LitBands::All);
        relighter.relight(trace.scene(), trace, 1); // reflected once
        const std::vector<glm::vec3>& sh = relighter.cacheSh();
        const int bands = int(settings.bands);
        Json row =
            describe(name, settings, *baked, compareCaches(reference, baked->caches, bands, sh),
                     compareCaches(uncut, baked->caches, bands, sh));
        row["seam"] = measureSeams(scene, baked->lightmap, relighter.field()).relative();
        row["reference_noise"] = reference.noise;
        if (!o.json)
            printRow(kErrorColumns, row);
        rows.push_back(std::move(row));
    }
    return {};
}

Exit runErrorBench(const ErrorBench& o) {
    const ThreadLimit threads(o.threads);
    if (o.generated.scenes > 0)
        return runGeneratedBench(o.generated, sweepRows(o.sweep));
    if (!o.json)
        printTitles(kErrorColumns);
    Json rows = Json::array();
    for (const std::string& scene : o.scenes)
        if (const Result<void> measured = measureScene(o, scene, rows); !measured)
            return failed(measured.error().message);
    return writeRows(rows, o.output, "error", o.json);
}

} // namespace

void addErrorBench(Command& bench) {
    const auto o = std::make_shared<ErrorBench>();
    Command command = bench.addCommand(
        "error",
        "Error of the caches' irradiance against a converged gather, over a sweep of settings");
    command.option("scenes", o->scenes,
                   "Scenes (.gltf, .glb), projects (.limn), names of sample projects, or "
                   "generated:SEED");
    addGeneratedOptions(command, o->generated);
    addLightOptions(command, o->common);
    command.option("-o,--output", o->output, "Folder for error.csv and error.json").required();
    addSweepOptions(command, o->sweep);
    command.option("--caches", o->caches, "Number of caches to compare").within(1, 1 << 24);
    command
        .option("--reference-rays", o->referenceRays,
                "Rays of the reference for each compared cache")
        .within(64, 1 << 24);
    command.option("--threads", o->threads, "Threads to use; 0: all").within(0, 1024);
    command.flag("--json", o->json, "Print one JSON object to stdout");
    command.onRun(
        [o] {
            o->generated.output = o->output;
            o->generated.json = o->json;
            return runErrorBench(*o);
        },
        [o]() -> std::string {
            if (o->scenes.empty() == (o->generated.scenes == 0))
                return "scenes: give either scenes or --generated";
            if (o->generated.scenes > 0)
                return {};
            o->sweep.insert(kUsualSweep.begin(), kUsualSweep.end());
            return o->sweep["rays"].size() == 1 && o->sweep["lightmapCaches"].size() == 1
                       ? ""
                       : "--rays, --lightmap: are lists with --generated only";
        });
}

} // namespace limn
