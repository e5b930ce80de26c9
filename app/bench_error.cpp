// SPDX-License-Identifier: MIT
#include "app/bench.h"
#include "app/progress_line.h"
#include "app/scene_options.h"

#include "engine/bake/atlas_stage.h"
#include "engine/bake/bake_bytes.h"
#include "engine/bake/input_hash.h"
#include "engine/core/parallel.h"
#include "engine/files/document_fields.h"
#include "engine/measure/cache_error.h"
#include "engine/measure/seams.h"
#include "engine/relight/relight.h"

#include <algorithm>
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace limn {

namespace {

struct ErrorBench {
    SceneOptions common; ///< lights and sky of every scene
    std::vector<std::string> scenes;
    std::string output;
    std::vector<std::uint32_t> surfels = {16384, 32768, 131072}, links = {32, 64, 128, 256, 512};
    std::vector<std::string> linkers = {"gather"};
    std::vector<std::string> cuts = {"solid-angle", "detail"};
    std::vector<std::string> clusterings = {"kd", "agglomerative"};
    std::uint32_t rays = 1024, bands = 3, lightmap = 10000;
    std::uint32_t caches = 1000, referenceRays = 16384;
    int threads = 0;
    bool json = false;
};

/// The settings of every row, so that what is traced stays known from row to row.
std::vector<BakeSettings> sweep(const ErrorBench& o) {
    std::vector<BakeSettings> rows;
    BakeSettings s;
    s.rays = o.rays;
    s.bands = o.bands;
    s.lightmapCaches = o.lightmap;
    for (const std::uint32_t surfels : o.surfels)
        for (const std::string& linker : o.linkers)
            for (const std::string& clustering : o.clusterings)
                for (const std::string& cut : o.cuts)
                    for (const std::uint32_t links : o.links) {
                        s.surfels = surfels;
                        s.linker = named<Linker>(kLinkerNames, linker);
                        s.clustering = named<Clustering>(kClusteringNames, clustering);
                        s.cut = named<CutCriterion>(kCutNames, cut);
                        s.links = links;
                        rows.push_back(s);
                    }
    return rows;
}

/// What the same bake gives with a link to every sender in sight, to tell the cut's own error.
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
            {"nrmse_without_worst_percent", error.nrmseMost},
            {"bias", error.bias},
            {"cut_nrmse", cutError.nrmse},
            {"cut_nrmse_without_worst_percent", cutError.nrmseMost},
            {"seconds", seconds},
            {"cut_seconds", cut},
            {"rays", bake.counts.rays},
            {"links_in_all", bake.counts.links},
            {"bytes", bytesOf(bake).total()}};
}

constexpr Column kColumns[] = {{"scene", -14, "name"},
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
    for (const BakeSettings& settings : sweep(o)) {
        scene.bake = settings;
        const TraceScene trace(scene);
        if (reference.cache.empty()) {
            std::uint64_t rays = 0;
            const auto atlas = atlasStage(trace, scene, hashMeshes(scene), {}, &store, rays);
            CachePoints points;
            const Caches caches = placeCaches(scene, *atlas, points);
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
            printRow(kColumns, row);
        rows.push_back(std::move(row));
    }
    return {};
}

Exit runErrorBench(const ErrorBench& o) {
    const ThreadLimit threads(o.threads);
    if (!o.json)
        printTitles(kColumns);
    Json rows = Json::array();
    for (const std::string& scene : o.scenes)
        if (const Result<void> measured = measureScene(o, scene, rows); !measured)
            return failed(measured.error().message);
    return writeRows(rows, o.output, "error", o.json);
}

} // namespace

void addErrorBench(CLI::App& bench, Run& run) {
    const auto o = std::make_shared<ErrorBench>();
    CLI::App* command = bench.add_subcommand(
        "error", "Irradiance of caches against a converged gather, over a sweep of settings");
    command->add_option("scenes", o->scenes, ".gltf, .glb or .limn files, or names of projects")
        ->required();
    addLightOptions(*command, o->common);
    command->add_option("-o,--output", o->output, "folder of error.csv and error.json")->required();
    addList(*command, "--surfels", o->surfels, "n_S, a list", CLI::Range(64, 1 << 20));
    addList(*command, "--links", o->links, "n_L, a list", CLI::Range(1, 4096));
    addList(*command, "--linker", o->linkers, "a list of linkers", oneOf(kLinkerNames));
    addList(*command, "--cut", o->cuts, "a list of cuts", oneOf(kCutNames));
    addList(*command, "--clustering", o->clusterings, "a list of clusterings",
            oneOf(kClusteringNames));
    command->add_option("--rays", o->rays, "of a cache")->check(CLI::Range(16, 65536));
    command->add_option("--bands", o->bands, "SH bands")->check(CLI::Range(2, 8));
    command->add_option("--lightmap", o->lightmap, "wanted caches")->check(CLI::Range(1, 1 << 24));
    command->add_option("--caches", o->caches, "how many are compared")
        ->check(CLI::Range(1, 1 << 24));
    command->add_option("--reference-rays", o->referenceRays, "of a cache that is compared")
        ->check(CLI::Range(64, 1 << 24));
    command->add_option("--threads", o->threads, "0: all")->check(CLI::Range(0, 1024));
    command->add_flag("--json", o->json, "one JSON object on stdout");
    command->callback([o, &run] { run = [o] { return runErrorBench(*o); }; });
}

} // namespace limn
