// SPDX-License-Identifier: MIT
#include "app/bake_options.h"
#include "app/command.h"
#include "app/number_range.h"
#include "app/output_file.h"
#include "app/progress_line.h"
#include "app/scene_options.h"

#include "engine/bake/stage_store.h"
#include "engine/core/log.h"
#include "engine/core/memory_budget.h"
#include "engine/core/parallel.h"
#include "engine/core/process_memory.h"
#include "engine/files/bake_file.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace limn {

namespace {

struct BakeCommand {
    SceneOptions scene;
    BakeOptions bake;
    StageStoreOptions store{.folder = defaultStageFolder()};
    double storeGib = 4;
    bool noStore = false;
    std::string output;
    bool json = false;
};

void printBytes(const nlohmann::json& bytes) {
    for (const auto& [name, count] : bytes.items())
        fmt::print("{:<10} {:8.2f} MiB\n", name, double(count.get<std::uint64_t>()) / (1 << 20));
}

/// {"caches", "least_texels", "file_bytes", "peak_bytes"}; the peak is the process'.
nlohmann::json summaryOf(const BakePrediction& p) {
    return {{"caches", p.caches},
            {"least_texels", p.leastTexels},
            {"file_bytes", p.file},
            {"peak_bytes", std::max(residentMemory() + p.working, peakMemory())}};
}

void print(const BakeSettings& settings, const nlohmann::json& predicted) {
    if (const auto least = predicted["least_texels"].get<std::uint64_t>())
        fmt::print("{} texels are asked for, but the objects need at least about {}: one for each "
                   "way that an object faces\n",
                   settings.lightmapCaches, least);
    fmt::print("About {} caches, a file of {} and a peak of {} of memory\n",
               predicted["caches"].get<std::uint64_t>(),
               bytesText(predicted["file_bytes"].get<std::uint64_t>()),
               bytesText(predicted["peak_bytes"].get<std::uint64_t>()));
    std::fflush(stdout);
}

void print(const Bake& bake, std::uint64_t file, std::uint64_t peak) {
    const nlohmann::json summary = bakeSummary(bake);
    for (const auto& [stage, seconds] : bake.seconds)
        fmt::print("{:<10} {:8.2f} s\n", stage, seconds);
    fmt::print("{:<10} {:8.2f} s\n", "total", summary["seconds"]["total"].get<double>());
    for (const auto& [name, count] : summary["counts"].items())
        fmt::print("{:<16} {:>12}\n", name, count.get<std::uint64_t>());
    printBytes(summary["bytes"]);
    printBytes({{"file", file}, {"peak", peak}});
    for (const std::string& note : bake.notes)
        fmt::print("{}\n", note);
    fmt::print("hash {}\n", summary["hash"].get<std::string>());
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
    applyBakeOptions(command.bake, scene.bake);
    StageStoreOptions options = command.store;
    options.mostDiskBytes = std::uint64_t(command.storeGib * double(1 << 30));
    if (command.noStore)
        options.folder.clear();
    options.mostMemoryBytes = 0; // nothing asks for a stage twice
    StageStore store(options);
    const TraceScene trace(scene);
    releaseFreedMemory(); // what reading the scene left behind; residentMemory() would count it
    const BakePrediction prediction = predictBake(scene, !command.noStore);
    const nlohmann::json predicted = summaryOf(prediction);
    if (!command.json)
        print(scene.bake, predicted);
    const Result<Bake> baked = bake(trace, progressOnStderr(), command.noStore ? nullptr : &store,
                                    nullptr, command.scene.import.memory);
    endProgressLine();
    store.flush();
    if (const std::string defect = store.defect(); !defect.empty())
        logWarning(fmt::format("{}; this bake was not kept", defect));
    if (!baked)
        return failed(fmt::format("{}: {}", command.scene.scene, baked.error().message));
    if (const Result<void> written = writeBake(command.output, *baked); !written)
        return failed(written.error().message);
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(command.output, error);
    const std::uint64_t file = error ? 0 : size, peak = peakMemory();
    if (command.json) {
        nlohmann::json summary = bakeSummary(*baked);
        summary["file_bytes"] = file;
        summary["peak_bytes"] = peak;
        summary["predicted"] = predicted;
        summary["predicted_bytes"] = bytesSummary(prediction.bytes);
        fmt::print("{}\n", summary.dump());
    } else {
        print(*baked, file, peak);
    }
    return Exit::Done;
}

} // namespace

void addBakeCommand(CLI::App& app, Run& run) {
    auto command = std::make_shared<BakeCommand>();
    CLI::App* sub = app.add_subcommand("bake", "Precompute a scene's light transport");
    addSceneOptions(*sub, command->scene);
    addBakeOptions(*sub, command->bake);
    CLI::Option* folder = sub->add_option(
        "--cache", command->store.folder,
        "Folder that keeps finished stages for later bakes; default ~/.cache/limn/bake");
    sub->add_option("--cache-size", command->storeGib, "Most that the folder may hold [GiB]")
        ->check(numberWithin(0.001, 1e6));
    sub->add_flag("--no-cache", command->noStore, "Bake everything, keep nothing")
        ->excludes(folder);
    sub->add_option("-o,--output", command->output, "File to write, .limnbake")->required();
    sub->add_flag("--json", command->json, "One JSON object on stdout");
    sub->callback([command, &run] { run = [command] { return runBake(*command); }; });
}

} // namespace limn
