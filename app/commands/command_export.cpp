// SPDX-License-Identifier: MIT
#include "app/commands/bake_options.h"
#include "app/commands/command.h"
#include "app/commands/lit_scene.h"
#include "app/commands/output_file.h"
#include "app/commands/progress_line.h"
#include "app/commands/scene_options.h"
#include "app/commands/setting_type_name.h"
#include "app/resources.h"

#include "engine/core/log.h"
#include "engine/core/parallel.h"
#include "engine/export/export_table.h"
#include "engine/scene/setting_text.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace limn {

namespace {

struct Options {
    SceneOptions scene;
    BakeOptions bake;
    ExportSettings settings;
    std::vector<std::string> given; ///< keys of the settings on the command line
    std::string format, bakeFile, output;
    ExportFolders folders{.three = "node_modules/three", .webRuntime = webRuntimeFolder()};
    bool list = false, json = false;
};

std::vector<std::string> formatNames() {
    std::vector<std::string> names;
    for (const ExportFormat* format : exportFormats())
        names.emplace_back(format->name);
    return names;
}

bool reads(const ExportFormat& format, std::string_view key) {
    return std::ranges::find(format.settings, key) != format.settings.end();
}

Exit listFormats(const Options& options) {
    auto json = nlohmann::ordered_json::array();
    for (const ExportFormat* format : exportFormats()) {
        if (options.json)
            json.push_back({{"name", format->name},
                            {"label", format->label},
                            {"summary", format->summary},
                            {"extensions", format->extensions},
                            {"settings", format->settings}});
        else
            fmt::print("{:<12} {} ({}). {}\n", format->name, format->label,
                       format->extensions.empty()
                           ? "a folder"
                           : fmt::format("{}", fmt::join(format->extensions, " or ")),
                       format->summary);
    }
    if (options.json)
        fmt::print("{}\n", nlohmann::ordered_json{{"formats", json}}.dump());
    return Exit::Done;
}

/// Checks everything that can be checked before the scene is read.
Result<const ExportFormat*> chooseFormat(const Options& options) {
    const ExportFormat* format = findExportFormat(options.format);
    Result<void> checked;
    if (const std::string defect = settingsDefect(options.settings); !defect.empty())
        checked = fail(defect);
    visitExportSettings(options.settings, [&](const Setting& setting, const auto&, const auto&...) {
        if (checked && std::ranges::find(options.given, setting.key) != options.given.end() &&
            !reads(*format, setting.key))
            checked =
                fail(fmt::format("{}: the format {} does not use it", setting.flag, format->name));
    });
    if (!checked)
        return tl::make_unexpected(checked.error());
    if (format->extensions.empty()) {
        std::error_code error;
        if (std::filesystem::exists(options.output, error) &&
            !std::filesystem::is_directory(options.output, error))
            return fail(fmt::format("{}: is not a folder", options.output));
        return format;
    }
    if (const Result<void> writable = checkOutputFile(options.output, format->extensions,
                                                      {options.scene.scene, options.bakeFile});
        !writable)
        return tl::make_unexpected(writable.error());
    return format;
}

/// The last part of a path, also of a folder's "path/".
std::string nameOf(const std::string& path) {
    const std::filesystem::path p = std::filesystem::path(path).lexically_normal();
    return (p.has_filename() ? p : p.parent_path()).filename().string();
}

nlohmann::ordered_json forecastJson(const ExportForecast& forecast) {
    return {{"bytes", forecast.bytes},
            {"width", forecast.width},
            {"height", forecast.height},
            {"detail", forecast.detail}};
}

Exit runExport(const Options& options) {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point start = Clock::now();
    if (options.list)
        return listFormats(options);
    const Result<const ExportFormat*> format = chooseFormat(options);
    if (!format)
        return failed(format.error().message);
    const ThreadLimit threads(options.bake.threads);
    Result<ImportedScene> imported = openScene(options.scene);
    if (!imported)
        return failed(imported.error().message);
    std::error_code error;
    if (std::filesystem::equivalent(options.output, imported->document.scenePath, error))
        return failed(fmt::format("{}: is the scene itself", options.output));
    Scene scene = flatten(imported->document, imported->assets);
    applyBakeOptions(options.bake, scene.bake);
    const Result<LitScene> lit = lightScene(std::move(scene), options.bakeFile,
                                            options.scene.import.memory, progressOnStderr());
    endProgressLine();
    if (!lit)
        return failed(fmt::format("{}: {}", options.scene.scene, lit.error().message));
    const ExportScene in{imported->document, *lit->scene,  *lit->trace,
                         *lit->layout,       lit->field(), lit->prepared.data.get(),
                         options.folders};
    const ExportForecast forecast = (*format)->forecast(in, options.settings);
    if (forecast.detail > 0 && forecast.detail < options.settings.detail)
        logWarning(fmt::format("{} texels per cache a side instead of {}: the lightmap would be "
                               "larger than --max-size",
                               forecast.detail, options.settings.detail));
    if (!options.json)
        fmt::print("About {}, lightmap of {} x {} texels\n", bytesText(forecast.bytes),
                   forecast.width, forecast.height);
    const Result<std::vector<ExportFile>> files =
        (*format)->write(in, options.settings, nameOf(options.output), progressOnStderr());
    endProgressLine();
    if (!files)
        return failed(fmt::format("{}: {}", options.output, files.error().message));
    if (const Result<void> written = writeExport(options.output, **format, *files); !written)
        return failed(written.error().message);
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    std::uint64_t bytes = 0;
    auto list = nlohmann::ordered_json::array();
    for (const ExportFile& file : *files) {
        bytes += file.bytes.size();
        list.push_back({{"name", file.name}, {"bytes", file.bytes.size()}});
    }
    if (options.json)
        fmt::print("{}\n", nlohmann::ordered_json{{"format", (*format)->name},
                                                  {"seconds", seconds},
                                                  {"bytes", bytes},
                                                  {"forecast", forecastJson(forecast)},
                                                  {"files", list}}
                               .dump());
    else
        for (const ExportFile& file : *files)
            fmt::print("{:<40} {}\n", file.name, bytesText(file.bytes.size()));
    return Exit::Done;
}

void addSettingOptions(CLI::App& command, Options& options) {
    visitExportSettings(
        options.settings, [&](const Setting& setting, auto& value, const auto&... limits) {
            const std::string key = setting.key;
            if constexpr (sizeof...(limits) == 0) {
                command.add_flag_callback(
                    setting.flag,
                    [&options, &value, key] {
                        value = true;
                        options.given.push_back(key);
                    },
                    setting.help);
            } else {
                command
                    .add_option_function<std::string>(
                        setting.flag,
                        [&options, &value, key, limits...](const std::string& text) {
                            readValue(text, value, limits...);
                            options.given.push_back(key);
                        },
                        setting.help)
                    ->type_name(typeName(limits...))
                    ->check([limits...](const std::string& text) {
                        std::decay_t<decltype(value)> scratch{};
                        return readValue(text, scratch, limits...);
                    });
            }
        });
}

} // namespace

