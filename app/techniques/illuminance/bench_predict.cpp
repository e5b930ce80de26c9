// SPDX-License-Identifier: MIT
#include "app/bench/bench.h"
#include "app/commands/progress_line.h"
#include "app/commands/scene_options.h"
#include "app/techniques/illuminance/illuminance_program.h"

#include "engine/core/parallel.h"
#include "engine/lighting/fastest_update.h"
#include "engine/scene/bake_settings_fields.h"
#include "engine/techniques/illuminance/illuminance.h"

#include <cmath>
#include <ctime>
#include <filesystem>
#include <limits>

#include <fmt/format.h>

namespace limn {

namespace {

struct PredictBench {
    SceneOptions common; ///< lights and sky of every scene
    std::vector<std::string> scenes;
    std::string preset = "medium", output;
    int threads = 1, runs = 31;
    bool json = false;
};

/// Settings that differ from those that were measured.
struct Variant {
    const char* name;
    void (*apply)(BakeSettings& s);
};
constexpr Variant kVariants[] = {
    {"surfels / 4", [](BakeSettings& s) { s.surfels /= 4; }},
    {"surfels x 2", [](BakeSettings& s) { s.surfels *= 2; }},
    {"links / 2", [](BakeSettings& s) { s.links /= 2; }},
    {"links x 2", [](BakeSettings& s) { s.links *= 2; }},
    {"2 bands", [](BakeSettings& s) { s.bands = 2; }},
    {"4 bands, 1 chroma", [](BakeSettings& s) { s.bands = 4, s.chromaBands = 1; }},
    {"rays / 2", [](BakeSettings& s) { s.rays /= 2; }},
    {"rays x 2", [](BakeSettings& s) { s.rays *= 2; }},
    {"texels / 4", [](BakeSettings& s) { s.lightmapCaches /= 4; }},
    {"texels x 2", [](BakeSettings& s) { s.lightmapCaches *= 2; }},
    {"grid 16 x 12 x 16",
     [](BakeSettings& s) {
         s.grid = {16, 12, 16};
     }},
    {"all / 2",
     [](BakeSettings& s) { s.surfels /= 2, s.links /= 2, s.rays /= 2, s.lightmapCaches /= 2; }}};

/// CPU time of all threads of this process [s]. On a busy machine wall time measures the others.
double cpuSeconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

/// Measures the CPU time of each stage from the bake's reports.
class StageCpu {
public:
    void at(std::string stage) {
        if (stage == "budget")
            stage = "cut"; // its first part
        if (!m_seconds.empty() && stage == m_seconds.back().first)
            return;
        finish();
        m_seconds.emplace_back(std::move(stage), 0);
    }
    StageSeconds finish() {
        const double now = cpuSeconds();
        if (!m_seconds.empty())
            m_seconds.back().second = now - m_start;
        m_start = now;
        return m_seconds;
    }

private:
    StageSeconds m_seconds;
    double m_start = 0;
};

/// All predictions start from one bake, which is therefore made several times.
constexpr int kBaseBakes = 3;

/// A bake, its cost, and the lighting that uses it.
struct CostedBake {
    std::shared_ptr<const Precomputed> bake;
    PrecomputedCost cost;
    std::unique_ptr<Lighting> lighting;
};

/// Bakes `times` times; the fastest counts.
Result<CostedBake> measureBake(const Scene& scene, const TraceScene& trace,
                               const BakeSettings& settings, int times) {
    CostedBake costed;
    for (int k = 0; k < times; ++k) {
        StageCpu cpu;
        Progress progress = progressOnStderr();
        progress.report = [&, show = progress.report](const char* stage, float fraction) {
            cpu.at(stage);
            if (show)
                show(stage, fraction);
        };
        auto made =
            kIlluminanceTechnique.precomputation->prepare(trace, {.settings = &settings}, progress);
        StageSeconds seconds = cpu.finish();
        endProgressLine();
        if (!made)
            return tl::make_unexpected(made.error());
        if (k == 0 || totalOf(seconds) < totalOf(costed.cost.seconds))
            costed.cost.seconds = std::move(seconds);
        costed.bake = *std::move(made);
    }
    costed.cost.bytes = totalOf(costed.bake->report().bytes);
    costed.cost.updateMs = std::numeric_limits<double>::max();
    costed.lighting = kIlluminanceTechnique.light({costed.bake, std::make_shared<Scene>(scene)});
    return costed;
}

/// Measures a round of updates of one bounce, each with all lights moved, and keeps the least CPU
/// time so far. The first update of a round does not count: it also lights the materials, or reads
/// a bake that the processor's caches no longer hold.
void measureUpdates(const Scene& scene, const TraceScene& trace, int round, CostedBake& costed) {
    constexpr int kUpdates = 4; // in a round
    PrecomputedCost& cost = costed.cost;
    for (int k = 0; k < kUpdates; ++k) {
        const Scene moved = withMovedLights(scene, kUpdates * round + k);
        const double start = cpuSeconds();
        const LightingReport update =
            costed.lighting->update({.scene = moved, .trace = &trace, .bounces = 1}, {});
        const double ms = 1000 * (cpuSeconds() - start);
        if (k == 0)
            continue;
        cost.updateMs = std::min(cost.updateMs, ms);
        if (cost.update.empty())
            cost.update = update.steps;
        for (std::size_t i = 0; i < update.steps.size(); ++i)
            cost.update[i].ms = std::min(cost.update[i].ms, update.steps[i].ms);
    }
}

/// Scales the steps, which are timed by the wall, to the CPU time of all.
void scaleSteps(PrecomputedCost& cost) {
    double sum = 0;
    for (const LightingStep& step : cost.update)
        sum += step.ms;
    for (LightingStep& step : cost.update)
        step.ms *= cost.updateMs / std::max(sum, 1e-9);
}

double percentOff(double predicted, double measured) {
    return 100 * (predicted / measured - 1);
}

Json describe(const std::string& scene, const char* variant, const PrecomputedCost& predicted,
              const PrecomputedCost& measured) {
    Json row = {{"scene", scene}, {"settings", variant}};
    const auto add = [&](const std::string& what, double expected, double real) {
        row[what + "_predicted"] = expected;
        row[what + "_measured"] = real;
        row[what + "_off_percent"] = percentOff(expected, real);
    };
    add("seconds", totalOf(predicted.seconds), totalOf(measured.seconds));
    add("bytes", predicted.bytes, measured.bytes);
    add("update_ms", predicted.updateMs, measured.updateMs);
    for (std::size_t i = 0; i < measured.seconds.size(); ++i)
        add(measured.seconds[i].first, predicted.seconds[i].second, measured.seconds[i].second);
    for (std::size_t i = 0; i < measured.update.size(); ++i)
        add(std::string(measured.update[i].id) + "_ms", predicted.update[i].ms,
            measured.update[i].ms);
    return row;
}

constexpr Column kPredictionColumns[] = {{"scene", -10, "scene"},
                                         {"settings", -18, "settings"},
                                         {"CPU s", 7, "seconds_measured"},
                                         {"pred.", 7, "seconds_predicted"},
                                         {"off %", 6, "seconds_off_percent", 0},
                                         {"MiB", 8, "bytes_measured", 2, kMiB},
                                         {"pred.", 8, "bytes_predicted", 2, kMiB},
                                         {"off %", 6, "bytes_off_percent", 0},
                                         {"ms", 8, "update_ms_measured"},
                                         {"pred.", 8, "update_ms_predicted"},
                                         {"off %", 6, "update_ms_off_percent", 0}};

Result<void> predictScene(const PredictBench& o, const std::string& path, Json& rows) {
    SceneOptions options = o.common;
    options.scene = path;
    const Result<ImportedScene> imported = openScene(options);
    if (!imported)
        return tl::make_unexpected(imported.error());
    Scene scene = flatten(imported->document, imported->assets);
    for (const BakePreset& preset : kBakePresets)
        if (preset.name == o.preset)
            preset.applyTo(scene.bake);
    const TraceScene trace(scene);
    std::vector<BakeSettings> settings = {scene.bake};
    for (const Variant& variant : kVariants) {
        settings.push_back(scene.bake);
        variant.apply(settings.back());
    }
    std::vector<CostedBake> all;
    for (const BakeSettings& s : settings) {
        Result<CostedBake> made = measureBake(scene, trace, s, all.empty() ? kBaseBakes : 1);
        if (!made)
            return fail(fmt::format("{}: {}", path, made.error().message));
        all.push_back(*std::move(made));
    }
    // The bakes take turns, because the machine is faster at one time than at another.
    for (int round = 0; round < o.runs; ++round)
        for (CostedBake& costed : all)
            measureUpdates(scene, trace, round, costed);
    for (CostedBake& costed : all)
        scaleSteps(costed.cost);
    for (std::size_t i = 1; i < all.size(); ++i) {
        const PrecomputedCost predicted =
            all[0].bake->expectedCost(scene, settings[i], all[0].cost);
        rows.push_back(describe(std::filesystem::path(path).stem().string(), kVariants[i - 1].name,
                                predicted, all[i].cost));
        if (!o.json)
            printRow(kPredictionColumns, rows.back());
    }
    return {};
}

void printWorst(const Json& rows) {
    for (const auto& [what, key] :
         {std::pair{"seconds", "seconds_off_percent"}, std::pair{"MiB", "bytes_off_percent"},
          std::pair{"ms", "update_ms_off_percent"}}) {
        double worst = 0;
        int within = 0;
        for (const Json& row : rows) {
            const double off = std::abs(row[key].get<double>());
            worst = std::max(worst, off);
            within += off <= 25;
        }
        fmt::print("{}: {} of {} within 25 %, worst {:.0f} %\n", what, within, rows.size(), worst);
    }
}

Exit runPredictBench(const PredictBench& o) {
    const ThreadLimit threads(o.threads);
    if (!o.json)
        printTitles(kPredictionColumns);
    Json rows = Json::array();
    for (const std::string& scene : o.scenes)
        if (const Result<void> done = predictScene(o, scene, rows); !done)
            return failed(done.error().message);
    if (!o.json)
        printWorst(rows);
    return writeRows(rows, o.output, "predict", o.json);
}

} // namespace

void addPredictBench(Command& bench) {
    const auto o = std::make_shared<PredictBench>();
    Command command = bench.addCommand(
        "predict", "Predicted against measured seconds, memory and relighting time of 12 settings");
    command
        .option("scenes", o->scenes,
                "Scenes (.gltf, .glb), projects (.limn), or names of sample projects")
        .required();
    addLightOptions(command, o->common);
    std::vector<std::string> presets;
    for (const BakePreset& preset : kBakePresets)
        presets.emplace_back(preset.name);
    command.option("--preset", o->preset, "Bake that is measured first; the settings vary it")
        .oneOf(presets);
    command.option("-o,--output", o->output, "Folder for predict.csv and predict.json").required();
    command.option("--runs", o->runs, "Number of rounds of updates; the fastest update counts")
        .within(1, 1000);
    command.option("--threads", o->threads, "Threads to use; 0: all").within(0, 1024);
    command.flag("--json", o->json, "Print one JSON object to stdout");
    command.onRun([o] { return runPredictBench(*o); });
}

} // namespace limn
