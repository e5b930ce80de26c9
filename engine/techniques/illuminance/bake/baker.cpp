// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/baker.h"

#include "engine/core/hash.h"
#include "engine/core/parallel.h"
#include "engine/core/process_memory.h"
#include "engine/field/grid_depth.h"
#include "engine/field/grid_placement.h"
#include "engine/lightmap/atlas_stage.h"
#include "engine/lightmap/layout/layout_rules.h"
#include "engine/scene/dark_backs.h"
#include "engine/scene/mesh/input_hash.h"
#include "engine/scene/reach.h"
#include "engine/stages/stage_archive.h"
#include "engine/stages/stage_clock.h"
#include "engine/stages/stage_keys.h"
#include "engine/techniques/illuminance/bake/bake_prediction.h"
#include "engine/techniques/illuminance/bake/cut/rooms.h"
#include "engine/techniques/illuminance/bake/links/build_links.h"
#include "engine/techniques/illuminance/bake/links/surfel_gain.h"
#include "engine/techniques/illuminance/bake/rays/light_points.h"
#include "engine/techniques/illuminance/bake/rays/sky_hits.h"
#include "engine/techniques/illuminance/bake/rays/trace_record.h"
#include "engine/techniques/illuminance/bake/rays/trace_stage.h"
#include "engine/techniques/illuminance/bake/receivers/cache_points.h"
#include "engine/techniques/illuminance/bake/receivers/fill_invalid.h"
#include "engine/techniques/illuminance/bake/receivers/seen_patches.h"
#include "engine/techniques/illuminance/bake/senders/cluster_tree.h"
#include "engine/techniques/illuminance/bake/senders/surfel_normals.h"
#include "engine/techniques/illuminance/bake/senders/surfels.h"
#include "engine/techniques/illuminance/format/bake_defect.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace limn {

