// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/bake.h"
#include "engine/techniques/illuminance/bake/bake_bytes.h"

#include "engine/core/hash.h"
#include "engine/core/parallel.h"
#include "engine/core/process_memory.h"
#include "engine/field/grid_depth.h"
#include "engine/lightmap/atlas_stage.h"
#include "engine/lightmap/layout_rules.h"
#include "engine/scene/mesh/input_hash.h"
#include "engine/scene/reach.h"
#include "engine/stages/stage_archive.h"
#include "engine/stages/stage_keys.h"
#include "engine/techniques/illuminance/bake/receivers/cache_points.h"
#include "engine/techniques/illuminance/bake/receivers/fill_invalid.h"
#include "engine/techniques/illuminance/bake/receivers/seen_patches.h"
#include "engine/techniques/illuminance/bake/senders/cluster_tree.h"
#include "engine/techniques/illuminance/bake/senders/surfel_normals.h"
#include "engine/techniques/illuminance/bake/senders/surfels.h"
#include "engine/techniques/illuminance/bake/transport/cut.h"
#include "engine/techniques/illuminance/bake/transport/rooms.h"
#include "engine/techniques/illuminance/bake/transport/surfel_gain.h"
#include "engine/techniques/illuminance/bake/transport/trace_record.h"
#include "engine/techniques/illuminance/bake/transport/trace_stage.h"

#include <algorithm>
#include <chrono>
#include <optional>

#include <fmt/format.h>

