// SPDX-License-Identifier: MIT
#include "app/bench/bench.h"
#include "app/commands/bake_options.h"
#include "app/commands/progress_line.h"
#include "app/commands/scene_options.h"
#include "app/techniques/illuminance/illuminance_program.h"

#include "engine/core/parallel.h"
#include "engine/lightmap/atlas_stage.h"
#include "engine/scene/mesh/input_hash.h"
#include "engine/stages/stage_store.h"
#include "engine/techniques/illuminance/measure/energy_chain.h"

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
                               {"step", -16, "step"},
                               {"energy [%]", 10, "energy", 2, 100},
                               {"change [%]", 10, "change", 2, 100},
                               {"nRMSE", 8, "nrmse", 4}};

/// The points of the lightmap's caches, which a bake does not keep.
CachePoints pointsOf(const TraceScene& trace, const Scene& scene, StageStore& store) {
    std::uint64_t rays = 0;
    const auto atlas = atlasStage(trace, scene, hashMeshes(scene), {}, &store, rays);
    CachePoints points;
    placeCaches(scene, atlas->atlas, points);
    return points;
}

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
    const CachePoints points = pointsOf(trace, scene, store);
    const EnergyBakes bakes{std::make_shared<const Bake>(std::move(*made)),
                            std::make_shared<const Bake>(std::move(*uncut)), points};
    const EnergyChain chain = measureEnergyChain(
        trace, bakes, {*camera, o.camera.width, o.camera.height, o.paths, o.seed},
        progressOnStderr());
    endProgressLine();
    if (!chain.complete)
        return fail("cancelled");
    return chain;
}

Exit runEnergyBench(const EnergyBench& o) {
    const ThreadLimit threads(o.bake.threads);
    const Result<ImportedScene> imported = openScene(o.scene);
    if (!imported)
        return failed(imported.error().message);
    Scene scene = flatten(imported->document, imported->assets);
    const Result<EnergyChain> chain = measure(o, scene);
    if (!chain)
        return failed(fmt::format("{}: {}", o.scene.scene, chain.error().message));
    if (!o.json) {
        fmt::print("{} points; standard error of the reference's mean {:.3f} %\n", chain->pixels,
                   100 * chain->noise);
        printTitles(kColumns);
    }
    Json rows = Json::array();
    double before = 1;
    for (const EnergyStep& s : chain->steps) {
        Json row = {{"name", std::filesystem::path(o.scene.scene).stem().string()},
                    {"step", s.name},
                    {"energy", s.energy},
                    {"change", s.energy - before},
                    {"nrmse", s.nrmse},
                    {"reference_noise", chain->noise}};
        before = s.energy;
        if (!o.json)
            printRow(kColumns, row);
        rows.push_back(std::move(row));
    }
    return writeRows(rows, o.output, "energy", o.json);
}

} // namespace

void addEnergyBench(CLI::App& bench, Run& run) {
    const auto o = std::make_shared<EnergyBench>();
    o->camera.width = 160;
    o->camera.height = 90;
    CLI::App* command = bench.add_subcommand(
        "energy", "Energy that each step from path-traced light to the picture gains or loses");
    addSceneOptions(*command, o->scene);
    addCameraOptions(*command, o->camera);
    addBakeOptions(*command, o->bake);
    command->add_option("-o,--output", o->output, "Folder for energy.csv and energy.json")
        ->required();
    command->add_option("--paths", o->paths, "Paths per pixel and per surfel")
        ->check(CLI::Range(1, 1 << 20));
    command->add_option("--seed", o->seed, "Seed of the paths");
    command->add_flag("--json", o->json, "Print one JSON object to stdout");
    command->callback([o, &run] { run = [o] { return runEnergyBench(*o); }; });
}

} // namespace limn
