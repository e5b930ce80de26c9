// SPDX-License-Identifier: MIT
#include "engine/bake/atlas_stage.h"

#include "engine/bake/bake_bytes.h"
#include "engine/bake/charts.h"
#include "engine/bake/density.h"
#include "engine/bake/fine_texels.h"
#include "engine/bake/input_hash.h"
#include "engine/bake/stage_archive.h"
#include "engine/bake/surfels.h"
#include "engine/bake/texel_sides.h"
#include "engine/core/hash.h"
#include "engine/core/parallel.h"

#include <algorithm>
#include <cmath>

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
                       const BakeSettings& settings, const BakeDensity& density) {
    std::uint64_t h = hashValue(settings.lightmapCaches, 34);
    h = hashValue(settings.texelsPerMetre, h);
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
            a.each(d.varied,
                   [&](auto& v) { a(v.instance), a(v.chart), a(v.at), a(v.back), a(v.fours); });
            a(d.baseShare), a(d.centre), a(d.size), a(d.nearest);
        },
        [&] {
            BakeDensity made = findDensity(trace, charts, texels, progress);
            rays += made.rays;
            return made;
        });
}

/// An atlas of coarse texels, and where finer ones are to be added to it.
struct LaidTexels {
    Atlas atlas;
    FineLookups fine;
    std::uint64_t key = 0; ///< of both
};

/// What the texels of a bake follow from, and where they are kept.
struct TexelInput {
    const TraceScene& trace;
    const Scene& scene;
    const std::vector<std::uint64_t>& meshes;
    const std::vector<MeshCharts>& charts;
    const BakeDensity& density;
    const Progress& progress;
    StageStore* store;
    std::uint64_t& rays;

    LaidTexels lay(std::uint32_t base, std::uint64_t most) const;
};

/// About `base` texels, and finer ones up to `most` in all. Unfinished when cancelled.
LaidTexels TexelInput::lay(std::uint32_t base, std::uint64_t most) const {
    BakeSettings settings = scene.bake;
    settings.lightmapCaches = std::max(base, 1U);
    LaidTexels result;
    result.key = atlasKey(scene, meshes, settings, density);
    result.atlas = keptOrMade<Atlas>(
        store, result.key, progress, [](auto& a, auto& t) { atlasFields(a, t); },
        [&] { return buildAtlas(scene, charts, settings, density.texels, progress); });
    result.atlas.layout.meshes = charts;
    if (density.varied.empty() || progress.cancelled())
        return result;
    const std::uint64_t laid = result.atlas.texels.size();
    result.fine = keptOrMade<FineLookups>(
        store, surfacesKey(trace, meshes, hashValue(result.key, hashValue(most, 36))), progress,
        [](auto& a, auto& f) { a.each(f.places, [&](auto& places) { a(places); }); },
        [&] {
            FineLookups made = findFineLookups(
                trace, result.atlas, density, std::uint32_t(most - std::min(most, laid)), progress);
            rays += made.rays;
            return made;
        });
    for (const std::vector<std::uint32_t>& places : result.fine.places)
        result.key = hashVector(places, result.key);
    return result;
}

/// As many texels as the settings ask for. How many finer ones a scene deserves is not known before
/// they are laid once; then both kinds are reduced by the same factor.
LaidTexels layTexels(const TexelInput& in) {
    const std::uint64_t wanted = in.scene.bake.lightmapCaches;
    if (in.density.varied.empty())
        return in.lay(std::uint32_t(wanted), 0);
    const auto share = [&](double part) {
        return std::uint32_t(std::lround(double(wanted) * part));
    };
    constexpr std::uint64_t kTrial = 4; // times those wanted
    const LaidTexels trial = in.lay(share(in.density.baseShare), kTrial * wanted);
    const double base = double(trial.atlas.texels.size()), all = base + double(trial.fine.texels());
    constexpr double kLeastBase = 0.25;
    return in.lay(share(std::max(base / std::max(all, 1.), kLeastBase)), wanted);
}

/// To those that lead to finer texels.
void addSnaps(std::vector<std::uint32_t> snaps, LightmapLayout& layout) {
    if (snaps.empty())
        return;
    for (std::size_t i = 0; i < layout.snaps.size(); ++i)
        if (layout.snaps[i] & kFineLookup)
            snaps[i] = layout.snaps[i];
    layout.snaps = std::move(snaps);
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
        density.texels.clear(), density.varied.clear();
    evenLamps(scene, density.surfels);
    LaidTexels laid = layTexels({trace, scene, meshes, charts, density, progress, store, rays});
    if (progress.cancelled())
        return {};
    Atlas& atlas = laid.atlas;
    const std::vector<PlacedTriangle> placed = addFineTexels(scene, density, laid.fine, atlas);
    TexelSides sides = keptOrMade<TexelSides>(
        store, surfacesKey(trace, meshes, hashValue(laid.key, 31)), progress,
        [](auto& a, auto& s) { a(s.texels), a(s.open), a(s.snaps); },
        [&] {
            TexelSides made = findTexelSides(trace, atlas, placed, progress);
            rays += made.rays;
            return made;
        });
    if (progress.cancelled())
        return {};
    atlas.texels = std::move(sides.texels);
    atlas.open = std::move(sides.open);
    addSnaps(std::move(sides.snaps), atlas.layout);
    return PlacedAtlas{std::move(atlas), std::move(density.surfels)};
}

} // namespace limn
