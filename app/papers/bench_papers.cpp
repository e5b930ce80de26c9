// SPDX-License-Identifier: MIT
#include "app/papers/bench_papers.h"

#include "app/bench/bench.h"
#include "app/bench/place_on_device.h"
#include "app/papers/papers_page.h"
#include "app/program_version.h"
#include "app/techniques/technique_program.h"

#include "engine/core/log.h"
#include "engine/core/replace_file.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <thread>

#include <fmt/format.h>

namespace limn {

namespace {

struct PapersBench {
    PaperOptions run;
    std::vector<std::string> only; ///< keys; empty: all
    bool json = false;
};

std::vector<const PaperExperiment*> allExperiments() {
    std::vector<const PaperExperiment*> all;
    const auto add = [&](std::span<const PaperExperiment> some) {
        for (const PaperExperiment& experiment : some)
            all.push_back(&experiment);
    };
    for (const TechniqueProgram* program : techniquePrograms())
        if (program->experiments)
            add(program->experiments());
    add(browserExperiments());
    return all;
}

/// Why the experiment cannot be measured here; empty: it can.
std::string missing(const PaperRun& run, const PaperExperiment& experiment) {
    const std::string path = run.pathOf(*experiment.scene);
    if (!experiment.scene->file || std::filesystem::exists(path))
        return {};
    return fmt::format("there is no {}", path);
}

/// "limn 0.9, 2 threads, device llvmpipe".
Result<std::string> machineOf(PapersBench& o) {
    std::string machine = fmt::format("{}; CPU with {} threads", programVersion(),
                                      std::max(1U, std::thread::hardware_concurrency()));
    if (!o.run.onDevice)
        return machine + "; no device";
    const Result<LightPlace> device = placeOnDevice(o.run.device);
    if (!device && !o.run.device.empty())
        return fail("--device: " + device.error().message);
    o.run.onDevice = device.has_value();
    o.run.softwareDevice = device && device->device.find("llvmpipe") != std::string::npos;
    if (!device)
        logWarning("measuring on the CPU only: " + device.error().message);
    return device ? machine + "; device " + device->device : machine + "; no device";
}

Result<std::vector<PaperTable>> measureAll(const PapersBench& o) {
    Result<PaperRun> run = PaperRun::open(o.run);
    if (!run)
        return tl::make_unexpected(run.error());
    std::vector<PaperTable> tables;
    for (const PaperExperiment* experiment : allExperiments()) {
        if (!o.only.empty() && std::ranges::find(o.only, experiment->key) == o.only.end())
            continue;
        PaperTable table{experiment, {}, missing(*run, *experiment)};
        if (table.skipped.empty()) {
            if (!o.json) {
                fmt::print("{}, {}\n", experiment->key, experiment->title);
                std::fflush(stdout);
            }
            if (const Result<void> measured = experiment->measure(*run); !measured)
                return tl::make_unexpected(measured.error());
            table.lines = run->linesOf(experiment->key);
        } else {
            logWarning(fmt::format("{}: {}", experiment->key, table.skipped));
        }
        tables.push_back(std::move(table));
    }
    return tables;
}

Exit runPapersBench(PapersBench& o) {
    const Result<std::string> machine = machineOf(o);
    if (!machine)
        return failed(machine.error().message);
    const Result<std::vector<PaperTable>> tables = measureAll(o);
    if (!tables)
        return failed(tables.error().message);
    const Result<std::string> page = papersPage(*tables, *machine, o.run.output);
    if (!page)
        return failed(page.error().message);
    const std::string markdown = papersMarkdown(*tables, *machine);
    if (!o.json)
        fmt::print("\n{}", markdown);
    if (const Exit written = writeRows(papersRows(*tables), o.run.output, "papers", o.json);
        written != Exit::Done)
        return written;
    for (const auto& [file, text] :
         {std::pair<const char*, std::string>{"papers.html", *page}, {"papers.md", markdown}})
        if (const Result<void> written = replaceFile(o.run.output + "/" + file, text); !written)
            return failed(written.error().message);
    return Exit::Done;
}

} // namespace

void addPapersBench(Command& bench) {
    const auto o = std::make_shared<PapersBench>();
    Command command = bench.addCommand(
        "papers", "The papers' tables and figures, measured here beside the printed ones");
    command
        .option("-o,--output", o->run.output,
                "Folder for papers.html, papers.md, papers.csv and papers.json, which also keeps "
                "each finished line: a run that was stopped goes on from them")
        .required();
    command
        .option("--scenes", o->run.scenes,
                "Folder with sponza-crytek/Sponza.gltf and living-room/living-room.gltf; "
                "experiments whose scene is missing are skipped")
        .required();
    std::vector<std::string> keys;
    for (const PaperExperiment* experiment : allExperiments())
        keys.emplace_back(experiment->key);
    command.option("--only", o->only, "Experiments to measure, a list; default: all")
        .list()
        .oneOf(keys);
    command.option("--device", o->run.device, "Part of the Vulkan device's name");
    command.flag(
        "--cpu", [o] { o->run.onDevice = false; }, "Measure no device");
    command.option("--width", o->run.width, "Width of the pictures [pixels]").within(16, 4096);
    command.option("--height", o->run.height, "Height of the pictures [pixels]").within(16, 4096);
    command.option("--spp", o->run.samplesPerPixel, "Samples per pixel of either reference")
        .within(4, 1 << 20);
    command
        .option("--runs", o->run.runs,
                "Number of timed updates of each line; their median is "
                "printed")
        .within(1, 100000);
    command.flag("--json", o->json, "Print one JSON object to stdout");
    command.onRun([o] { return runPapersBench(*o); });
}

} // namespace limn
