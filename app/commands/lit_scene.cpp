// SPDX-License-Identifier: MIT
#include "app/commands/lit_scene.h"

#include "engine/lightmap/atlas.h"
#include "engine/techniques/technique_table.h"

#include <utility>

#include <fmt/format.h>

namespace limn {

using Data = std::shared_ptr<const Precomputed>;

/// Reads the data and gives the scene the settings that it was made with.
static Result<Data> readDataOf(Scene& scene, const Precomputation& precomputation,
                               const std::string& file, const MemoryBudget& memory) {
    Result<Data> read = precomputation.read(file, memory);
    if (!read)
        return read;
    const bool dimming = scene.bake.dimming; // the document's, not that of the time of the bake
    scene.bake = (*read)->settings();
    scene.bake.dimming = dimming;
    if ((*read)->inputHash() != precomputation.inputHash(scene))
        return fail(
            fmt::format("{}: is the bake of another scene, or of an older state of it", file));
    if (const std::string defect = (*read)->defect(scene); !defect.empty())
        return fail(fmt::format("{}: {}", file, defect));
    return read;
}

Result<LitScene> lightScene(Scene scene, const std::string& bakeFile, const MemoryBudget& memory,
                            const Progress& progress) {
    const Technique& technique = *findTechnique(scene.technique.technique);
    const Precomputation* precomputation = technique.precomputation;
    if (!precomputation && !bakeFile.empty())
        return fail(
            fmt::format("{}: the technique \"{}\" needs no bake", bakeFile, technique.name));
    LitScene lit;
    Data data;
    if (!bakeFile.empty()) {
        Result<Data> read = readDataOf(scene, *precomputation, bakeFile, memory);
        if (!read)
            return tl::make_unexpected(read.error());
        data = *read;
    }
    lit.scene = std::make_shared<const Scene>(std::move(scene));
    lit.trace = std::make_shared<const TraceScene>(*lit.scene);
    if (precomputation && !data) {
        Result<Data> made = precomputation->prepare(*lit.trace, {.memory = memory}, progress);
        if (!made)
            return tl::make_unexpected(made.error());
        data = *made;
    }
    if (data) {
        lit.prepared = {data, lit.scene};
        lit.layout = {data, &data->layout()};
    } else {
        lit.layout = std::make_shared<const LightmapLayout>(layoutWithoutLightmap(*lit.scene));
    }
    lit.lighting = technique.light(lit.prepared);
    lit.report = lit.lighting->update(
        {.scene = *lit.scene, .trace = lit.trace.get(), .bounces = lit.scene->bake.maxBounces},
        progress);
    if (progress.cancelled())
        return fail("cancelled");
    return lit;
}

} // namespace limn
