// SPDX-License-Identifier: MIT
#include "app/commands/command.h"
#include "app/commands/output_file.h"
#include "app/commands/progress_line.h"
#include "app/commands/scene_options.h"
#include "app/program_version.h"

#include "engine/core/replace_file.h"
#include "engine/lint/bake_forecast.h"
#include "engine/lint/lint.h"
#include "engine/lint/lint_report.h"

#include <algorithm>
#include <memory>

#include <fmt/format.h>

namespace limn {

namespace {

struct LintCommand {
    SceneOptions scene;
    std::string sarif;
    std::string failOn = "warning";
    bool json = false, rules = false, noSeconds = false;
};

Json countsJson(std::span<const Finding> findings) {
    const auto counts = countBySeverity(findings);
    Json json = Json::object();
    for (std::size_t i = 0; i < counts.size(); ++i)
        json[kSeverityNames[i]] = counts[i];
    return json;
}

void printRules(bool json) {
    Json all = Json::array();
    for (const LintRule* rule : lintRules()) {
        const std::string_view severity = severityName(rule->severity);
        if (json)
            all.push_back(
                {{"rule", rule->name}, {"severity", severity}, {"summary", rule->summary}});
        else
            fmt::print("{:<20} {:<8} {}\n", rule->name, severity, rule->summary);
    }
    if (json)
        fmt::print("{}\n", Json{{"rules", all}}.dump());
}

void print(std::span<const Finding> findings) {
    for (const Finding& f : findings) {
        fmt::print("{:<8} {:<20} {}\n", severityName(f.severity), f.rule->name,
                   f.path.empty() ? "the scene" : f.path);
        fmt::print("         {}\n         {}\n", f.problem, f.advice);
        if (f.place)
            fmt::print("         At {:.4g}, {:.4g}, {:.4g} m\n", f.place->x, f.place->y,
                       f.place->z);
    }
    const auto counts = countBySeverity(findings);
    fmt::print("{} errors, {} warnings, {} notes\n", counts[2], counts[1], counts[0]);
}

/// What a bake with the scene's settings will take. Seconds are empty where they are not known.
struct Forecast {
    Prediction prediction;
    StageSeconds seconds;
};

Forecast forecastOf(const LintCommand& command, const TraceScene& trace) {
    Forecast forecast;
    if (trace.scene().instances.empty())
        return forecast;
    forecast.prediction = forecastBake(trace.scene());
    const MemoryBudget& memory = command.scene.import.memory;
    if (command.noSeconds || forecast.prediction.working > memory.maxBytes)
        return forecast;
    if (auto seconds = forecastSeconds(trace, memory, progressOnStderr()))
        forecast.seconds = std::move(*seconds);
    endProgressLine();
    return forecast;
}

Json forecastJson(const Forecast& forecast) {
    Json json = {{"caches", forecast.prediction.caches},
                 {"file_bytes", forecast.prediction.file},
                 {"working_bytes", forecast.prediction.working},
                 {"seconds", nullptr}};
    if (!forecast.seconds.empty())
        json["seconds"] = totalOf(forecast.seconds);
    return json;
}

void print(const Forecast& forecast) {
    const Prediction& p = forecast.prediction;
    fmt::print("A bake: about {} caches, a file of {}, {} of memory beside the scene", p.caches,
               bytesText(p.file), bytesText(p.working));
    if (!forecast.seconds.empty())
        fmt::print(", {:.3g} s", totalOf(forecast.seconds));
    fmt::print("\n");
}

bool failsOn(std::span<const Finding> findings, std::string_view name) {
    const auto lowest = Severity(std::ranges::find(kSeverityNames, name) - kSeverityNames.begin());
    return std::ranges::any_of(findings, [&](const Finding& f) { return f.severity >= lowest; });
}

Exit runLint(const LintCommand& command) {
    if (command.rules) {
        printRules(command.json);
        return Exit::Done;
    }
    if (!command.sarif.empty())
        if (const Result<void> writable =
                checkOutputFile(command.sarif, {".sarif", ".json"}, {command.scene.scene});
            !writable)
            return failed(writable.error().message);
    const Result<ImportedScene> imported = openScene(command.scene);
    if (!imported)
        return failed(imported.error().message);
    const Scene scene = flatten(imported->document, imported->assets, command.scene.seconds);
    const TraceScene trace(scene);
    const auto findings = lintScene(
        {imported->document, scene, trace, imported->repairs, command.scene.import.memory},
        progressOnStderr());
    endProgressLine();
    if (!findings)
        return failed("cancelled");
    if (!command.sarif.empty()) {
        const Json log = sarifLog(*findings, imported->document.scenePath, programVersion());
        if (const Result<void> written = replaceFile(command.sarif, log.dump(2) + "\n"); !written)
            return failed(written.error().message);
    }
    const Forecast forecast = forecastOf(command, trace);
    if (command.json)
        fmt::print("{}\n", Json{{"scene", imported->document.scenePath},
                                {"findings", findingsJson(*findings)},
                                {"counts", countsJson(*findings)},
                                {"bake", forecastJson(forecast)}}
                               .dump());
    else {
        print(*findings);
        print(forecast);
    }
    return failsOn(*findings, command.failOn) ? Exit::Findings : Exit::Done;
}

} // namespace

void addLintCommand(Command& app) {
    auto command = std::make_shared<LintCommand>();
    Command sub = app.addCommand("lint", "Find what in a scene makes baked or live light go wrong");
    addSceneOptions(sub, command->scene);
    addTimeOption(sub, command->scene);
    sub.get("scene").required(false);
    sub.flag("--json", command->json, "Print one JSON object to stdout");
    sub.option("--sarif", command->sarif,
               "Also write the findings as SARIF 2.1.0, .sarif or .json");
    sub.option("--fail-on", command->failOn,
               "Least severity of a finding that makes the exit code 3; default: warning")
        .oneOf(namesIn(kSeverityNames));
    sub.flag("--no-seconds", command->noSeconds,
             "Make no trial bake, from which the seconds of a bake are known");
    sub.flag("--rules", command->rules, "List the rules instead");
    sub.onRun([command] { return runLint(*command); },
              [command]() -> std::string {
                  return command->rules || !command->scene.scene.empty() ? "" : "scene is required";
              });
}

} // namespace limn
