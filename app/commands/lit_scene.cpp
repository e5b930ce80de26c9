// SPDX-License-Identifier: MIT
#include "app/commands/lit_scene.h"

#include "engine/lightmap/atlas.h"
#include "engine/techniques/illuminance/bake/bake_defect.h"
#include "engine/techniques/illuminance/bake/bake_file.h"
#include "engine/techniques/illuminance/relight/cpu_illuminance.h"
#include "engine/techniques/technique_table.h"

#include <utility>

#include <fmt/format.h>

namespace limn {

/// Reads the bake and gives the scene the settings that it was made with.
static Result<Bake> readBakeOf(Scene& scene, const std::string& file, const MemoryBudget& memory) {
    Result<Bake> read = readBake(file, memory);
    if (!read)
        return read;
    const bool dimming = scene.bake.dimming; // the document's, not that of the time of the bake
    scene.bake = read->settings;
    scene.bake.dimming = dimming;
    if (read->sceneHash != bakeInputHash(scene))
        return fail(
            fmt::format("{}: is the bake of another scene, or of an older state of it", file));
    if (const std::string defect = bakeDefect(*read, &scene); !defect.empty())
        return fail(fmt::format("{}: {}", file, defect));
    return read;
}

Result<LitScene> lightScene(Scene scene, const std::string& bakeFile, const MemoryBudget& memory,
                            const Progress& progress) {
    const Technique& technique = *findTechnique(scene.technique.technique);
    if (technique.light && !bakeFile.empty())
        return fail(
            fmt::format("{}: the technique \"{}\" needs no bake", bakeFile, technique.name));
    LitScene lit;
    std::optional<Bake> read;
    if (!bakeFile.empty()) {
        Result<Bake> bake = readBakeOf(scene, bakeFile, memory);
        if (!bake)
            return tl::make_unexpected(bake.error());
        read = std::move(*bake);
    }
    lit.scene = std::make_shared<const Scene>(std::move(scene));
    lit.trace = std::make_shared<const TraceScene>(*lit.scene);
    if (technique.light) {
        lit.lighting = technique.light();
        lit.layout = std::make_shared<const LightmapLayout>(layoutWithoutLightmap(*lit.scene));
    } else {
        if (!read) {
            Result<Bake> made = bake(*lit.trace, progress, nullptr, nullptr, memory);
            if (!made)
                return tl::make_unexpected(made.error());
            read = std::move(*made);
        }
        lit.bake = std::make_shared<const Bake>(std::move(*read));
        lit.layout = {lit.bake, &lit.bake->lightmap};
        lit.lighting = std::make_unique<CpuIlluminance>(lit.bake, lit.scene);
    }
    lit.report = lit.lighting->update(
        {.scene = *lit.scene, .trace = lit.trace.get(), .bounces = lit.scene->bake.maxBounces},
        progress);
    if (progress.cancelled())
        return fail("cancelled");
    return lit;
}

} // namespace limn
