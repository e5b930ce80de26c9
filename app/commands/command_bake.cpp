// SPDX-License-Identifier: MIT
#include "app/commands/bake_options.h"
#include "app/commands/command.h"
#include "app/commands/output_file.h"
#include "app/commands/progress_line.h"
#include "app/commands/scene_options.h"

#include "engine/core/log.h"
#include "engine/core/memory_budget.h"
#include "engine/core/parallel.h"
#include "engine/core/process_memory.h"
#include "engine/json/json.h"
#include "engine/measure/bake_to_error.h"
#include "engine/stages/stage_store.h"
#include "engine/techniques/technique_table.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

namespace limn {

namespace {

struct BakeCommand {
    SceneOptions scene;
    BakeOptions bake;
    StageStoreOptions store{.folder = defaultStageFolder()};
    double storeGib = 4;
    double error = 0; ///< that is to be held; 0: none
    CameraOptions camera;
    bool noStore = false;
    std::string output;
    bool json = false;
};

void printBytes(const Json& bytes) {
    for (const auto& [name, count] : bytes.members())
        fmt::print("{:<10} {:8.2f} MiB\n", name, double(count.get<std::uint64_t>()) / (1 << 20));
}

/// {"caches", "least_texels", "file_bytes", "peak_bytes"}; the peak is the process'.
Json summaryOf(const Prediction& p) {
    return {{"caches", p.caches},
            {"least_texels", p.minTexels},
            {"file_bytes", p.file},
            {"peak_bytes", std::max(residentMemory() + p.working, peakMemory())}};
}

void print(const BakeSettings& settings, const Json& predicted) {
    if (const auto minTexels = predicted["least_texels"].get<std::uint64_t>())
        fmt::print("{} texels are asked for, but the objects need at least about {}: one for each "
                   "direction that an object faces\n",
                   settings.lightmapCaches, minTexels);
    fmt::print("About {} caches, a file of {} and a peak of {} of memory\n",
               predicted["caches"].get<std::uint64_t>(),
               bytesText(predicted["file_bytes"].get<std::uint64_t>()),
               bytesText(predicted["peak_bytes"].get<std::uint64_t>()));
    std::fflush(stdout);
}

void print(const Precomputed& bake, std::uint64_t file, std::uint64_t peak) {
    const Json summary = bakeSummary(bake);
    const PrecomputedReport report = bake.report();
    for (const auto& [stage, seconds] : report.seconds)
        fmt::print("{:<10} {:8.2f} s\n", stage, seconds);
    fmt::print("{:<10} {:8.2f} s\n", "total", summary["seconds"]["total"].get<double>());
    for (const auto& [name, count] : summary["counts"].members())
        fmt::print("{:<16} {:>12}\n", name, count.get<std::uint64_t>());
    printBytes(summary["bytes"]);
    printBytes({{"file", file}, {"peak", peak}});
    for (const std::string& note : report.notes)
        fmt::print("{}\n", note);
    fmt::print("hash {}\n", summary["hash"].get<std::string>());
}

Json summaryOf(const Comparison& error) {
    return {{"nrmse", error.nrmse},
            {"nrmse_noise", error.nrmseNoise},
            {"nrmse_without_worst_percent", error.nrmseTrimmed},
            {"bias", error.bias}};
}

Json countsOf(const BakeSettings& s) {
    return {{"surfels", s.surfels},
            {"links", s.links},
            {"rays", s.rays},
            {"lightmap", s.lightmapCaches}};
}

void printStep(const MeasuredBake& made) {
    const BakeSettings& s = made.bake->settings();
    const double seconds = totalOf(made.bake->report().seconds);
    endProgressLine();
    fmt::print(
        "--lightmap {:<7} --surfels {:<7} --links {:<4} --rays {:<4} {:7.2f} s, error {:.3f} "
        "({:.3f} without the worst 1 %), bias {:+.1f} %\n",
        s.lightmapCaches, s.surfels, s.links, s.rays, seconds, made.error.nrmse,
        made.error.nrmseTrimmed, 100 * made.error.bias);
    std::fflush(stdout);
}

/// The bake, and with `error` its measured error.
Result<MeasuredBake> make(const BakeCommand& command, const Technique& technique,
                          const Camera& camera, const TraceScene& trace, StageStore* store) {
    const MemoryBudget& memory = command.scene.import.memory;
    Result<MeasuredBake> made;
    if (command.error > 0) {
        const auto step = [&](const MeasuredBake& bake) {
            if (!command.json)
                printStep(bake);
        };
        made = bakeToError(technique, trace, {command.error, camera}, progressOnStderr(), store,
                           memory, step);
    } else {
        auto baked = technique.precomputation->prepare(trace, {.store = store, .memory = memory},
                                                       progressOnStderr());
        if (baked)
            made->bake = std::move(*baked);
        else
            made = tl::make_unexpected(baked.error());
    }
    endProgressLine();
    if (!made)
        return fail(fmt::format("{}: {}", command.scene.scene, made.error().message));
    return made;
}

Exit runBake(const BakeCommand& command) {
    if (const Result<void> writable =
            checkOutputFile(command.output, {".limnbake"}, {command.scene.scene});
        !writable)
        return failed(writable.error().message);
    Result<ImportedScene> imported = openScene(command.scene);
    if (!imported)
        return failed(imported.error().message);
    const ThreadLimit threads(command.bake.threads);
    Scene scene = flatten(imported->document, imported->assets);
    const Result<Camera> camera = chooseCamera(scene, command.camera);
    if (!camera)
        return failed(camera.error().message);
    if (command.error > 0)
        kBakePresets.front().applyTo(scene.bake);
    applyBakeOptions(command.bake, scene.bake);
    StageStoreOptions options = command.store;
    options.maxDiskBytes = std::uint64_t(command.storeGib * double(1 << 30));
    if (command.noStore)
        options.folder.clear();
    options.maxMemoryBytes = 0; // nothing asks for a stage twice
    StageStore store(options);
    const TraceScene trace(scene);
    releaseFreedMemory(); // what reading the scene left behind; residentMemory() would count it
    const Technique& technique = precomputingTechnique(scene.technique);
    const Prediction prediction = technique.precomputation->predict(scene, !command.noStore);
    const Json predicted = summaryOf(prediction);
    if (!command.json)
        print(scene.bake, predicted);
    const Result<MeasuredBake> made =
        make(command, technique, *camera, trace, command.noStore ? nullptr : &store);
    store.flush();
    if (const std::string defect = store.defect(); !defect.empty())
        logWarning(fmt::format("{}; this bake was not kept", defect));
    if (!made)
        return failed(made.error().message);
    const Precomputed& baked = *made->bake;
    if (const Result<void> written = baked.write(command.output); !written)
        return failed(written.error().message);
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(command.output, error);
    const std::uint64_t file = error ? 0 : size, peak = peakMemory();
    if (command.json) {
        Json summary = bakeSummary(baked);
        if (command.error > 0) {
            summary["error"] = summaryOf(made->error);
            summary["settings"] = countsOf(baked.settings());
        }
        summary["file_bytes"] = file;
        summary["peak_bytes"] = peak;
        summary["predicted"] = predicted;
        summary["predicted_bytes"] = bytesSummary(prediction.bytes);
        fmt::print("{}\n", summary.dump());
    } else {
        print(baked, file, peak);
    }
    const std::string why = shortfall(*made, command.error);
    return why.empty() ? Exit::Done : failed(fmt::format("{}: {}", command.output, why));
}

} // namespace

void addBakeCommand(Command& app) {
    auto command = std::make_shared<BakeCommand>();
    Command sub = app.addCommand("bake", "Precompute a scene's light transport");
    addSceneOptions(sub, command->scene);
    addTimeOption(sub, command->scene);
    addBakeOptions(sub, command->bake);
    Option folder = sub.option(
        "--cache", command->store.folder,
        "Folder that keeps finished stages for later bakes; default: ~/.cache/limn/bake");
    sub.option("--cache-size", command->storeGib, "Maximum size of that folder [GiB]")
        .within(0.001, 1e6);
    sub.flag("--no-cache", command->noStore, "Bake every stage, and keep none").excludes(folder);
    sub.option("-o,--output", command->output, "File to write, .limnbake").required();
    Option error =
        sub.option("--error", command->error,
                   "Maximum nRMSE of the irradiance that the camera sees in the scene's light. "
                   "Counts start from those of draft, or those given, and grow until the "
                   "bake reaches it")
            .within(1e-3, 10.);
    addViewOptions(sub, command->camera);
    for (const char* view : {"--camera", "--eye", "--target", "--fov"})
        sub.get(view).needs(error);
    error.excludes(sub.get("--texels-per-metre"));
    sub.flag("--json", command->json, "Print one JSON object to stdout");
    sub.onRun([command] { return runBake(*command); });
}

} // namespace limn
