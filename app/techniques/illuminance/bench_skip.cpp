// SPDX-License-Identifier: MIT
#include "app/bench/live_light.h"
#include "app/techniques/illuminance/bench_bakes.h"
#include "app/techniques/illuminance/illuminance_program.h"
#include "app/techniques/illuminance/lacking_scenes.h"

#include "engine/lighting/fastest_update.h"
#include "engine/picture/field_render.h"
#include "engine/techniques/illuminance/relight/seen_caches.h"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace limn {

namespace {

struct SkipBench {
    BenchBakes bakes;
    CameraOptions camera;
    std::string output;
    int runs = 9;
    bool json = false;
};

constexpr std::uint32_t kBounces = 2; ///< per update, as the editor does

/// One way to keep a scene lit, and what its updates took.
struct Side {
    const Scene& scene;
    LitBands lit;
    bool unreadGrid, fromNothing;
    const CacheFlags* seen = nullptr; ///< null: all
    std::unique_ptr<Relighter> relighter = nullptr;
    std::vector<RelightStats> runs = {};
};

void startSide(Side& side, const std::shared_ptr<const Bake>& bake) {
    side.relighter = std::make_unique<Relighter>(bake, side.lit);
    side.relighter->lightUnreadGrid(side.unreadGrid);
}

/// Updates until the light converges. Returns the report of the first update with the time and the
/// links of all of them.
RelightStats lightToRest(Relighter& relighter, const Scene& scene, const TraceScene& trace,
                         const CacheFlags* seen) {
    constexpr int kMaxCalls = 256;
    RelightStats all = relighter.relight(scene, trace, kBounces, {}, seen);
    for (int call = 1; !all.converged && call < kMaxCalls; ++call) {
        const RelightStats next = relighter.relight(scene, trace, kBounces, {}, seen);
        all.totalMs += next.totalMs;
        all.links += next.links;
        all.converged = next.converged;
        all.bytes = next.bytes;
    }
    return all;
}

/// Run k; run 0 is not measured.
void updateSide(Side& side, const BenchBake& baked, int k) {
    if (side.relighter == nullptr || side.fromNothing)
        startSide(side, baked.bake);
    const Scene lit = withMovedLights(side.scene, k);
    const TraceScene trace(lit, baked.trace);
    const RelightStats stats =
        side.relighter->relight(lit, trace, kBounces, {}, k == 0 ? nullptr : side.seen);
    if (k > 0)
        side.runs.push_back(stats);
}

void updateStill(Side& side, const BenchBake& baked, int k) {
    if (side.relighter == nullptr || side.fromNothing)
        startSide(side, baked.bake);
    const TraceScene trace(side.scene, baked.trace);
    const RelightStats stats = lightToRest(*side.relighter, side.scene, trace, side.seen);
    if (k > 0)
        side.runs.push_back(stats);
}

/// A camera at the same place that sees a tenth of the caches, or as few as it can.
Camera cameraOfTenth(Camera camera, float aspect, const CacheFootprints& footprints) {
    const auto share = [&] {
        const CacheFlags seen = seenCaches(footprints, camera, aspect);
        return double(std::ranges::count(seen, 1)) / double(std::max<std::size_t>(seen.size(), 1));
    };
    for (int step = 0; step < 64 && share() > 0.1; ++step)
        camera.fovY *= 0.95f;
    return camera;
}

double medianMs(const std::vector<RelightStats>& runs) {
    std::vector<double> ms;
    for (const RelightStats& run : runs)
        ms.push_back(run.totalMs);
    return spreadOf(ms).median;
}

/// Bytes of links.
double linkBytes(const Bake& bake, const RelightStats& run, std::uint64_t links) {
    const std::uint64_t halfs = std::uint64_t(run.bandsLit) * run.bandsLit;
    const std::uint64_t each = bake.settings.storage == LinkStorage::Rtp
                                   ? sizeof(Link)
                                   : sizeof(std::uint32_t) + halfs * sizeof(std::uint16_t);
    return double(links * each);
}

double savedPercent(double whole, double skipping) {
    return whole > 0 ? 100 * (1 - skipping / whole) : 0;
}

using Sides = std::array<Side, 2>; ///< one that skips, one that does all the work

/// How far pictures of both sides' light lie apart, after the last run and at rest. `shown`: the
/// scene of that run.
Json differencesOf(const BenchBake& baked, const LackingScene& lacking, const Scene& shown,
                   const FieldRenderOptions& view, Sides& sides) {
    const TraceScene trace(shown, baked.trace);
    const auto draw = [&](const Side& side) {
        return renderField(trace, side.relighter->field(), baked.bake->lightmap, view);
    };
    const ImageF picture = draw(sides[0]), whole = draw(sides[1]);
    Json differences = {{"mean", meanOf(whole)},
                        {"difference_max", largestDifference(picture, whole)},
                        {"difference_rms", distanceOf(picture, whole)},
                        {"same_bits", picture.rgb == whole.rgb},
                        {"difference_max_at_rest", nullptr}};
    if (lacking.faint) // it may end the bounces of one of the two earlier
        return differences;
    for (Side& side : sides) {
        startSide(side, baked.bake);
        lightToRest(*side.relighter, shown, trace, side.seen);
    }
    differences["difference_max_at_rest"] = largestDifference(draw(sides[0]), draw(sides[1]));
    return differences;
}

/// What the last updates read and kept, and the median of their times.
Json savingsOf(const BenchBake& baked, const LackingScene& lacking, const Sides& sides) {
    const RelightStats &skipping = sides[0].runs.back(), &whole = sides[1].runs.back();
    const double ms = medianMs(sides[0].runs), wholeMs = medianMs(sides[1].runs),
                 wholeLinks = linkBytes(*baked.bake, whole, whole.links);
    const std::uint64_t count = lacking.count(skipping, whole);
    // A link must be read to find that its sender is dark, so that no memory access is saved then.
    const double links =
        linkBytes(*baked.bake, skipping, skipping.links - (lacking.unreadLinks ? count : 0));
    return {{"counter", lacking.counter},
            {"count", count},
            {"whole_median_ms", wholeMs},
            {"median_ms", ms},
            {"saved_ms", wholeMs - ms},
            {"saved_ms_percent", savedPercent(wholeMs, ms)},
            {"whole_bytes", whole.bytes},
            {"bytes", skipping.bytes},
            {"saved_bytes", double(whole.bytes) - double(skipping.bytes)},
            {"whole_link_bytes", wholeLinks},
            {"link_bytes", links},
            {"saved_link_bytes", wholeLinks - links}};
}

Json measureLacking(const SkipBench& o, const BenchBake& baked, const LackingScene& lacking,
                    const Camera& camera) {
    FieldRenderOptions view;
    view.camera = camera;
    view.width = o.camera.width;
    view.height = o.camera.height;
    view.samplesPerPixel = 1;
    CacheFlags seen;
    if (lacking.looksAtTenth) {
        const float aspect = float(view.width) / float(view.height);
        const CacheFootprints footprints = cacheFootprints(baked.scene, *baked.bake);
        view.camera = cameraOfTenth(camera, aspect, footprints);
        seen = seenCaches(footprints, view.camera, aspect);
    }
    Sides sides = {
        Side{lacking.scene, LitBands::Needed, false, false, lacking.looksAtTenth ? &seen : nullptr},
        Side{lacking.whole, lacking.allBands ? LitBands::All : LitBands::Needed, lacking.unreadGrid,
             lacking.still}};
    for (int k = 0; k <= o.runs; ++k)
        for (Side& side : sides)
            lacking.still ? updateStill(side, baked, k) : updateSide(side, baked, k);
    const Scene shown = lacking.still ? lacking.scene : withMovedLights(lacking.scene, o.runs);
    Json row = {{"name", baked.name}, {"lacks", lacking.lacks}};
    row.update(settingsOf(baked));
    row.update(savingsOf(baked, lacking, sides));
    row.update(differencesOf(baked, lacking, shown, view, sides));
    return row;
}

constexpr Column kSkipColumns[] = {{"scene", -12, "name"},
                                   {"lacks", -24, "lacks"},
                                   {"links", -5, "storage"},
                                   {"skipped", -24, "counter"},
                                   {"", 10, "count"},
                                   {"all [ms]", 8, "whole_median_ms"},
                                   {"[ms]", 7, "median_ms"},
                                   {"saved [%]", 9, "saved_ms_percent", 1},
                                   {"all kept [MiB]", 14, "whole_bytes", 2, kMiB},
                                   {"[MiB]", 7, "bytes", 2, kMiB},
                                   {"all read [MiB]", 14, "whole_link_bytes", 2, kMiB},
                                   {"[MiB]", 7, "link_bytes", 2, kMiB},
                                   {"same bits", 9, "same_bits"},
                                   {"max", 9, "difference_max", 6},
                                   {"rms", 9, "difference_rms", 6},
                                   {"at rest", 9, "difference_max_at_rest", 6}};

Exit runSkipBench(const SkipBench& o) {
    Json rows = Json::array();
    const Result<void> measured = forEachBake(o.bakes, [&](const BenchBake& baked) -> Result<void> {
        const Result<Camera> camera = chooseCamera(baked.scene, o.camera);
        if (!camera)
            return tl::make_unexpected(camera.error());
        for (const LackingScene& lacking : lackingScenes(baked.scene, *baked.bake)) {
            rows.push_back(measureLacking(o, baked, lacking, *camera));
            if (o.json)
                continue;
            if (rows.size() == 1)
                printTitles(kSkipColumns);
            printRow(kSkipColumns, rows.back());
        }
        return {};
    });
    if (!measured)
        return failed(measured.error().message);
    return writeRows(rows, o.output, "skip", o.json);
}

} // namespace

void addSkipBench(Command& bench) {
    const auto o = std::make_shared<SkipBench>();
    o->bakes.links = {64};
    o->bakes.bands = {5}; // more than diffuse surfaces need
    o->bakes.storages = {"rtp"};
    o->bakes.grid = {12, 12, 12}; // else scenes whose grid nothing reads have none
    o->camera.width = 160;
    o->camera.height = 90;
    Command command = bench.addCommand(
        "skip", "Time and memory that updates save where a scene lacks something, and whether "
                "pictures stay the same");
    addBenchBakes(command, o->bakes);
    addCameraOptions(command, o->camera);
    command.option("-o,--output", o->output, "Folder for skip.csv and skip.json").required();
    command.option("--runs", o->runs, "Number of updates; their median is printed")
        .within(1, 100000);
    command.flag("--json", o->json, "Print one JSON object to stdout");
    command.onRun([o] { return runSkipBench(*o); });
}

} // namespace limn