void addExportCommand(CLI::App& app, Run& run) {
    const auto o = std::make_shared<Options>();
    CLI::App* command = app.add_subcommand("export", "Write a scene's light for other programs");
    addSceneOptions(*command, o->scene);
    addBakeOptions(*command, o->bake);
    CLI::Option* list = command->add_flag("--list", o->list, "List the formats");
    command->get_option("scene")->required(false);
    CLI::Option* format = command->add_option("--format", o->format, "What to write")
                              ->check(CLI::IsMember(formatNames()));
    command->add_option("--bake", o->bakeFile, "Bake of the scene, .limnbake; default: bakes");
    command->add_option("-o,--output", o->output, "File to write, or a folder");
    addSettingOptions(*command, *o);
    command->add_option("--three", o->folders.three,
                        "Folder of the npm package three, for web; default node_modules/three");
    command->add_option("--web-runtime", o->folders.webRuntime,
                        "Folder of limn_runtime.wasm, for web; ./run --web makes it");
    command->add_flag("--json", o->json, "One JSON object on stdout");
    command->callback([o, &run, list, format] {
        if (!*list && (o->scene.scene.empty() || !*format || o->output.empty()))
            throw CLI::RequiredError("A scene, --format and --output, or --list,");
        run = [o] { return runExport(*o); };
    });
}

} // namespace limn