namespace {

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

/// A bake in progress: what every stage reads, and what stages have made so far. `owners` refers to
/// `scene` and `set`, so a BakeRun stays where it was made.
struct BakeRun {
    const TraceScene& trace;
    const Scene scene; ///< with the settings of the bake
    const Progress& progress;
    StageStore* store;                       ///< may be null
    const std::vector<std::uint64_t> meshes; ///< hashMeshes() of the scene
    Bake bake;
    StageClock clock{store};
    std::uint64_t rays = 0; ///< traced so far
    PlacedAtlas placed{};
    SurfelSet set{};
    std::optional<OwnerTables> owners{}; ///< from placeReceivers() on
    CachePoints points{};
};

tl::unexpected<Error> cancelled() {
    return fail("cancelled");
}

/// Hash of the surfaces that rays can hit, and of the surfels on them with their owners.
std::uint64_t hashSenders(const BakeRun& run) {
    return hashRecord(describeTrace(run.trace, run.set, *run.owners, {}, {{0}}, 1, run.meshes));
}

/// Finds the cells of patches that walls separate from their surfels.
PatchSides patchSidesStage(BakeRun& run) {
    const SurfelSet& set = run.set;
    const OwnerTables& owners = *run.owners;
    const std::uint64_t key = stageKey(Stage::PatchSides, hashSenders(run));
    return keptOrMade<PatchSides>(
        run.store, key, run.progress,
        [&](auto& a, auto& s) {
            a("changed", s.changed, rule::noneOr(set.surfels.size()));
            a.each("parts", s.parts, rule::noneOr(run.scene.instances.size()), [&](auto& parts) {
                const auto i = std::uint32_t(&parts - s.parts.data());
                a("parts", parts,
                  rule::holds("not whole cells",
                              [](const auto& p) { return p.size() % SurfelOwners::kParts == 0; }),
                  rule::below(set.instanceBegin[i + 1] - set.instanceBegin[i]));
            });
            a.each("owner", s.owner, rule::noneOr(run.scene.instances.size()), [&](auto& cells) {
                const auto i = std::uint32_t(&cells - s.owner.data());
                a("owner", cells,
                  rule::holds("of another length",
                              [&](const auto& all) {
                                  return all.empty() || all.size() == owners.cellsOf(i);
                              }),
                  rule::each("of another instance", [&, i](std::size_t, std::uint32_t owner) {
                      return owner & PatchSides::kSplit
                                 ? i < s.parts.size() &&
                                       (owner & ~PatchSides::kSplit) <
                                           s.parts[i].size() / SurfelOwners::kParts
                                 : owner < set.instanceBegin[i + 1] - set.instanceBegin[i];
                  }));
            });
        },
        [&] {
            PatchSides made = findPatchSides(run.trace, set, owners, run.progress);
            run.rays += made.rays;
            return made;
        });
}

/// Finds the surfels' places and surfel caches from what the surface's caches see.
SeenPatches seenPatchesStage(BakeRun& run) {
    const SurfelSet& set = run.set;
    const Scene& scene = run.scene;
    const Atlas& atlas = run.placed.atlas;
    const Caches& caches = run.bake.caches;
    const std::uint32_t looks = raysForPatches(scene.bake);
    const std::uint64_t rayStarts = hashRecord(describeTrace(
        run.trace, set, *run.owners, caches, run.points, std::max(looks, 1U), run.meshes));
    const std::uint32_t texels = atlas.layout.width * atlas.layout.height;
    const std::uint64_t key =
        stageKey(Stage::SeenPatches, hashLamps(scene, hashValue(texels, rayStarts)));
    return keptOrMade<SeenPatches>(
        run.store, key, run.progress,
        [&](auto& a, auto& s) {
            const std::uint64_t n = set.surfels.size();
            a("place", s.place, rule::count(n),
              rule::each("not on its mesh", [&](std::size_t i, const MeshPoint& p) {
                  return isPointOf(scene.meshOf(scene.instances[set.surfels.instance[i]]), p);
              }));
            a("cache", s.cache, rule::count(n), rule::belowOr(caches.lightmapCount, ~0U));
            a("cacheWeight", s.cacheWeight, rule::count(n), rule::within(0, 1 + 1e-4));
            a("surfelCaches", s.surfelCaches,
              rule::each("out of range", [&](std::size_t i, const SurfelCache& cache) {
                  return i < texels - caches.lightmapCount && cache.back <= 1 &&
                         cache.instance < scene.instances.size() &&
                         arePointsOf(scene.meshOf(scene.instances[cache.instance]), cache);
              }));
            a("surfelCache", s.surfelCache, rule::count(n),
              rule::belowOr(s.surfelCaches.size(), ~0U));
        },
        [&] {
            SeenPatches made = findSeenPatches(run.trace, set, *run.owners, atlas, caches,
                                               run.points, looks, run.progress);
            run.rays += made.rays;
            return made;
        });
}

/// Finds where direct light falls on the surfels, among the points that were hit.
void lightPointsStage(BakeRun& run, const GatherHits& hits, const TraceReport& traced) {
    Surfels& surfels = run.set.surfels;
    LightPoints found = keptOrMade<LightPoints>(
        run.store, stageKey(Stage::LightPoints, traced.key), run.progress,
        [&surfels](auto& a, auto& l) {
            a("position", l.position, rule::count(surfels.size() * kLightPoints), rule::inReach());
            a("normal", l.normal, rule::count(l.position.size()), rule::unit());
        },
        [&] {
            const RayGatherer gatherer(run.trace, run.set, run.bake.caches, run.points, hits.rays,
                                       *run.owners);
            LightPoints made = findLightPoints(run.trace, surfels, gatherer, run.bake.caches,
                                               run.points, hits, run.progress);
            run.rays += made.rays;
            return made;
        });
    surfels.lightPoints = std::move(found.position);
    surfels.lightNormals = std::move(found.normal);
}

/// Looks for the sky through windows.
void skyHitsStage(BakeRun& run, GatherHits& hits, const TraceReport& traced) {
    const std::size_t surfels = run.set.surfels.size();
    const Caches& caches = run.bake.caches;
    const SkyInput input{
        run.trace,        surfels, caches,
        run.points,       hits,    {run.placed.atlas.layout.width, run.placed.atlas.layout.height},
        run.bake.gridSize};
    // Which caches are neighbours depends on where their texels lie.
    const std::uint64_t inputs =
        hashValue(input.grid, hashValue(input.lightmap, hashVector(caches.texel, traced.key)));
    const auto areHits = [&](const SkyHits& s) {
        for (std::size_t c = 0; c < caches.size(); ++c)
            for (std::uint32_t k = s.begin[c]; k < s.begin[c + 1]; ++k) {
                const SkyHit& sky = s.all[k];
                if (sky.sender < surfels || sky.sender >= surfels + kSkyCells ||
                    sky.point < run.points.begin[c] || sky.point >= run.points.begin[c + 1] ||
                    !(sky.transport >= 0 && sky.transport <= 4))
                    return false;
            }
        return true;
    };
    SkyHits found = keptOrMade<SkyHits>(
        run.store, stageKey(Stage::SkyHits, inputs), run.progress,
        [&](auto& a, auto& s) {
            a("begin", s.begin, rule::offsets(caches.size(), s.all.size()));
            a("all", s.all, rule::holds("out of range", [&](const auto&) { return areHits(s); }));
        },
        [&] {
            SkyHits made = findSkyHits(input, run.progress);
            run.rays += made.rays;
            return made;
        });
    takeSkyHits(std::move(found), surfels, hits);
}

/// Traces the training lights' shadow rays, again only near what moved.
TracedTraining trainingStage(const BakeRun& run, TraceReport& traced) {
    const Surfels& surfels = run.set.surfels;
    const auto fields = [&surfels](auto& a, auto& t) {
        a("irradiance", t.irradiance, rule::count(surfels.size() * TracedTraining::kCount),
          rule::within(0, 1e15)); // its square stays within float
        a("lamps", t.lamps, rule::count(TracedTraining::kLamps), rule::inReach());
        a("position", t.position, rule::count(surfels.size()), rule::inReach());
    };
    const auto key = [](std::uint64_t trace) { return stageKey(Stage::Training, trace); };
    return keptOrMade<TracedTraining>(run.store, key(traced.key), run.progress, fields, [&] {
        std::optional<EarlierTraining> earlier;
        if (traced.moved)
            if (auto light = kept<TracedTraining>(*run.store, key(traced.moved->key), fields))
                earlier = {std::move(*light), std::move(*traced.moved)};
        return traceTraining(run.trace, surfels, earlier ? &*earlier : nullptr, run.progress);
    });
}

BakeCounts countOf(const Scene& scene, const Bake& bake, std::uint64_t rays) {
    BakeCounts counts = bake.counts; // the invalid caches are known already
    for (const Instance& i : scene.instances)
        counts.triangles += scene.meshOf(i).triangleCount();
    counts.surfels = bake.surfels.size();
    counts.clusters = bake.tree.left.size();
    counts.caches = bake.caches.size();
    counts.links = bake.caches.linkCount();
    counts.rays = rays;
    return counts;
}

/// Fails on settings out of range, on scenes too large, and where the bake needs too much memory.
Result<void> checkBake(const Scene& scene, bool stored, const MemoryBudget& memory) {
    if (const std::string defect = settingsDefect(scene.bake); !defect.empty())
        return fail(defect);
    if (const std::string defect = reachDefect(scene); !defect.empty())
        return fail(defect);
    const BakePrediction predicted = predictBake(scene, stored);
    if (const Result<void> fits =
            memory.allow(fmt::format("a bake of {} caches with {} rays and {} links each",
                                     predicted.caches, scene.bake.rays, scene.bake.links),
                         predicted.working);
        !fits)
        return fail("bake settings: " + fits.error().message + ": lower rays, lightmap or grid");
    return {};
}

/// Lays the charts out, places the surfels and joins them to a tree.
Result<void> placeSenders(BakeRun& run) {
    std::optional<PlacedAtlas> placed =
        atlasStage(run.trace, run.scene, run.meshes, run.progress, run.store, run.rays);
    if (!placed)
        return cancelled();
    run.placed = std::move(*placed);
    run.clock.finish("charts");

    run.progress.at("surfels", 0);
    run.set = placeSurfels(run.scene, run.scene.bake.surfels, run.placed.surfels, run.progress,
                           run.store);
    if (run.progress.cancelled())
        return cancelled();
    if (run.set.surfels.size() == 0)
        return fail("nothing to bake: the scene has no static triangles");
    run.clock.finish("surfels");

    run.progress.at("clusters", 0);
    run.bake.tree = buildClusterTree(run.scene, run.set, run.progress, run.store);
    if (run.progress.cancelled())
        return cancelled();
    run.clock.finish("clusters");
    return {};
}

/// Places the caches, and says which surfel owns each place of the surfaces that they will see.
Result<void> placeReceivers(BakeRun& run) {
    const Scene& scene = run.scene;
    const LightmapLayout& layout = run.placed.atlas.layout;
    Bake& bake = run.bake;
    run.progress.at("caches", 0);
    bake.gridBounds = gridBoundsOf(scene);
    bake.gridSize = chooseGridSize(scene, layout, scene.bake);
    bake.caches = placeCaches(scene, run.placed.atlas, run.points);
    OwnerTables& owners = run.owners.emplace(scene, run.set);
    owners.stopWith(run.progress);
    if (run.store)
        owners.keep(*run.store, ownerKeys(run.set, run.meshes));
    owners.part(patchSidesStage(run));
    if (run.progress.cancelled())
        return cancelled();
    run.set.surfels.area = ownedAreas(scene, run.set, owners);
    const SeenPatches seen = seenPatchesStage(run);
    if (run.progress.cancelled())
        return cancelled();
    placeSeen(scene, seen, run.set);
    addSurfelCaches(scene, layout, seen, run.set.surfels, bake.caches, run.points);
    addGridCaches(bake.gridSize, bake.gridBounds, bake.caches, run.points);
    run.clock.finish("caches");
    return {};
}

Result<TraceReport> traceCaches(BakeRun& run, GatherHits& hits) {
    Bake& bake = run.bake;
    Result<TraceReport> traced = traceHits(
        {run.trace, run.set, *run.owners, bake.caches, run.points, run.scene.bake.linker,
         raysPerCache(run.scene.bake), run.meshes, gridReach(bake.gridBounds, bake.gridSize)},
        run.progress, run.store, hits);
    if (!traced)
        return traced;
    bake.notes = std::move(traced->notes);
    bake.gridDepth = std::move(traced->gridDepth);
    run.rays += traced->rays;
    lightPointsStage(run, hits, *traced);
    if (run.scene.bake.linker == Linker::Gather && !run.progress.cancelled())
        skyHitsStage(run, hits, *traced);
    if (run.progress.cancelled())
        return cancelled();
    run.clock.finish("trace");
    return traced;
}

/// Chooses the links of each cache among the clusters that its rays met.
Result<void> linkCaches(BakeRun& run, const GatherHits& hits, TraceReport& traced) {
    const BakeSettings& settings = run.scene.bake;
    Surfels& surfels = run.set.surfels;
    Bake& bake = run.bake;
    const std::vector<float> importance =
        leafImportance(surfels, hits, run.points, bake.caches, bake.tree);
    TrainingLight training; // read only by CutCriterion::Detail
    if (settings.cut == CutCriterion::Detail) {
        const TracedTraining light = trainingStage(run, traced);
        if (run.progress.cancelled())
            return cancelled();
        bake.tree = splitByRoom(bake.tree, surfels, findRooms(light));
        weighByImportance(importance, bake.tree);
        training = trainingLight(run.scene, surfels, bake.tree, importance, light);
        run.rays += light.rays;
    } else {
        weighByImportance(importance, bake.tree);
    }
    run.clock.finish("training");
    std::vector<double> linked;
    if (!buildLinks(surfels, bake.tree, hits, run.points, training,
                    {settings.cut, settings.links, int(settings.bands), settings.storage},
                    run.progress, bake.caches, &linked))
        return cancelled();
    releaseFreedMemory();
    weighByLinks(importance, linked, bake.tree);
    bake.counts.invalidCaches = fillInvalid(bake.caches, 1 / run.placed.atlas.texelsPerMetre);
    shade(run.scene, surfels);
    limitGain(bake.caches, int(settings.bands), surfels);
    run.clock.finish("cut");
    return {};
}

} // namespace

