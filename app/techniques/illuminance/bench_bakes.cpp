// SPDX-License-Identifier: MIT
#include "app/techniques/illuminance/bench_bakes.h"

#include "app/commands/progress_line.h"

#include "engine/core/parallel.h"
#include "engine/scene/bake_settings_fields.h"
#include "engine/stages/stage_store.h"
#include "engine/techniques/illuminance/bake/baker.h"

#include <filesystem>

#include <fmt/format.h>

namespace limn {

Option addBenchBakes(Command& command, BenchBakes& o) {
    Option scenes = command.option(
        "scenes", o.scenes, "Scenes (.gltf, .glb), projects (.limn), or names of sample projects");
    scenes.required();
    addLightOptions(command, o.common);
    command.option("--surfels", o.surfels, "Surfels n_S, a list").list().within(64, 1 << 20);
    command.option("--links", o.links, "Links per cache n_L, a list").list().within(1, 4096);
    command.option("--bands", o.bands, "SH bands of the caches, a list").list().within(2, 8);
    command.option("--chroma-bands", o.chromaBands, "SH bands that keep colour, a list; 0: all")
        .list()
        .within(0, 8);
    command.option("--storage", o.storages, "How links are stored, a list")
        .list()
        .oneOf(namesIn(kStorageNames));
    command.option("--rays", o.rays, "Rays per cache").within(16, 65536);
    command.option("--lightmap", o.lightmap, "Target number of lightmap caches").within(1, 1 << 24);
    command.option("--threads", o.threads, "Threads to use; 0: all").within(0, 1024);
    return scenes;
}

static std::vector<BakeSettings> sweep(const BenchBakes& o) {
    std::vector<BakeSettings> rows;
    BakeSettings s;
    s.rays = o.rays;
    s.lightmapCaches = o.lightmap;
    s.grid = o.grid;
    for (const std::uint32_t surfels : o.surfels)
        for (const std::uint32_t links : o.links)
            for (const std::string& storage : o.storages)
                for (const std::uint32_t bands : o.bands)
                    for (const std::uint32_t chroma : o.chromaBands) {
                        if (chroma > bands)
                            continue;
                        s.surfels = surfels;
                        s.links = links;
                        s.storage = named<LinkStorage>(kStorageNames, storage);
                        s.bands = bands;
                        s.chromaBands = chroma;
                        rows.push_back(s);
                    }
    return rows;
}

static Result<void> bakeScene(const BenchBakes& o, const std::string& path,
                              const std::function<Result<void>(const BenchBake&)>& measure) {
    SceneOptions options = o.common;
    options.scene = path;
    const Result<ImportedScene> imported = openScene(options);
    if (!imported)
        return tl::make_unexpected(imported.error());
    const Scene scene = flatten(imported->document, imported->assets);
    const TraceScene trace(scene);
    StageStore store;
    for (const BakeSettings& settings : sweep(o)) {
        Result<Bake> made = bake(trace, progressOnStderr(), &store, &settings);
        endProgressLine();
        if (!made)
            return fail(fmt::format("{}: {}", path, made.error().message));
        const Result<void> measured =
            measure({std::filesystem::path(path).stem().string(), scene, trace,
                     std::make_shared<const Bake>(std::move(*made))});
        if (!measured)
            return fail(fmt::format("{}: {}", path, measured.error().message));
    }
    return {};
}

Result<void> forEachBake(const BenchBakes& options,
                         const std::function<Result<void>(const BenchBake&)>& measure) {
    const ThreadLimit threads(options.threads);
    for (const std::string& scene : options.scenes)
        if (Result<void> measured = bakeScene(options, scene, measure); !measured)
            return measured;
    return {};
}

Json settingsOf(const BenchBake& baked) {
    const BakeSettings& s = baked.bake->settings;
    return {{"surfels", s.surfels},
            {"links", s.links},
            {"bands", s.bands},
            {"chroma_bands", chromaBandsOf(s)},
            {"storage", kStorageNames[std::size_t(s.storage)]}};
}

} // namespace limn
