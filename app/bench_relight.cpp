// SPDX-License-Identifier: MIT
#include "app/bench_bakes.h"
#include "app/bench_relight_gpu.h"
#include "app/moving_lights.h"

#include "engine/measure/read_bandwidth.h"
#include "engine/relight/relight.h"

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
    int runs = 31;
    bool json = false;
};

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
                           {"", &RelightStats::totalMs}};

/// One bounce a run, with every light moved.
std::vector<RelightStats> relightOnCpu(const Scene& scene, const TraceScene& trace,
                                       const std::shared_ptr<const Bake>& bake, LitBands wanted,
                                       int runs) {
    Relighter relighter(bake, wanted);
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

Json describe(const BenchBake& baked, const std::string& device, const Scene& scene,
              const std::vector<RelightStats>& runs, double bytesPerSecond) {
    const Caches& caches = baked.bake->caches;
    const std::uint64_t bytes = caches.links.size() * sizeof(Link) +
                                caches.shNode.size() * sizeof(std::uint32_t) +
                                caches.shCoefficients.size() * sizeof(std::uint16_t);
    Json row = {{"name", baked.name}, {"device", device}};
    row.update(settingsOf(baked));
    row.update({{"bands_lit", runs.back().bandsLit},
                {"lights", scene.lights.size()},
                {"caches", caches.size()},
                {"links_in_all", caches.linkCount()},
                {"bytes", bytes},
                {"bytes_per_second", bytesPerSecond},
                {"floor_ms", 1000 * double(bytes) / bytesPerSecond},
                {"shadow_rays", runs.back().shadowRays}});
    for (const Step& step : kSteps) {
        std::vector<double> ms;
        for (const RelightStats& r : runs)
            ms.push_back(r.*step.ms);
        addSpread(row, step.name, ms);
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
                       const std::shared_ptr<const Bake>& bake, LitBands wanted, int runs) {
    if (device == "cpu")
        return GpuRuns{"cpu", relightOnCpu(scene, trace, bake, wanted, runs)};
#ifdef LIMN_HAS_VIEWPORT
    return relightOnGpu(device == "gpu" ? "" : device, scene, trace, bake, wanted, runs,
                        [&](int k) { return movedLights(scene.lights, k); });
#else
    return fail("this build has no Vulkan");
#endif
}

Result<void> measureBake(const RelightBench& o, const BenchBake& baked, Json& rows) {
    const double bandwidth = measureReadBandwidth(std::size_t(256) << 20);
    for (const std::uint32_t lights : o.lights) {
        Scene lit = baked.scene;
        if (lights > 0)
            lit.lights = pointsOver(lit, baked.bake->surfels, lights);
        for (const std::string& wanted : o.devices) {
            const Result<GpuRuns> measured =
                runsOn(wanted, lit, baked.trace, baked.bake, o.lit, o.runs);
            if (!measured)
                return fail(fmt::format("on {}: {}", wanted, measured.error().message));
            rows.push_back(describe(baked, measured->device, lit, measured->runs, bandwidth));
            if (!o.json)
                printRow(rows.back());
        }
    }
    return {};
}

Exit runRelightBench(const RelightBench& o) {
    if (!o.json)
        fmt::print("{:<14} {:<8} {:>6} {:>7} {:>5} {:>5} {:>6} {:<4} {:>8} {:>7} {:>7} {:>7} {:>7} "
                   "{:>7} {:>7} "
                   "{:>7} {:>8} {:>8}\n",
                   "scene", "device", "lights", "surfels", "links", "bands", "chroma", "kind",
                   "MiB", "floor", "direct", "surfels", "pull", "caches", "read", "field",
                   "all [ms]", "p95");
    Json rows = Json::array();
    const Result<void> measured =
        forEachBake(o.bakes, [&](const BenchBake& baked) { return measureBake(o, baked, rows); });
    if (!measured)
        return failed(measured.error().message);
    return writeRows(rows, o.output, "relight", o.json);
}

} // namespace

void addRelightBench(CLI::App& bench, Run& run) {
    const auto o = std::make_shared<RelightBench>();
    CLI::App* command = bench.add_subcommand(
        "relight", "Time of each step of relighting while all lights move, one bounce a run");
    addBenchBakes(*command, o->bakes);
    command->add_option("-o,--output", o->output, "folder of relight.csv and relight.json")
        ->required();
    addList(*command, "--lights", o->lights, "moving point lights, a list; 0: those of the scene",
            CLI::Range(0, 4096));
    command->add_option("--device", o->devices, "a list: cpu, gpu, or part of a device's name")
        ->delimiter(',');
    command->add_flag_callback(
        "--needed-bands", [o] { o->lit = LitBands::Needed; },
        "light only the bands that the scene's surfaces need; without it, all");
    command->add_option("--runs", o->runs, "of which the median is printed")
        ->check(CLI::Range(1, 100000));
    command->add_flag("--json", o->json, "one JSON object on stdout");
    command->callback([o, &run] { run = [o] { return runRelightBench(*o); }; });
}

} // namespace limn