Result<Bake> bake(const TraceScene& whole, const Progress& progress, StageStore* store,
                  const BakeSettings* settings, const MemoryBudget& memory) {
    Scene scene = whole.scene();
    if (settings)
        scene.bake = *settings;
    if (const Result<void> possible = checkBake(scene, store != nullptr, memory); !possible)
        return tl::make_unexpected(possible.error());
    const std::uint64_t sceneHash = bakeInputHash(scene);
    leaveOutDarkBacks(scene);
    const TraceScene trace(scene, whole);
    BakeRun run{.trace = trace,
                .scene = scene,
                .progress = progress,
                .store = store,
                .meshes = hashMeshes(scene),
                .bake = {.settings = scene.bake, .sceneHash = sceneHash}};
    if (const Result<void> placed = placeSenders(run); !placed)
        return tl::make_unexpected(placed.error());
    if (const Result<void> placed = placeReceivers(run); !placed)
        return tl::make_unexpected(placed.error());
    GatherHits hits;
    Result<TraceReport> traced = traceCaches(run, hits);
    if (!traced)
        return tl::make_unexpected(traced.error());
    if (const Result<void> linked = linkCaches(run, hits, *traced); !linked)
        return tl::make_unexpected(linked.error());
    Bake& result = run.bake;
    result.baker = kBakerVersion;
    result.lightmap = std::move(run.placed.atlas.layout);
    result.surfels = std::move(run.set.surfels);
    result.counts = countOf(scene, result, run.rays);
    result.seconds = std::move(run.clock.seconds);
    result.keptStages = std::move(run.clock.keptStages);
    // Stages that were changed in the store may pass their own checks and still not fit together.
    if (store && !bakeDefect(result, &scene).empty())
        return bake(whole, progress, nullptr, settings, memory);
    return std::move(result);
}

} // namespace limn