namespace limn {

namespace {

class StageClock {
public:
    explicit StageClock(std::vector<std::pair<std::string, double>>& seconds)
        : m_seconds(seconds) {}
    void finish(const char* stage) {
        const auto now = std::chrono::steady_clock::now();
        m_seconds.emplace_back(stage, std::chrono::duration<double>(now - m_last).count());
        m_last = now;
    }

private:
    std::vector<std::pair<std::string, double>>& m_seconds;
    std::chrono::steady_clock::time_point m_last = std::chrono::steady_clock::now();
};

/// The form factor linker's rays only tell which points lie in walls.
std::uint32_t raysPerCache(const BakeSettings& settings) {
    constexpr std::uint32_t kFormFactorRays = 112; // 16 for each point of a texel
    return settings.linker == Linker::Gather ? settings.rays
                                             : std::min(settings.rays, kFormFactorRays);
}

/// Quick bakes with few rays skip this step, which would make them half as long again.
std::uint32_t raysForPatches(const BakeSettings& settings) {
    return settings.rays < 128 ? 0 : std::min(settings.rays / 16, 32U);
}

/// Finds the cells of patches that walls separate from their surfels.
PatchSides patchSidesStage(const TraceScene& trace, const SurfelSet& set, const OwnerTables& owners,
                           const std::vector<std::uint64_t>& meshes, const Progress& progress,
                           StageStore* store, std::uint64_t& rays) {
    const std::uint64_t key = stageKey(
        Stage::PatchSides, hashRecord(describeTrace(trace, set, owners, {}, {{0}}, 1, meshes)));
    const Scene& scene = trace.scene();
    return keptOrMade<PatchSides>(
        store, key, progress,
        [&](auto& a, auto& s) {
            a("changed", s.changed, rule::noneOr(set.surfels.size()));
            a.each("owner", s.owner, rule::noneOr(scene.instances.size()), [&](auto& of) {
                const auto i = std::uint32_t(&of - s.owner.data());
                a("owner", of,
                  rule::holds("of another length",
                              [&](const auto& cells) {
                                  return cells.empty() || cells.size() == owners.cellsOf(i);
                              }),
                  rule::below(set.instanceBegin[i + 1] - set.instanceBegin[i]));
            });
        },
        [&] {
            PatchSides made = findPatchSides(trace, set, owners, progress);
            rays += made.rays;
            return made;
        });
}

/// Finds the surfels' places and own caches from what the surface's caches see.
SeenPatches seenPatchesStage(const TraceScene& trace, const SurfelSet& set,
                             const OwnerTables& owners, const Atlas& atlas, const Caches& caches,
                             const CachePoints& points, std::uint32_t looks,
                             const std::vector<std::uint64_t>& meshes, const Progress& progress,
                             StageStore* store, std::uint64_t& rays) {
    const std::uint64_t rayStarts =
        hashRecord(describeTrace(trace, set, owners, caches, points, std::max(looks, 1U), meshes));
    const std::uint32_t texels = atlas.layout.width * atlas.layout.height;
    const std::uint64_t key = stageKey(Stage::SeenPatches, hashValue(texels, rayStarts));
    const Scene& scene = trace.scene();
    return keptOrMade<SeenPatches>(
        store, key, progress,
        [&](auto& a, auto& s) {
            const std::uint64_t n = set.surfels.size();
            a("place", s.place, rule::count(n),
              rule::each("not on its mesh", [&](std::size_t i, const MeshPoint& p) {
                  return isPointOf(scene.meshOf(scene.instances[set.surfels.instance[i]]), p);
              }));
            a("cache", s.cache, rule::count(n), rule::belowOr(caches.lightmapCount, ~0U));
            a("cacheWeight", s.cacheWeight, rule::count(n), rule::within(0, 1 + 1e-4));
            a("own", s.own, rule::each("out of range", [&](std::size_t i, const OwnCache& own) {
                  return i < texels - caches.lightmapCount && own.back <= 1 &&
                         own.instance < scene.instances.size() &&
                         arePointsOf(scene.meshOf(scene.instances[own.instance]), own);
              }));
            a("ownCache", s.ownCache, rule::count(n), rule::belowOr(s.own.size(), ~0U));
        },
        [&] {
            SeenPatches made =
                findSeenPatches(trace, set, owners, atlas, caches, points, looks, progress);
            rays += made.rays;
            return made;
        });
}

/// Traces the training lights' shadow rays, again only near what moved.
TracedTraining trainingStage(const TraceScene& trace, const Surfels& surfels, TraceReport& traced,
                             const Progress& progress, StageStore* store) {
    const auto fields = [&surfels](auto& a, auto& t) {
        a("irradiance", t.irradiance, rule::count(surfels.size() * TracedTraining::kCount),
          rule::within(0, 1e15)); // its square stays within float
        a("lamps", t.lamps, rule::count(TracedTraining::kLamps), rule::inReach());
        a("position", t.position, rule::count(surfels.size()), rule::inReach());
    };
    const auto key = [](std::uint64_t of) { return stageKey(Stage::Training, of); };
    return keptOrMade<TracedTraining>(store, key(traced.key), progress, fields, [&] {
        std::optional<EarlierTraining> earlier;
        if (traced.moved)
            if (auto light = kept<TracedTraining>(*store, key(traced.moved->key), fields))
                earlier = {std::move(*light), std::move(*traced.moved)};
        return traceTraining(trace, surfels, earlier ? &*earlier : nullptr, progress);
    });
}

BakeCounts countOf(const Scene& scene, const Bake& bake, std::uint64_t rays) {
    BakeCounts counts;
    for (const Instance& i : scene.instances)
        counts.triangles += scene.meshOf(i).triangleCount();
    counts.surfels = bake.surfels.size();
    counts.clusters = bake.tree.left.size();
    counts.caches = bake.caches.size();
    counts.links = bake.caches.linkCount();
    counts.rays = rays;
    return counts;
}

} // namespace

Result<Bake> bake(const TraceScene& trace, const Progress& progress, StageStore* store,
                  const BakeSettings* settings, const MemoryBudget& memory) {
    Scene scene = trace.scene();
    if (settings)
        scene.bake = *settings;
    if (const std::string defect = settingsDefect(scene.bake); !defect.empty())
        return fail(defect);
    if (const std::string defect = reachDefect(scene); !defect.empty())
        return fail(defect);
    const BakePrediction predicted = predictBake(scene, store != nullptr);
    if (const Result<void> fits =
            memory.allow(fmt::format("a bake of {} caches with {} rays and {} links each",
                                     predicted.caches, scene.bake.rays, scene.bake.links),
                         predicted.working);
        !fits)
        return fail("bake settings: " + fits.error().message + ": lower rays, lightmap or grid");
    const auto cancelled = [] { return fail("cancelled"); };
    Bake result;
    result.settings = scene.bake;
    result.sceneHash = bakeInputHash(scene);
    StageClock clock(result.seconds);

    const std::vector<std::uint64_t> meshes = hashMeshes(scene);
    std::uint64_t rays = 0;
    std::optional<PlacedAtlas> placed = atlasStage(trace, scene, meshes, progress, store, rays);
    if (!placed)
        return cancelled();
    Atlas& atlas = placed->atlas;
    clock.finish("charts");

    progress.at("surfels", 0);
    SurfelSet set = placeSurfels(scene, scene.bake.surfels, placed->surfels, progress, store);
    if (progress.cancelled())
        return cancelled();
    if (set.surfels.size() == 0)
        return fail("nothing to bake: the scene has no static triangles");
    clock.finish("surfels");

    progress.at("clusters", 0);
    result.tree = buildClusterTree(scene, set, progress, store);
    if (progress.cancelled())
        return cancelled();
    clock.finish("clusters");

    result.gridBounds = gridBoundsOf(scene);
    result.gridSize = chooseGridSize(scene, atlas.layout, scene.bake);
    CachePoints points;
    result.caches = placeCaches(scene, atlas, points);
    OwnerTables owners(scene, set);
    owners.stopWith(progress);
    if (store)
        owners.keep(*store, ownerKeys(set, meshes));
    owners.part(patchSidesStage(trace, set, owners, meshes, progress, store, rays));
    if (progress.cancelled())
        return cancelled();
    set.surfels.area = ownedAreas(scene, set, owners);
    const SeenPatches seenPatches =
        seenPatchesStage(trace, set, owners, atlas, result.caches, points,
                         raysForPatches(scene.bake), meshes, progress, store, rays);
    if (progress.cancelled())
        return cancelled();
    placeSeen(scene, seenPatches, set);
    addOwnCaches(scene, atlas.layout, seenPatches, set.surfels, result.caches, points);
    addGridCaches(result.gridSize, result.gridBounds, result.caches, points);
    clock.finish("caches");

    GatherHits hits;
    Result<TraceReport> traced =
        traceHits({trace, set, owners, result.caches, points, scene.bake.linker,
                   raysPerCache(scene.bake), meshes, gridReach(result.gridBounds, result.gridSize)},
                  progress, store, hits);
    if (!traced)
        return tl::make_unexpected(traced.error());
    result.notes = std::move(traced->notes);
    result.gridDepth = std::move(traced->gridDepth);
    clock.finish("trace");
    const std::vector<float> seen =
        seenByCaches(set.surfels, hits, points, result.caches, result.tree);
    rays += traced->rays;
    TrainingLight training; // read only by CutCriterion::Detail
    if (scene.bake.cut == CutCriterion::Detail) {
        const TracedTraining light = trainingStage(trace, set.surfels, *traced, progress, store);
        if (progress.cancelled())
            return cancelled();
        result.tree = splitByRoom(result.tree, set.surfels, findRooms(light));
        weighBySight(seen, result.tree);
        training = trainingLight(scene, set.surfels, result.tree, seen, light);
        rays += light.rays;
    } else {
        weighBySight(seen, result.tree);
    }
    clock.finish("training");
    std::vector<double> linked;
    if (!buildLinks(set.surfels, result.tree, hits, points, training,
                    {scene.bake.cut, scene.bake.links, int(scene.bake.bands), scene.bake.storage},
                    progress, result.caches, &linked))
        return cancelled();
    releaseFreedMemory();
    weighByLinks(seen, linked, result.tree);
    const std::uint32_t invalid = fillInvalid(result.caches, 1 / atlas.texelsPerMetre);
    shade(scene, set.surfels);
    limitGain(result.caches, int(scene.bake.bands), set.surfels);
    clock.finish("cut");

    result.lightmap = std::move(atlas.layout);
    result.surfels = std::move(set.surfels);
    result.counts = countOf(scene, result, rays);
    result.counts.invalidCaches = invalid;
    return result;
}

} // namespace limn
