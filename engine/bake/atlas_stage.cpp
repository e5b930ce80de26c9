// SPDX-License-Identifier: MIT
#include "engine/bake/atlas_stage.h"

#include "engine/bake/charts.h"
#include "engine/bake/stage_archive.h"
#include "engine/core/hash.h"
#include "engine/core/parallel.h"

namespace limn {

namespace {

/// Charts of every mesh that a static instance uses. Returns false when cancelled.
bool chartMeshes(const Scene& scene, const std::vector<std::uint64_t>& meshes,
                 const Progress& progress, StageStore* store, std::vector<MeshCharts>& charts) {
    charts.assign(meshes.size(), {});
    std::vector<bool> used(charts.size());
    for (const Instance& i : scene.instances)
        used[i.mesh] = used[i.mesh] || !i.dynamic;
    return parallelRanges(
        charts.size(), 1, progress, "charts", [&](std::size_t begin, std::size_t end) {
            for (std::size_t m = begin; m < end; ++m)
                if (used[m])
                    charts[m] = keptOrMade<MeshCharts>(
                        store, hashValue(meshes[m], 21), progress,
                        [](auto& a, auto& c) { chartFields(a, c); },
                        [&] { return buildCharts(scene.assets->meshes[m], progress); });
        });
}

/// Of all that buildAtlas reads.
std::uint64_t atlasKey(const Scene& scene, const std::vector<std::uint64_t>& meshes) {
    std::uint64_t h = hashValue(scene.bake.lightmapCaches, 22);
    h = hashValue(scene.bake.texelsPerMetre, h);
    for (const Instance& i : scene.instances)
        h = hashValue(std::uint32_t(i.dynamic),
                      hashValue(atlasScale(i), hashValue(meshes[i.mesh], h)));
    return h;
}

} // namespace

std::optional<Atlas> atlasStage(const Scene& scene, const std::vector<std::uint64_t>& meshes,
                                const Progress& progress, StageStore* store) {
    std::vector<MeshCharts> charts;
    if (!chartMeshes(scene, meshes, progress, store, charts))
        return {};
    Atlas atlas = keptOrMade<Atlas>(
        store, atlasKey(scene, meshes), progress, [](auto& a, auto& t) { atlasFields(a, t); },
        [&] { return buildAtlas(scene, charts, scene.bake, progress); });
    if (progress.cancelled())
        return {};
    atlas.layout.meshes = std::move(charts);
    return atlas;
}

} // namespace limn
