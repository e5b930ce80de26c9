// SPDX-License-Identifier: MIT
#include "app/bench/bench.h"
#include "app/commands/bake_options.h"
#include "app/commands/progress_line.h"
#include "app/commands/scene_options.h"
#include "app/techniques/illuminance/illuminance_program.h"

#include "engine/core/parallel.h"
#include "engine/scene/bake_settings_fields.h"
#include "engine/scene/dark_backs.h"
#include "engine/stages/stage_store.h"
#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/measure/baked_senders.h"
#include "engine/techniques/illuminance/measure/link_error.h"
#include "engine/techniques/illuminance/relight/relight.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

#include <fmt/format.h>

namespace limn {

namespace {

struct LinksBench {
    SceneOptions common;
    BakeOptions bake;
    std::vector<std::string> scenes;
    std::string output;
    std::uint32_t caches = 256, multiple = 64;
    bool json = false;
};

std::string columnOf(const char* what, int i) {
    return fmt::format("{}_{}", what, i);
}

Json rowOf(const std::string& name, const Bake& baked, CacheKind kind, std::uint32_t multiple,
           std::size_t caches, const LinkError& error) {
    Json row = {{"name", name},
                {"caches", kind == CacheKind::Grid ? "grid" : "lightmap"},
                {"storage", kStorageNames[std::size_t(baked.settings.storage)]},
                {"bands", baked.settings.bands},
                {"rays", baked.settings.rays},
                {"reference_rays", baked.settings.rays * multiple},
                {"caches_measured", caches},
                {"links", error.links},
                {"unlinked", error.unlinked}};
    // Three at least, which the table shows.
    const int bands = int(baked.settings.bands), columns = std::max(bands, kIrradianceBands);
    for (const auto& [what, errors] :
         {std::pair("link_band", &error.link), {"lit_band", &error.lit}})
        for (int l = 0; l < columns; ++l)
            row[columnOf(what, l)] = l < bands ? Json((*errors)[std::size_t(l)]) : Json();
    for (std::size_t t = 0; t < LinkError::kTilts.size(); ++t)
        row[columnOf("irradiance", int(LinkError::kTilts[t]))] = error.irradiance[t];
    return row;
}

Result<void> measureScene(const LinksBench& o, const std::string& path, Json& rows) {
    SceneOptions options = o.common;
    options.scene = path;
    const Result<ImportedScene> imported = openScene(options);
    if (!imported)
        return tl::make_unexpected(imported.error());
    Scene scene = flatten(imported->document, imported->assets);
    leaveOutDarkBacks(scene); // as the bake does
    applyBakeOptions(o.bake, scene.bake);
    const TraceScene trace(scene);
    StageStore store;
    std::vector<std::shared_ptr<const Bake>> bakes;
    for (const LinkStorage storage : {LinkStorage::Rtp, LinkStorage::Sh}) {
        if (hasOption(o.bake, "storage") && storage != scene.bake.storage)
            continue;
        BakeSettings settings = scene.bake;
        settings.storage = storage;
        Result<Bake> made = bake(trace, progressOnStderr(), &store, &settings);
        if (!made)
            return fail(fmt::format("{}: {}", path, made.error().message));
        bakes.push_back(std::make_shared<const Bake>(std::move(*made)));
    }
    const BakedSenders senders(trace, scene, *bakes[0], store);
    Relighter relighter(bakes[0]);
    relighter.relight(scene, trace, scene.relight.maxBounces);
    const std::vector<glm::vec4>& radiosity = relighter.radiosity();
    if (std::ranges::none_of(radiosity, [](const glm::vec4& b) { return b.w > 0; }))
        return fail(fmt::format("{}: nothing is lit; --light adds a lamp", path));
    const std::string name = std::filesystem::path(path).stem().string();
    for (const CacheKind kind : {CacheKind::Hemisphere, CacheKind::Grid}) {
        const bool grid = kind == CacheKind::Grid;
        const SightReference reference = traceSights(trace, senders.set, senders.owners, *bakes[0],
                                                     kind, grid ? senders.grid : senders.lightmap,
                                                     grid ? bakes[0]->caches.lightmapCount : 0,
                                                     o.caches, o.multiple, progressOnStderr());
        endProgressLine();
        if (reference.cache.empty())
            continue;
        for (const auto& baked : bakes) {
            Json row = rowOf(name, *baked, kind, o.multiple, reference.cache.size(),
                             measureLinks(*baked, reference, radiosity));
            rows.push_back(std::move(row));
        }
    }
    return {};
}

/// The first three bands are what irradiance reads.
constexpr Column kLinkColumns[] = {
    {"scene", -14, "name"},          {"caches", -8, "caches"},      {"links", -5, "storage"},
    {"link 0", 7, "link_band_0", 4}, {"1", 7, "link_band_1", 4},    {"2", 7, "link_band_2", 4},
    {"lit 0", 7, "lit_band_0", 4},   {"1", 7, "lit_band_1", 4},     {"2", 7, "lit_band_2", 4},
    {"E 0", 7, "irradiance_0", 4},   {"30", 7, "irradiance_30", 4}, {"60", 7, "irradiance_60", 4},
    {"unlinked", 8, "unlinked", 4}};

Exit runLinksBench(const LinksBench& o) {
    const ThreadLimit threads(o.bake.threads);
    Json rows = Json::array();
    for (const std::string& scene : o.scenes)
        if (const Result<void> measured = measureScene(o, scene, rows); !measured)
            return failed(measured.error().message);
    if (!o.json) {
        printTitles(kLinkColumns);
        for (const Json& row : rows)
            printRow(kLinkColumns, row);
    }
    return writeRows(rows, o.output, "links", o.json);
}

} // namespace

void addLinksBench(Command& bench) {
    const auto o = std::make_shared<LinksBench>();
    Command command = bench.addCommand(
        "links", "Error of links as cones and as harmonics against links of many more rays");
    command
        .option("scenes", o->scenes,
                "Scenes (.gltf, .glb), projects (.limn), or names of sample projects")
        .required();
    addLightOptions(command, o->common);
    addBakeOptions(command, o->bake);
    command.option("-o,--output", o->output, "Folder for links.csv and links.json").required();
    command.option("--caches", o->caches, "Maximum number of measured caches of each kind")
        .within(1, 1 << 20);
    command
        .option("--reference-rays", o->multiple,
                "Rays of the reference, as a multiple of the bake's")
        .within(1, 1024);
    command.flag("--json", o->json, "Print one JSON object to stdout");
    command.onRun([o] { return runLinksBench(*o); });
}

} // namespace limn
