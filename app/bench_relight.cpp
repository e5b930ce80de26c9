// SPDX-License-Identifier: MIT
#include "app/bench.h"
#include "app/bench_relight_gpu.h"
#include "app/moving_lights.h"
#include "app/progress_line.h"
#include "app/scene_options.h"

#include "engine/bake/stage_store.h"
#include "engine/core/parallel.h"
#include "engine/files/document_fields.h"
#include "engine/measure/read_bandwidth.h"
#include "engine/relight/relight.h"

#include <cmath>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

namespace limn {

namespace {

struct RelightBench {
    SceneOptions common; ///< lights and sky of every scene
    std::vector<std::string> scenes;
    std::string output;
    std::vector<std::uint32_t> surfels = {32768}, links = {128}, bands = {3};
    std::vector<std::uint32_t> chromaBands = {0}; ///< 0: as many as bands
    std::vector<std::string> storages = {"rtp", "sh"};
    std::vector<std::uint32_t> lights = {0}; ///< points in the scene; 0: its own lights
    std::uint32_t rays = 1024, lightmap = 10000;
    std::vector<std::string> devices = {"cpu"}; ///< "cpu", "gpu", or part of a device's name
    int runs = 31, threads = 0;
    bool json = false;
};

std::vector<BakeSettings> sweep(const RelightBench& o) {
    std::vector<BakeSettings> rows;
    BakeSettings s;
    s.rays = o.rays;
    s.lightmapCaches = o.lightmap;
    for (const std::uint32_t surfels : o.surfels)
        for (const std::uint32_t links : o.links)
            for (const std::string& storage : o.storages)
                for (const std::uint32_t bands : o.bands)
                    for (const std::uint32_t chroma : o.chromaBands) {
                        if (chroma > bands)
                            continue;
                        s.surfels = surfels;
                        s.links = links;
                        s.storage = named<LinkStorage>(kStorageNames, storage);
                        s.bands = bands;
                        s.chromaBands = chroma;
                        rows.push_back(s);
                    }
    return rows;
}

struct Spread {
    double median = 0, p95 = 0;
};

Spread spreadOf(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const auto at = [&](double share) {
        return values[std::min(values.size() - 1, std::size_t(share * double(values.size())))];
    };
    return {at(0.5), at(0.95)};
}

/// What a run took, step by step.
struct Step {
    const char* name;
    double RelightStats::*ms;
};
constexpr Step kSteps[] = {{"direct", &RelightStats::directMs},
                           {"surfel_light", &RelightStats::surfelLightMs},
                           {"pull", &RelightStats::pullMs},
                           {"cache_light", &RelightStats::cacheLightMs},
                           {"surfel_read", &RelightStats::surfelReadMs},
                           {"field", &RelightStats::fieldMs},
                           {"total", &RelightStats::totalMs}};

/// One bounce a run, with every light moved.
std::vector<RelightStats> relightOnCpu(const Scene& scene, const TraceScene& trace,
                                       const std::shared_ptr<const Bake>& bake, int runs) {
    Relighter relighter(bake);
    Scene lit = scene;
    std::vector<RelightStats> all;
    for (int k = 0; k <= runs; ++k) {
        lit.lights = movedLights(scene.lights, k);
        const RelightStats stats = relighter.relight(lit, trace, 1);
        if (k > 0) // the first lights materials too
            all.push_back(stats);
    }
    return all;
}

Json describe(const std::string& name, const std::string& device, const Scene& scene,
              const Bake& bake, const std::vector<RelightStats>& runs, double bytesPerSecond) {
    const BakeSettings& s = bake.settings;
    const std::uint64_t bytes = bake.caches.links.size() * sizeof(Link) +
                                bake.caches.shNode.size() * sizeof(std::uint32_t) +
                                bake.caches.shCoefficients.size() * sizeof(std::uint16_t);
    Json row = {{"name", name},
                {"device", device},
                {"surfels", s.surfels},
                {"links", s.links},
                {"bands", s.bands},
                {"chroma_bands", chromaBandsOf(s)},
                {"storage", kStorageNames[std::size_t(s.storage)]},
                {"lights", scene.lights.size()},
                {"caches", bake.caches.size()},
                {"links_in_all", bake.caches.linkCount()},
                {"bytes", bytes},
                {"bytes_per_second", bytesPerSecond},
                {"floor_ms", 1000 * double(bytes) / bytesPerSecond},
                {"shadow_rays", runs.back().shadowRays}};
    for (const Step& step : kSteps) {
        std::vector<double> ms;
        for (const RelightStats& r : runs)
            ms.push_back(r.*step.ms);
        const Spread spread = spreadOf(ms);
        const std::string key =
            step.ms == &RelightStats::totalMs ? "" : std::string(step.name) + "_";
        row[key + "median_ms"] = spread.median;
        row[key + "p95_ms"] = spread.p95;
    }
    return row;
}

void printRow(const Json& r) {
    const auto ms = [&](const char* key) { return r[key].get<double>(); };
    fmt::print("{:<14.14} {:<8.8} {:>6} {:>7} {:>5} {:>5} {:>6} {:<4} {:>8.2f} {:>7.2f} {:>7.2f} "
               "{:>7.2f} {:>7.2f} "
               "{:>7.2f} {:>7.2f} {:>7.2f} {:>8.2f} {:>8.2f}\n",
               r["name"].get<std::string>(), r["device"].get<std::string>(),
               r["lights"].get<std::size_t>(), r["surfels"].get<std::uint32_t>(),
               r["links"].get<std::uint32_t>(), r["bands"].get<std::uint32_t>(),
               r["chroma_bands"].get<std::uint32_t>(), r["storage"].get<std::string>(),
               double(r["bytes"].get<std::uint64_t>()) / (1 << 20), ms("floor_ms"),
               ms("direct_median_ms"), ms("surfel_light_median_ms"), ms("pull_median_ms"),
               ms("cache_light_median_ms"), ms("surfel_read_median_ms"), ms("field_median_ms"),
               ms("median_ms"), ms("p95_ms"));
    std::fflush(stdout);
}

Result<GpuRuns> runsOn(const std::string& device, const Scene& scene, const TraceScene& trace,
                       const std::shared_ptr<const Bake>& bake, int runs) {
    if (device == "cpu")
        return GpuRuns{"cpu", relightOnCpu(scene, trace, bake, runs)};
#ifdef LIMN_HAS_VIEWPORT
    return relightOnGpu(device == "gpu" ? "" : device, scene, trace, bake, runs,
                        [&](int k) { return movedLights(scene.lights, k); });
#else
    return fail("this build has no Vulkan");
#endif
}

Result<void> measureScene(const RelightBench& o, const std::string& path, Json& rows) {
    SceneOptions options = o.common;
    options.scene = path;
    const Result<ImportedScene> imported = openScene(options);
    if (!imported)
        return tl::make_unexpected(imported.error());
    const Scene scene = flatten(imported->document, imported->assets);
    const std::string name = std::filesystem::path(path).stem().string();
    const TraceScene trace(scene);
    StageStore store;
    for (const BakeSettings& settings : sweep(o)) {
        Result<Bake> made = bake(trace, progressOnStderr(), &store, &settings);
        endProgressLine();
        if (!made)
            return fail(fmt::format("{}: {}", path, made.error().message));
        const auto baked = std::make_shared<const Bake>(std::move(*made));
        const double bandwidth = measureReadBandwidth(std::size_t(256) << 20);
        for (const std::uint32_t lights : o.lights) {
            Scene lit = scene;
            if (lights > 0)
                lit.lights = pointsOver(scene, baked->surfels, lights);
            for (const std::string& wanted : o.devices) {
                Result<GpuRuns> measured = runsOn(wanted, lit, trace, baked, o.runs);
                if (!measured)
                    return fail(
                        fmt::format("{} on {}: {}", path, wanted, measured.error().message));
                rows.push_back(
                    describe(name, measured->device, lit, *baked, measured->runs, bandwidth));
                if (!o.json)
                    printRow(rows.back());
            }
        }
    }
    return {};
}

Exit runRelightBench(const RelightBench& o) {
    const ThreadLimit threads(o.threads);
    if (!o.json)
        fmt::print("{:<14} {:<8} {:>6} {:>7} {:>5} {:>5} {:>6} {:<4} {:>8} {:>7} {:>7} {:>7} {:>7} "
                   "{:>7} {:>7} "
                   "{:>7} {:>8} {:>8}\n",
                   "scene", "device", "lights", "surfels", "links", "bands", "chroma", "kind",
                   "MiB", "floor", "direct", "surfels", "pull", "caches", "read", "field",
                   "all [ms]", "p95");
    Json rows = Json::array();
    for (const std::string& scene : o.scenes)
        if (const Result<void> measured = measureScene(o, scene, rows); !measured)
            return failed(measured.error().message);
    return writeRows(rows, o.output, "relight", o.json);
}

} // namespace

void addRelightBench(CLI::App& bench, Run& run) {
    const auto o = std::make_shared<RelightBench>();
    CLI::App* command = bench.add_subcommand(
        "relight", "Time of each step of relighting while all lights move, one bounce a run");
    command->add_option("scenes", o->scenes, ".gltf, .glb or .limn files, or names of projects")
        ->required();
    addLightOptions(*command, o->common);
    command->add_option("-o,--output", o->output, "folder of relight.csv and relight.json")
        ->required();
    const auto list = [&](const char* flag, auto& values, const char* text, const auto& check) {
        command->add_option(flag, values, text)->delimiter(',')->check(check);
    };
    list("--surfels", o->surfels, "n_S, a list", CLI::Range(64, 1 << 20));
    list("--links", o->links, "n_L, a list", CLI::Range(1, 4096));
    list("--bands", o->bands, "SH bands, a list", CLI::Range(2, 8));
    list("--chroma-bands", o->chromaBands, "of colour, a list; 0: all", CLI::Range(0, 8));
    list("--lights", o->lights, "moving point lights, a list; 0: those of the scene",
         CLI::Range(0, 4096));
    list("--storage", o->storages, "a list of link storages", oneOf(kStorageNames));
    command->add_option("--rays", o->rays, "of a cache")->check(CLI::Range(16, 65536));
    command->add_option("--lightmap", o->lightmap, "wanted caches")->check(CLI::Range(1, 1 << 24));
    command->add_option("--device", o->devices, "a list: cpu, gpu, or part of a device's name")
        ->delimiter(',');
    command->add_option("--runs", o->runs, "of which the median is printed")
        ->check(CLI::Range(1, 100000));
    command->add_option("--threads", o->threads, "0: all")->check(CLI::Range(0, 1024));
    command->add_flag("--json", o->json, "one JSON object on stdout");
    command->callback([o, &run] { run = [o] { return runRelightBench(*o); }; });
}

} // namespace limn
