// SPDX-License-Identifier: MIT
#include "app/commands/bake_options.h"
#include "app/commands/command.h"
#include "app/commands/light_on_cpu.h"
#include "app/commands/output_file.h"
#include "app/commands/progress_line.h"
#include "app/commands/relight_options.h"
#include "app/commands/scene_options.h"
#include "app/commands/setting_options.h"
#include "app/resources.h"

#include "engine/core/log.h"
#include "engine/core/parallel.h"
#include "engine/export/export_table.h"
#include "engine/export/lightmap_file.h"
#include "engine/json/json.h"
#include "engine/lighting/converged_light.h"
#include "engine/scene/export_settings_fields.h"
#include "engine/scene/setting_text.h"
#include "engine/techniques/technique_table.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace limn {

namespace {

struct ExportCommand {
    SceneOptions scene;
    BakeOptions bake;
    CameraOptions camera;
    GivenSettings relight, given; ///< replace the document's; `given` are those of the export
    std::string format, bakeFile, output;
    ExportFolders folders = exportFolders();
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

/// "--max-size" of "maxSize".
const char* flagOf(std::string_view key) {
    const char* flag = "";
    const ExportSettings defaults;
    visitExportSettings(defaults, [&](const Setting& setting, const auto&...) {
        if (setting.key == key)
            flag = setting.flag;
    });
    return flag;
}

Exit listFormats(const ExportCommand& options) {
    auto json = Json::array();
    for (const ExportFormat* format : exportFormats()) {
        if (options.json)
            json.push_back({{"name", format->name},
                            {"label", format->label},
                            {"summary", format->summary},
                            {"extensions", namesIn(format->extensions)},
                            {"settings", namesIn(format->settings)}});
        else
            fmt::print("{:<12} {} ({}). {}\n", format->name, format->label,
                       format->extensions.empty()
                           ? "a folder"
                           : fmt::format("{}", fmt::join(format->extensions, " or ")),
                       format->summary);
    }
    if (options.json)
        fmt::print("{}\n", Json{{"formats", json}}.dump());
    return Exit::Done;
}

/// The document's settings, where nothing else is given.
ExportSettings settingsOf(const ExportCommand& options, const Document& document) {
    ExportSettings settings = singleton<ExportSettings>(document);
    for (const auto& [key, text] : options.given)
        setExportSetting(settings, key, text);
    settings.format = options.format;
    settings.encoding = encodingFor(settings, options.output);
    return settings;
}

/// The given setting that has no effect beside the others; empty: there is none.
std::string uselessSetting(const ExportCommand& options, const ExportSettings& settings,
                           bool hasGrid) {
    for (const auto& [key, text] : options.given)
        if (const std::string missing = missingFor(settings, key, hasGrid); !missing.empty())
            return fmt::format("{}: has no effect without {}", flagOf(key), missing);
    return {};
}

/// Checks everything that can be checked before the scene is read.
Result<const ExportFormat*> chooseFormat(const ExportCommand& options) {
    const ExportFormat* format = findExportFormat(options.format);
    for (const auto& [key, text] : options.given)
        if (!reads(*format, key))
            return fail(
                fmt::format("{}: the format {} does not use it", flagOf(key), format->name));
    if (const std::string defect = settingsDefect(settingsOf(options, {})); !defect.empty())
        return fail(defect);
    if (const Result<void> possible = checkExportPath(options.output, *format); !possible)
        return tl::make_unexpected(possible.error());
    if (format->extensions.empty())
        return format;
    if (const Result<void> writable = checkOutputFile(options.output, format->extensions,
                                                      {options.scene.scene, options.bakeFile});
        !writable)
        return tl::make_unexpected(writable.error());
    return format;
}

/// ", lightmap of 2 textures of 4096 x 4096 texels"; empty without a lightmap.
std::string lightmapText(const ExportForecast& f) {
    if (f.width == 0)
        return {};
    const std::string pages = f.pages > 1 ? fmt::format("{} textures of ", f.pages) : "";
    return fmt::format(", lightmap of {}{} x {} texels", pages, f.width, f.height);
}

Json forecastJson(const ExportForecast& forecast) {
    return {{"bytes", forecast.bytes},
            {"pages", forecast.pages},
            {"width", forecast.width},
            {"height", forecast.height},
            {"detail", forecast.detail}};
}

/// {"format", "seconds", "bytes", "forecast", "files": [{"name", "bytes", "error", "seams"}]}.
Json reportJson(const ExportFormat& format, const ExportForecast& forecast,
                const std::vector<ExportedFile>& files, double seconds) {
    std::uint64_t bytes = 0;
    auto list = Json::array();
    for (const ExportedFile& file : files) {
        bytes += file.bytes;
        Json entry = {{"name", file.name}, {"bytes", file.bytes}};
        if (file.error)
            entry["error"] = errorJson(*file.error);
        if (file.seams)
            entry["seams"] = seamsJson(*file.seams);
        list.push_back(std::move(entry));
    }
    return {{"format", format.name},
            {"seconds", seconds},
            {"bytes", bytes},
            {"forecast", forecastJson(forecast)},
            {"files", list}};
}

Exit runExport(const ExportCommand& options) {
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
    const ExportSettings settings = settingsOf(options, imported->document);
    if (const std::string useless = uselessSetting(options, settings, true); !useless.empty())
        return failed(useless);
    Scene scene = flatten(imported->document, imported->assets);
    applyBakeOptions(options.bake, scene.bake);
    applyRelightOptions(options.relight, scene.relight);
    const Result<ConvergedLight> lit =
        lightOnCpu(options.scene, options.bakeFile, std::move(scene), LitFor::Export);
    if (!lit)
        return failed(fmt::format("{}: {}", options.scene.scene, lit.error().message));
    if (const std::string useless = uselessSetting(options, settings, !lit->field().grid.empty());
        !useless.empty())
        return failed(useless);
    const Result<Camera> camera = chooseCamera(*lit->scene, options.camera);
    if (!camera)
        return failed(camera.error().message);
    const std::shared_ptr<const IndirectField> emitted = lit->lighting->emittedField(*lit->scene);
    const ExportScene in{imported->document, *lit->scene,   *lit->trace,
                         *lit->layout,       lit->field(),  lit->prepared.data.get(),
                         options.folders,    emitted.get(), &*camera};
    const ExportForecast forecast = (*format)->forecast(in, settings);
    if (forecast.detail > 0 && forecast.detail < settings.detail)
        logWarning(
            fmt::format("{} texels per cache a side instead of {}: a texture would be larger "
                        "than --max-size",
                        forecast.detail, settings.detail));
    for (const Light& light : lit->scene->lights)
        if (profileOf(light) && shines(light))
            logWarning(fmt::format("light '{}': readers without EXT_lights_ies spread its flux "
                                   "evenly, and so do the formats babylon, json, limnrt and web. "
                                   "The lightmap has its profile",
                                   light.name));
    if (!options.json)
        fmt::print("About {}{}\n", bytesText(forecast.bytes), lightmapText(forecast));
    const Result<std::vector<ExportedFile>> files =
        exportLight(options.output, **format, in, settings, progressOnStderr());
    endProgressLine();
    if (!files)
        return failed(files.error().message);
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    if (options.json)
        fmt::print("{}\n", reportJson(**format, forecast, *files, seconds).dump());
    else
        for (const ExportedFile& file : *files)
            fmt::print("{:<40} {}{}\n", file.name, bytesText(file.bytes), errorText(file));
    return Exit::Done;
}

void addSettingOptions(Command& command, ExportCommand& options) {
    const ExportSettings defaults;
    std::map<std::string, Option> byKey;
    visitExportSettings(defaults, [&](const Setting& setting, const auto&, const auto&... limits) {
        if constexpr (sizeof...(limits) == 0)
            command.flag(
                setting.flag,
                [&options, key = std::string(setting.key)] {
                    options.given.emplace_back(key, "true");
                },
                setting.help);
        else
            byKey.emplace(setting.key, addSettingOption(
                                           command, options.given, setting,
                                           [](const std::string& named, const std::string& text) {
                                               ExportSettings scratch;
                                               return setExportSetting(scratch, named, text);
                                           },
                                           limits...));
    });
    visitExportSettings(defaults, [&](const Setting& setting, const auto&, const auto&...) {
        if (setting.replaces)
            byKey.at(setting.replaces).excludes(byKey.at(setting.key));
    });
}

} // namespace

void addExportCommand(Command& app) {
    const auto o = std::make_shared<ExportCommand>();
    Command command = app.addCommand("export", "Write a scene's light for other programs");
    addSceneOptions(command, o->scene);
    addTimeOption(command, o->scene);
    addBakeOptions(command, o->bake);
    addViewOptions(command, o->camera);
    addRelightOptions(command, o->relight);
    Option list = command.flag("--list", o->list, "List the formats");
    command.get("scene").required(false);
    Option format = command.option("--format", o->format, "Format to write").oneOf(formatNames());
    command.option("--bake", o->bakeFile,
                   "Bake of the scene, .limnbake; default: a bake is made in memory");
    command.option("-o,--output", o->output, "File to write, or a folder");
    addSettingOptions(command, *o);
    command.option("--three", o->folders.three, "Folder of the npm package three, for web");
    command.option("--web-runtime", o->folders.webRuntime,
                   "Folder of limn_runtime.wasm, for web; ./run --web makes it");
    command.flag("--json", o->json, "Print one JSON object to stdout");
    command.onRun([o] { return runExport(*o); },
                  [o, list, format] {
                      const bool missing =
                          !list.isGiven() &&
                          (o->scene.scene.empty() || !format.isGiven() || o->output.empty());
                      return missing ? "A scene, --format and --output, or --list, is required"
                                     : std::string();
                  });
}

} // namespace limn
