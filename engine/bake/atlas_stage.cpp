// SPDX-License-Identifier: MIT
#include "engine/bake/atlas_stage.h"

#include "engine/bake/charts.h"
#include "engine/bake/input_hash.h"
#include "engine/bake/stage_archive.h"
#include "engine/bake/surfels.h"
#include "engine/bake/texel_sides.h"
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
    std::uint64_t h = hashValue(scene.bake.lightmapCaches, 26);
    h = hashValue(scene.bake.texelsPerMetre, h);
    for (const Instance& i : scene.instances) {
        h = hashValue(atlasScale(i), hashValue(meshes[i.mesh], h));
        h = hashValue(std::uint32_t(i.dynamic),
                      hashValue(std::uint32_t(isTwoSided(scene.materialOf(i))), h));
    }
    return h;
}

/// Of all that findTexelSides reads.
std::uint64_t texelSidesKey(const TraceScene& trace, const std::vector<std::uint64_t>& meshes,
                            std::uint64_t atlas) {
    const Scene& scene = trace.scene();
    std::uint64_t h = hashValue(trace.epsilonAt(glm::vec3(0)), hashValue(atlas, 31));
    for (const Instance& i : scene.instances) {
        h = hashValue(std::uint32_t(i.dynamic), hashValue(i.node, hashValue(meshes[i.mesh], h)));
        h = hashSurface(scene, scene.materialOf(i), hashBytes(&i.toWorld, sizeof i.toWorld, h));
    }
    return h;
}

} // namespace

std::optional<Atlas> atlasStage(const TraceScene& trace, const Scene& scene,
                                const std::vector<std::uint64_t>& meshes, const Progress& progress,
                                StageStore* store, std::uint64_t& rays) {
    std::vector<MeshCharts> charts;
    if (!chartMeshes(scene, meshes, progress, store, charts))
        return {};
    const std::uint64_t key = atlasKey(scene, meshes);
    Atlas atlas = keptOrMade<Atlas>(
        store, key, progress, [](auto& a, auto& t) { atlasFields(a, t); },
        [&] { return buildAtlas(scene, charts, scene.bake, progress); });
    if (progress.cancelled())
        return {};
    atlas.layout.meshes = std::move(charts);
    TexelSides sides = keptOrMade<TexelSides>(
        store, texelSidesKey(trace, meshes, key), progress,
        [](auto& a, auto& s) { a(s.texels), a(s.open), a(s.snaps); },
        [&] {
            TexelSides made = findTexelSides(trace, atlas, progress);
            rays += made.rays;
            return made;
        });
    if (progress.cancelled())
        return {};
    atlas.texels = std::move(sides.texels);
    atlas.open = std::move(sides.open);
    atlas.layout.snaps = std::move(sides.snaps);
    return atlas;
}

} // namespace limn
