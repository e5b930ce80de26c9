// SPDX-License-Identifier: MIT
#include "engine/bake/atlas_stage.h"

#include "engine/bake/bake_bytes.h"
#include "engine/bake/charts.h"
#include "engine/bake/density.h"
#include "engine/bake/input_hash.h"
#include "engine/bake/stage_archive.h"
#include "engine/bake/surfels.h"
#include "engine/bake/texel_sides.h"
#include "engine/core/hash.h"
#include "engine/core/parallel.h"

#include <algorithm>

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
std::uint64_t atlasKey(const Scene& scene, const std::vector<std::uint64_t>& meshes,
                       const BakeDensity& density) {
    std::uint64_t h = hashValue(scene.bake.lightmapCaches, 34);
    h = hashValue(scene.bake.texelsPerMetre, h);
    for (const Instance& i : scene.instances) {
        h = hashValue(atlasScale(i), hashValue(meshes[i.mesh], h));
        h = hashValue(std::uint32_t(i.dynamic),
                      hashValue(std::uint32_t(isTwoSided(scene.materialOf(i))), h));
    }
    for (const std::vector<float>& factors : density.texels)
        h = hashVector(factors, h);
    return h;
}

/// Of what rays meet, and `seed`.
std::uint64_t surfacesKey(const TraceScene& trace, const std::vector<std::uint64_t>& meshes,
                          std::uint64_t seed) {
    const Scene& scene = trace.scene();
    std::uint64_t h = hashValue(trace.epsilonAt(glm::vec3(0)), seed);
    for (const Instance& i : scene.instances) {
        h = hashValue(std::uint32_t(i.dynamic), hashValue(i.node, hashValue(meshes[i.mesh], h)));
        h = hashSurface(scene, scene.materialOf(i), hashBytes(&i.toWorld, sizeof i.toWorld, h));
    }
    return h;
}

/// Lamps have one density: caches aim at their surfels by areas, which are exact only then. (Which
/// materials emit may change without tracing anything again.)
void evenLamps(const Scene& scene, std::vector<SurfelDensity>& surfels) {
    for (const Instance& i : scene.instances)
        if (!surfels.empty() && emits(scene.materialOf(i)))
            surfels[i.mesh] = {};
}

BakeDensity densityStage(const TraceScene& trace, const std::vector<std::uint64_t>& meshes,
                         const std::vector<MeshCharts>& charts, std::uint32_t texels,
                         const Progress& progress, StageStore* store, std::uint64_t& rays) {
    return keptOrMade<BakeDensity>(
        store, surfacesKey(trace, meshes, hashValue(texels, 35)), progress,
        [](auto& a, auto& d) {
            a.each(d.texels, [&](auto& factors) { a(factors); });
            a.each(d.surfels, [&](auto& s) { a(s.level), a(s.begin), a(s.density); });
        },
        [&] {
            BakeDensity made = findDensity(trace, charts, texels, progress);
            rays += made.rays;
            return made;
        });
}

} // namespace

std::optional<PlacedAtlas> atlasStage(const TraceScene& trace, const Scene& scene,
                                      const std::vector<std::uint64_t>& meshes,
                                      const Progress& progress, StageStore* store,
                                      std::uint64_t& rays) {
    std::vector<MeshCharts> charts;
    if (!chartMeshes(scene, meshes, progress, store, charts))
        return {};
    const auto texels =
        scene.bake.texelsPerMetre > 0
            ? std::uint32_t(std::clamp<std::uint64_t>(expectedCaches(scene), 1, 1U << 24))
            : scene.bake.lightmapCaches;
    BakeDensity density = densityStage(trace, meshes, charts, texels, progress, store, rays);
    if (progress.cancelled())
        return {};
    if (scene.bake.texelsPerMetre > 0)
        density.texels.clear();
    evenLamps(scene, density.surfels);
    const std::uint64_t key = atlasKey(scene, meshes, density);
    Atlas atlas = keptOrMade<Atlas>(
        store, key, progress, [](auto& a, auto& t) { atlasFields(a, t); },
        [&] { return buildAtlas(scene, charts, scene.bake, density.texels, progress); });
    if (progress.cancelled())
        return {};
    atlas.layout.meshes = std::move(charts);
    TexelSides sides = keptOrMade<TexelSides>(
        store, surfacesKey(trace, meshes, hashValue(key, 31)), progress,
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
    return PlacedAtlas{std::move(atlas), std::move(density.surfels)};
}

} // namespace limn
