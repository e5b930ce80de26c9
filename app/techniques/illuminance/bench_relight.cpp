// SPDX-License-Identifier: MIT
#include "app/bench/moving_lights.h"
#include "app/techniques/illuminance/bench_bakes.h"
#include "app/techniques/illuminance/bench_relight_gpu.h"
#include "app/techniques/illuminance/illuminance_program.h"

#include "engine/lighting/fastest_update.h"
#include "engine/measure/read_bandwidth.h"
#include "engine/techniques/illuminance/relight/bouncing.h"
#include "engine/techniques/illuminance/relight/relight.h"
#include "engine/techniques/illuminance/relight/seen_caches.h"

#include <cmath>
#include <memory>

#include <fmt/format.h>

namespace limn {

namespace {

struct RelightBench {
    BenchBakes bakes;
    std::string output;
    std::vector<std::uint32_t> lights = {0};    ///< points in the scene; 0: its own lights
    std::vector<std::string> devices = {"cpu"}; ///< "cpu", "gpu", or part of a device's name
    LitBands lit = LitBands::All;
    std::vector<std::string> caches = {"all"}; ///< "all", "seen" by the camera
    CameraOptions camera;
    std::uint32_t bounces = 1; ///< a run
    bool anew = false;         ///< each run begins without bounced light
    int runs = 31;
    bool json = false;
};

/// Name of a step and the member that holds its time.
struct Step {
    const char* name;
    double RelightStats::*ms;
};
constexpr Step kSteps[] = {{"direct", &RelightStats::directMs},
                           {"occlusion", &RelightStats::occlusionMs},
                           {"surfel_light", &RelightStats::surfelLightMs},
                           {"pull", &RelightStats::pullMs},
                           {"cache_light", &RelightStats::cacheLightMs},
                           {"surfel_read", &RelightStats::surfelReadMs},
                           {"field", &RelightStats::fieldMs},
                           {"", &RelightStats::totalMs}};

/// Measurements of a device with a bake.
struct Measured {
    std::string device, caches;
    std::vector<RelightStats> runs;
    std::optional<double> nrmse; ///< of the field at what is seen, against that of "all"
};

/// Adds what the caches that are seen hold in a field and in that of all.
void addSeen(FieldDifference& sum, const Caches& caches, const CacheFlags& seen,
             const IndirectField& field, const IndirectField& all) {
    const std::size_t texels = std::size_t(all.lightmapWidth) * all.lightmapHeight;
    for (std::size_t c = 0; c < seen.size(); ++c)
        for (std::size_t i = 0; seen[c] != 0 && i < all.coefficients(); ++i) {
            const std::size_t index = i * texels + caches.texel[c];
            sum.add(field.lightmap[index], all.lightmap[index]);
        }
}

/// The scene of run k, with every light and dynamic object moved.
Scene sceneAt(const RelightBench& o, const Scene& scene, int k) {
    Scene moved = scene;
    if (o.anew)
        moved.relight.maxBounces = o.bounces;
    moved.lights = movedLights(scene.lights, k);
    moveObjects(moved, scene, k);
    return moved;
}

constexpr std::uint32_t kToRest = 64; ///< bounces

/// Moves every light and dynamic object in each run. The variants to be compared take turns.
Result<std::vector<Measured>> relightOnCpu(const RelightBench& o, const Scene& scene,
                                           const BenchBake& baked) {
    const Result<Camera> camera = chooseCamera(scene, o.camera);
    if (!camera)
        return tl::make_unexpected(camera.error());
    const CacheFlags seen = seenCaches(cacheFootprints(scene, *baked.bake), *camera,
                                       float(o.camera.width) / float(o.camera.height));
    std::vector<Measured> all;
    std::vector<std::unique_ptr<Relighter>> relighters;
    std::vector<FieldDifference> differences(o.caches.size());
    std::size_t whole = o.caches.size(); // the one that lights all
    for (const std::string& caches : o.caches) {
        if (caches == "all")
            whole = all.size();
        all.push_back({"cpu", caches, {}, {}});
        relighters.push_back(std::make_unique<Relighter>(baked.bake, o.lit));
    }
    for (int k = 0; k <= o.runs; ++k) {
        const Scene lit = sceneAt(o, scene, k);
        const TraceScene trace(lit, baked.trace);
        for (std::size_t m = 0; m < all.size(); ++m) {
            // The first run also lights materials and continues until the light converges; without
            // lights it would remain converged.
            const bool first = k == 0, toRest = first && !lit.lights.empty();
            const bool every = first || all[m].caches == "all";
            const RelightStats stats = relighters[m]->relight(
                lit, trace, toRest ? kToRest : o.bounces, {}, every ? nullptr : &seen);
            if (k > 0)
                all[m].runs.push_back(stats);
        }
        for (std::size_t m = 0; k > 0 && whole < all.size() && m < all.size(); ++m)
            addSeen(differences[m], baked.bake->caches, seen, relighters[m]->field(),
                    relighters[whole]->field());
    }
    for (std::size_t m = 0; whole < all.size() && m < all.size(); ++m)
        all[m].nrmse = differences[m].nrmse();
    return all;
}

double skippedPercent(const RelightStats& run) {
    return 100 * double(run.linksSkipped) / double(std::max<std::uint64_t>(run.links, 1));
}

Json describe(const RelightBench& o, const BenchBake& baked, const Measured& measured,
              const Scene& scene, double bytesPerSecond) {
    const std::vector<RelightStats>& runs = measured.runs;
    const Caches& caches = baked.bake->caches;
    const std::uint64_t bytes = caches.links.size() * sizeof(Link) +
                                caches.shNode.size() * sizeof(std::uint32_t) +
                                caches.shCoefficients.size() * sizeof(std::uint16_t);
    Json row = {{"name", baked.name}, {"device", measured.device}};
    row.update(settingsOf(baked));
    row.update({{"bands_lit", runs.back().bandsLit},
                {"lights", scene.lights.size()},
                {"bounces", o.bounces},
                {"anew", o.anew},
                {"caches", caches.size()},
                {"caches_lit", measured.caches},
                {"caches_unseen", runs.back().cachesUnseen},
                {"caches_unread", runs.back().cachesUnread},
                {"nrmse", measured.nrmse ? Json(*measured.nrmse) : Json()},
                {"links_in_all", caches.linkCount()},
                {"links_of_run", runs.back().links},
                {"links_skipped", runs.back().linksSkipped},
                {"skipped_percent", skippedPercent(runs.back())},
                {"bytes", bytes},
                {"bytes_per_second", bytesPerSecond},
                {"floor_ms", 1000 * double(bytes) / bytesPerSecond},
                {"shadow_rays", runs.back().shadowRays},
                {"caches_occluded", runs.back().cachesOccluded},
                {"links_occluded", runs.back().linksOccluded}});
    for (const Step& step : kSteps) {
        std::vector<double> ms;
        for (const RelightStats& r : runs)
            ms.push_back(r.*step.ms);
        addSpread(row, step.name, ms);
    }
    return row;
}

constexpr Column kRelightColumns[] = {{"scene", -14, "name"},
                                      {"device", -8, "device"},
                                      {"lit", -4, "caches_lit"},
                                      {"unseen", 6, "caches_unseen"},
                                      {"lights", 6, "lights"},
                                      {"surfels", 7, "surfels"},
                                      {"links", 5, "links"},
                                      {"bands", 5, "bands"},
                                      {"chroma", 6, "chroma_bands"},
                                      {"kind", -4, "storage"},
                                      {"MiB", 8, "bytes", 2, kMiB},
                                      {"skip [%]", 8, "skipped_percent", 1},
                                      {"floor", 7, "floor_ms"},
                                      {"direct", 7, "direct_median_ms"},
                                      {"occlusion", 9, "occlusion_median_ms"},
                                      {"surfels", 7, "surfel_light_median_ms"},
                                      {"pull", 7, "pull_median_ms"},
                                      {"caches", 7, "cache_light_median_ms"},
                                      {"read", 7, "surfel_read_median_ms"},
                                      {"field", 7, "field_median_ms"},
                                      {"all [ms]", 8, "median_ms"},
                                      {"p95", 8, "p95_ms"}};

Result<std::vector<Measured>> runsOn(const std::string& device, const RelightBench& o,
                                     const Scene& scene, const BenchBake& baked) {
    if (device == "cpu")
        return relightOnCpu(o, scene, baked);
    Result<GpuRuns> gpu =
        relightOnGpu(device == "gpu" ? "" : device, baked.trace, baked.bake, o.lit, o.bounces,
                     o.runs, [&](int k) { return sceneAt(o, scene, k); });
    if (!gpu)
        return tl::make_unexpected(gpu.error());
    return std::vector<Measured>{{gpu->device, "all", std::move(gpu->runs), {}}};
}

Result<void> measureBake(const RelightBench& o, const BenchBake& baked, Json& rows) {
    const double bandwidth = measureReadBandwidth(std::size_t(256) << 20);
    for (const std::uint32_t lights : o.lights) {
        Scene lit = baked.scene;
        if (lights > 0)
            lit.lights =
                pointsOver(lit, baked.bake->surfels.position, baked.bake->surfels.normal, lights);
        for (const std::string& wanted : o.devices) {
            const Result<std::vector<Measured>> measured = runsOn(wanted, o, lit, baked);
            if (!measured)
                return fail(fmt::format("on {}: {}", wanted, measured.error().message));
            for (const Measured& m : *measured) {
                rows.push_back(describe(o, baked, m, lit, bandwidth));
                if (!o.json)
                    printRow(kRelightColumns, rows.back());
            }
        }
    }
    return {};
}

Exit runRelightBench(const RelightBench& o) {
    if (o.anew && o.bounces > kFewBounces)
        return failed(fmt::format("--anew: at most {} bounces", kFewBounces));
    if (!o.json)
        printTitles(kRelightColumns);
    Json rows = Json::array();
    const Result<void> measured =
        forEachBake(o.bakes, [&](const BenchBake& baked) { return measureBake(o, baked, rows); });
    if (!measured)
        return failed(measured.error().message);
    return writeRows(rows, o.output, "relight", o.json);
}

} // namespace

void addRelightBench(Command& bench) {
    const auto o = std::make_shared<RelightBench>();
    Command command = bench.addCommand(
        "relight", "Time of each step of relighting while all lights and dynamic objects move");
    addBenchBakes(command, o->bakes);
    addDynamicOption(command, o->bakes.common);
    command.option("-o,--output", o->output, "Folder for relight.csv and relight.json").required();
    command
        .option("--lights", o->lights,
                "Number of moving point lights, a list; 0: the lights of the scene")
        .list()
        .within(0, 4096);
    command
        .option("--device", o->devices,
                "Where to relight: cpu, gpu, or part of a device's name; a list")
        .list();
    command.flag(
        "--needed-bands", [o] { o->lit = LitBands::Needed; },
        "Light only the bands that the scene's surfaces need; default: all");
    command
        .option("--caches", o->caches,
                "Which caches are lit: all, or those that the camera's picture reads (seen, cpu "
                "only); a list. With both, nrmse compares their light where it is seen")
        .list()
        .oneOf({"all", "seen"});
    addCameraOptions(command, o->camera);
    command.option("--bounces", o->bounces, "Bounces per run").within(1, 64);
    command.flag("--anew", o->anew,
                 fmt::format("Start each run without bounced light, as --max-bounces up to "
                             "{} does",
                             kFewBounces));
    command.option("--runs", o->runs, "Number of runs; their median is printed").within(1, 100000);
    command.flag("--json", o->json, "Print one JSON object to stdout");
    command.onRun([o] { return runRelightBench(*o); });
}

} // namespace limn
