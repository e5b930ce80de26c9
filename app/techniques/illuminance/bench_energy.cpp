// SPDX-License-Identifier: MIT
#include "app/bench/bench.h"
#include "app/commands/bake_options.h"
#include "app/commands/progress_line.h"
#include "app/commands/scene_options.h"
#include "app/techniques/illuminance/illuminance_program.h"

#include "engine/core/parallel.h"
#include "engine/scene/dark_backs.h"
#include "engine/stages/stage_store.h"
#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/measure/energy_chain.h"

#include <cmath>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

namespace limn {

namespace {

struct EnergyBench {
    SceneOptions scene;
    CameraOptions camera;
    BakeOptions bake;
    std::string output;
    std::uint32_t paths = 64, seed = 1;
    bool json = false;
};

constexpr Column kColumns[] = {{"scene", -18, "name"},
                               {"step", -24, "step"},
                               {"energy [%]", 10, "energy", 2, 100},
                               {"change [%]", 10, "change", 2, 100},
                               {"nRMSE", 8, "nrmse", 4}};

constexpr Column kSenderColumns[] = {{"scene", -18, "name"},
                                     {"senders from", 12, "from", 4},
                                     {"to [widths]", 12, "to", 4},
                                     {"share [%]", 10, "share", 2, 100},
                                     {"excess [%]", 10, "excess", 2, 100},
                                     {"+- [%]", 8, "noise", 2, 100}};

Result<EnergyChain> measure(const EnergyBench& o, Scene& scene) {
    applyBakeOptions(o.bake, scene.bake);
    const Result<Camera> camera = chooseCamera(scene, o.camera);
    if (!camera)
        return tl::make_unexpected(camera.error());
    const TraceScene trace(scene);
    StageStore store;
    Result<Bake> made = bake(trace, progressOnStderr(), &store);
    if (!made)
        return tl::make_unexpected(made.error());
    BakeSettings everySender = scene.bake;
    everySender.cut = CutCriterion::SolidAngle;
    everySender.links = 4096;
    Result<Bake> uncut = bake(trace, progressOnStderr(), &store, &everySender);
    if (!uncut)
        return tl::make_unexpected(uncut.error());
    const BakedSenders senders(trace, scene, *made, store);
    const EnergyBakes bakes{std::make_shared<const Bake>(std::move(*made)),
                            std::make_shared<const Bake>(std::move(*uncut)), senders};
    const EnergyChain chain = measureEnergyChain(
        trace, bakes, {*camera, o.camera.width, o.camera.height, o.paths, o.seed},
        progressOnStderr());
    endProgressLine();
    if (!chain.complete)
        return fail("cancelled");
    return chain;
}

Json senderRows(const std::string& name, const std::vector<SendersAt>& senders) {
    Json rows = Json::array();
    for (const SendersAt& s : senders)
        rows.push_back({{"name", name},
                        {"from", s.from},
                        {"to", std::isfinite(s.to) ? Json(s.to) : Json()},
                        {"share", s.share},
                        {"excess", s.excess},
                        {"noise", s.noise}});
    return rows;
}

/// Rows of steps, each with what it adds to the one before. Steps of pixels that see lamps are
/// called so.
Json stepRows(const std::string& name, const EnergyChain& chain,
              const std::vector<EnergyStep>& steps, bool onLamps) {
    Json rows = Json::array();
    double before = 1;
    for (const EnergyStep& s : steps) {
        rows.push_back({{"name", name},
                        {"step", onLamps ? s.name + " on lamps" : s.name},
                        {"energy", s.energy},
                        {"change", s.energy - before},
                        {"nrmse", s.nrmse},
                        {"reference_noise", onLamps ? Json() : Json(chain.noise)}});
        before = s.energy;
    }
    return rows;
}

/// The steps, light straight from lamps, and the steps of the pixels that see lamps.
Json energyRows(const std::string& name, const EnergyChain& chain) {
    Json rows = stepRows(name, chain, chain.steps, false);
    const auto append = [&](const Json& more) {
        for (const Json& row : more)
            rows.push_back(row);
    };
    if (chain.emitters.energy > 0)
        append(stepRows(name, chain, {chain.emitters}, false));
    append(stepRows(name, chain, chain.onLamps, true));
    return rows;
}

Exit runEnergyBench(const EnergyBench& o) {
    const ThreadLimit threads(o.bake.threads);
    const Result<ImportedScene> imported = openScene(o.scene);
    if (!imported)
        return failed(imported.error().message);
    Scene scene = flatten(imported->document, imported->assets);
    leaveOutDarkBacks(scene); // as the bake does
    const Result<EnergyChain> chain = measure(o, scene);
    if (!chain)
        return failed(fmt::format("{}: {}", o.scene.scene, chain.error().message));
    const std::string name = std::filesystem::path(o.scene.scene).stem().string();
    const Json rows = energyRows(name, *chain), senders = senderRows(name, chain->senders);
    if (!o.json) {
        fmt::print("{} points, {} of them on lamps; standard error of the reference's mean {:.3f} "
                   "%\n",
                   chain->pixels, chain->lamps, 100 * chain->noise);
        printTitles(kColumns);
        for (const Json& row : rows)
            printRow(kColumns, row);
        fmt::print("\n");
        printTitles(kSenderColumns);
        for (const Json& row : senders)
            printRow(kSenderColumns, row);
    }
    if (const Exit exit = writeRows(senders, o.output, "senders", false); exit != Exit::Done)
        return exit;
    return writeRows(rows, o.output, "energy", o.json);
}

} // namespace

void addEnergyBench(Command& bench) {
    const auto o = std::make_shared<EnergyBench>();
    o->camera.width = 160;
    o->camera.height = 90;
    Command command = bench.addCommand(
        "energy", "Energy that each step from path-traced light to the picture gains or loses");
    addSceneOptions(command, o->scene);
    addCameraOptions(command, o->camera);
    addBakeOptions(command, o->bake);
    command
        .option("-o,--output", o->output, "Folder for energy.csv and .json, senders.csv and .json")
        .required();
    command.option("--paths", o->paths, "Paths per pixel and per surfel").within(1, 1 << 20);
    command.option("--seed", o->seed, "Seed of the paths");
    command.flag("--json", o->json, "Print one JSON object to stdout");
    command.onRun([o] { return runEnergyBench(*o); });
}

} // namespace limn
