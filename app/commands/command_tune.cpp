// SPDX-License-Identifier: MIT
#include "app/bench/settings_sweep.h"
#include "app/commands/bake_options.h"
#include "app/commands/command.h"
#include "app/commands/output_file.h"
#include "app/commands/progress_line.h"
#include "app/commands/scene_options.h"

#include "engine/core/parallel.h"
#include "engine/files/project_file.h"
#include "engine/json/json.h"
#include "engine/measure/fit_to_budget.h"
#include "engine/techniques/technique_table.h"

#include <cstdio>
#include <memory>
#include <optional>

#include <fmt/format.h>

namespace limn {

namespace {

constexpr double kBytesPerMiB = 1 << 20;

struct TuneCommand {
    SceneOptions scene;
    CameraOptions camera;
    SettingsSweep sweep;
    std::optional<double> budgetMs, budgetMiB, error;
    double seconds = 270;
    int threads = 0;
    std::string output;
    bool json = false;
};

SearchGoal limitsOf(const TuneCommand& command) {
    SearchGoal limits;
    limits.maxMs = command.budgetMs.value_or(limits.maxMs);
    if (command.budgetMiB)
        limits.maxBytes = *command.budgetMiB * kBytesPerMiB;
    limits.maxError = command.error;
    return limits;
}

void printTuneTitles() {
    fmt::print("{:>5} {:>8} {:>8} {:>8} {:>8} {:>7}  {}\n", "level", "bake [s]", "ms", "MiB",
               "nRMSE", "bias %", "settings");
}

void print(const SettingsTrial& t) {
    endProgressLine();
    fmt::print("{:>5} {:>8.2f} {:>8.2f} {:>8.2f} {:>8.4f} {:>7.2f}  {}\n", t.level, t.seconds, t.ms,
               t.bytes / kBytesPerMiB, t.nrmse, 100 * t.bias, settingsName(t.settings));
    std::fflush(stdout);
}

Json jsonOf(const SettingsTrial& trial) {
    return {{"level", trial.level},
            {"seconds", trial.seconds},
            {"update_ms", trial.ms},
            {"bytes", std::uint64_t(trial.bytes)},
            {"nrmse", trial.nrmse},
            {"bias", trial.bias},
            {"settings", settingsJson(trial.settings)}};
}

Json jsonOf(const FittedSettings& fitted) {
    Json trials = Json::array();
    for (const SettingsTrial& trial : fitted.trials)
        trials.push_back(jsonOf(trial));
    return {{"best", jsonOf(fitted.best)},
            {"kept", fitted.kept},
            {"settings", fitted.settings},
            {"ruled_out", fitted.ruledOut},
            {"trials", trials}};
}

/// Sets the bake's settings of a document; without any, adds them.
void setBake(Document& document, const BakeSettings& settings) {
    for (auto& [id, object] : document.objects)
        if (BakeSettings* known = std::get_if<BakeSettings>(&object)) {
            *known = settings;
            return;
        }
    addObject(document, settings);
}

/// The project to write: the one that was opened, unless there is another.
std::string outputOf(const TuneCommand& command) {
    return command.output.empty() ? command.scene.scene : command.output;
}

/// Writes the project with the settings. A project that is written back keeps its own lights and
/// sky, whatever lit it here.
Result<void> writeTuned(const TuneCommand& command, Document document,
                        const BakeSettings& settings) {
    if (command.output.empty()) {
        Result<ImportedScene> plain = loadProject(command.scene.scene, {}, command.scene.import);
        if (!plain)
            return tl::make_unexpected(plain.error());
        document = std::move(plain->document);
    }
    setBake(document, settings);
    return saveProject(outputOf(command), document);
}

Result<FittedSettings> tune(const TuneCommand& command, const ImportedScene& imported) {
    const Scene scene = flatten(imported.document, imported.assets);
    const Result<Camera> camera = chooseCamera(scene, command.camera);
    if (!camera)
        return tl::make_unexpected(camera.error());
    const TraceScene trace(scene);
    Result<FittedSettings> fitted =
        fitToBudget(precomputingTechnique(scene.technique), trace, command.sweep,
                    {limitsOf(command), *camera, command.seconds}, progressOnStderr(),
                    command.scene.import.memory, [&](const SettingsTrial& trial) {
                        if (!command.json)
                            print(trial);
                    });
    endProgressLine();
    if (!fitted)
        return fail(fmt::format("{}: {}", command.scene.scene, fitted.error().message));
    return fitted;
}

Exit runTune(const TuneCommand& command) {
    if (const Result<void> writable = checkOutputFile(outputOf(command), {".limn"}); !writable)
        return failed(writable.error().message);
    const Result<ImportedScene> imported = openScene(command.scene);
    if (!imported)
        return failed(imported.error().message);
    const ThreadLimit threads(command.threads);
    if (!command.json)
        printTuneTitles();
    const Result<FittedSettings> fitted = tune(command, *imported);
    if (!fitted)
        return failed(fitted.error().message);
    const std::string why = shortfall(*fitted, limitsOf(command));
    if (command.json)
        fmt::print("{}\n", jsonOf(*fitted).dump());
    else
        fmt::print("{} of {} combinations of surfels, links and texels were ruled out before they "
                   "were measured\n{}: {:.2f} ms, {:.2f} MiB, nRMSE {:.4f}\n",
                   fitted->ruledOut, fitted->settings, settingsName(fitted->best.settings),
                   fitted->best.ms, fitted->best.bytes / kBytesPerMiB, fitted->best.nrmse);
    if (!why.empty())
        return failed(fmt::format("{}; {} is unchanged", why, outputOf(command)));
    const Result<void> written = writeTuned(command, imported->document, fitted->best.settings);
    return written ? Exit::Done : failed(written.error().message);
}

std::string tuneDefect(const TuneCommand& command) {
    if (!command.budgetMs && !command.budgetMiB && !command.error)
        return "--budget-ms, --budget-mib, --error: give at least one";
    if (command.output.empty() && !command.scene.scene.ends_with(".limn"))
        return "-o: needed unless the scene is a project (.limn), which gets the settings";
    return {};
}

} // namespace

void addTuneCommand(Command& app) {
    const auto command = std::make_shared<TuneCommand>();
    Command sub =
        app.addCommand("tune", "Find the bake settings with the least error within a budget");
    addSceneOptions(sub, command->scene);
    addTimeOption(sub, command->scene);
    addViewOptions(sub, command->camera);
    sub.option("--budget-ms", command->budgetMs,
               "Maximum time of an update of one bounce on the CPU, all lights moved [ms]")
        .within(1e-3, 1e6);
    sub.option("--budget-mib", command->budgetMiB,
               "Maximum memory of the bake and of what updates read and write beside it [MiB]")
        .within(1e-3, 1e6);
    sub.option("--error", command->error,
               "Maximum nRMSE of the irradiance that the camera sees, as that of limn bake "
               "--error: finds the settings that take the least time for it")
        .within(1e-3, 10.);
    addSweepOptions(sub, command->sweep);
    sub.option("--seconds", command->seconds, "Time for all measurements, about [s]")
        .within(1., 1e6);
    sub.option("-o,--output", command->output,
               "Project to write, .limn, with the scene and the settings; default: the project "
               "that is opened");
    sub.option("--threads", command->threads, "Threads to use; 0: all").within(0, 1024);
    sub.flag("--json", command->json, "Print one JSON object to stdout");
    sub.onRun(
        [command] {
            SettingsSweep sweep = usualFitSweep();
            if (command->sweep.contains("texelsPerMetre"))
                sweep.erase("lightmapCaches"); // the two exclude each other
            for (const auto& [key, values] : command->sweep)
                sweep[key] = values;
            command->sweep = std::move(sweep);
            return runTune(*command);
        },
        [command] { return tuneDefect(*command); });
}

} // namespace limn
