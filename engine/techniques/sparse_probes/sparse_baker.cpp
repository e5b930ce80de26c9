// SPDX-License-Identifier: MIT
#include "engine/techniques/sparse_probes/sparse_bake.h"

#include "engine/core/hash.h"
#include "engine/field/grid_placement.h"
#include "engine/lightmap/atlas_stage.h"
#include "engine/lightmap/layout/layout_rules.h"
#include "engine/scene/mesh/input_hash.h"
#include "engine/scene/reach.h"
#include "engine/stages/stage_archive.h"
#include "engine/stages/stage_clock.h"
#include "engine/stages/stage_keys.h"
#include "engine/techniques/sparse_probes/compressed_fields.h"
#include "engine/techniques/sparse_probes/probe_places.h"
#include "engine/techniques/sparse_probes/relight_rays.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace limn {

namespace {

/// Receivers whose transport is kept together.
constexpr std::size_t kBlock = 512;

tl::unexpected<Error> cancelled() {
    return fail("cancelled");
}

std::uint64_t hashAll(std::uint64_t h, std::initializer_list<std::uint32_t> values) {
    for (const std::uint32_t v : values)
        h = hashValue(v, h);
    return h;
}

/// Hash of what the receivers depend on.
std::uint64_t hashReceivers(const Scene& scene) {
    return hashStatic(
        scene, hashValue(scene.bake.texelsPerMetre, hashValue(scene.bake.lightmapCaches, 71)));
}

/// A precomputation in progress.
struct SparseRun {
    const TraceScene& trace;
    const Scene scene; ///< with the settings of the bake
    const Progress& progress;
    StageStore* store; ///< may be null
    SparseBake bake;
    StageClock clock{store};
    Atlas atlas{};
    std::uint64_t probesKey = 0;    ///< hash of what probes' places depend on
    std::uint64_t transportKey = 0; ///< hash of what the transport depends on
};

Result<void> check(const Scene& scene, bool stored, const MemoryBudget& memory) {
    if (const std::string defect = settingsDefect(scene.bake); !defect.empty())
        return fail(defect);
    if (const std::string defect = reachDefect(scene); !defect.empty())
        return fail(defect);
    const Prediction predicted = predictSparse(scene, stored);
    if (const Result<void> fits = memory.allow(
            fmt::format("transport to {} texels", predicted.caches), predicted.working);
        !fits)
        return fail("bake settings: " + fits.error().message + ": lower lightmap or bands");
    return {};
}

Result<void> chartsStage(SparseRun& run) {
    SparseBake& bake = run.bake;
    std::optional<PlacedAtlas> placed =
        atlasStage(run.trace, run.scene, hashMeshes(run.scene), run.progress, run.store, bake.rays);
    if (!placed)
        return cancelled();
    run.atlas = std::move(placed->atlas);
    if (run.atlas.texels.empty())
        return fail("nothing to bake: the scene has no static triangles");
    bake.receivers = placeReceivers(run.scene, run.atlas);
    bake.gridBounds = gridBoundsOf(run.scene);
    bake.gridSize = chooseGridSize(run.scene, run.atlas.layout, run.scene.bake);
    run.clock.finish("charts");
    return {};
}

Result<void> probesStage(SparseRun& run) {
    SparseBake& bake = run.bake;
    const SparseSettings& s = bake.sparse;
    run.probesKey = hashAll(hashReceivers(run.scene), {s.probes, s.cells});
    bake.probes = keptOrMade<std::vector<glm::vec3>>(
        run.store, stageKey(Stage::SparseProbes, run.probesKey), run.progress,
        [](auto& a, auto& probes) { a("probes", probes, rule::inReach()); },
        [&] {
            const ReceiverPoints points = pointsOf(run.scene, bake.receivers);
            const OpenAir air =
                findOpenAir(run.trace, points.position, points.normal, s.cells, run.progress);
            return run.progress.cancelled() ? std::vector<glm::vec3>() : placeProbes(air, s.probes);
        });
    if (run.progress.cancelled())
        return cancelled();
    run.clock.finish("probes");
    return {};
}

Result<void> relightRaysStage(SparseRun& run) {
    SparseBake& bake = run.bake;
    const std::uint64_t rays = std::uint64_t(bake.sparse.rays) * bake.probes.size();
    bake.hits = keptOrMade<std::vector<std::uint32_t>>(
        run.store, stageKey(Stage::RelightRays, hashAll(run.probesKey, {bake.sparse.rays})),
        run.progress, [rays](auto& a, auto& hits) { a("hits", hits, rule::count(rays)); },
        [&] {
            bake.rays += rays;
            return traceRelightRays(run.trace, ReceiverAt(run.atlas.layout, bake.receivers),
                                    bake.probes, relightDirections(bake.sparse.rays), run.progress);
        });
    if (run.progress.cancelled())
        return cancelled();
    run.clock.finish("relight rays");
    return {};
}

Result<void> transportStage(SparseRun& run) {
    SparseBake& bake = run.bake;
    const SparseSettings& s = bake.sparse;
    const std::uint32_t rays = run.scene.bake.rays;
    const std::uint64_t inputs = run.transportKey =
        hashAll(run.probesKey, {s.bands, s.unchecked, rays});
    const std::span<const AtlasTexel> texels = run.atlas.texels;
    const TransportOptions options{int(s.bands), rays, s.unchecked > 0};
    for (std::size_t begin = 0; begin < texels.size(); begin += kBlock) {
        run.progress.at("transport", float(begin) / float(texels.size()));
        const std::size_t count = std::min(kBlock, texels.size() - begin);
        const Transport block = keptOrMade<Transport>(
            run.store, stageKey(Stage::SparseTransport, hashValue(std::uint64_t(begin), inputs)),
            run.progress,
            [&](auto& a, auto& t) {
                a("probe", t.probe, rule::count(count * kProbesPerReceiver));
                a("coefficients", t.coefficients,
                  rule::count(count * kProbesPerReceiver * bake.coefficients()));
                a("unseen", t.unseen, rule::count(count), rule::within(0, 1));
            },
            [&] {
                bake.rays += std::uint64_t(count) * rays * (1 + kProbesPerReceiver);
                return traceTransport(run.trace, texels.subspan(begin, count), bake.probes, options,
                                      {.cancel = run.progress.cancel});
            });
        if (run.progress.cancelled())
            return cancelled();
        const auto append = [](auto& all, const auto& some) {
            all.insert(all.end(), some.begin(), some.end());
        };
        append(bake.transport.probe, block.probe);
        append(bake.transport.coefficients, block.coefficients);
        append(bake.transport.unseen, block.unseen);
    }
    run.clock.finish("transport");
    return {};
}

Result<void> compressionStage(SparseRun& run) {
    SparseBake& bake = run.bake;
    if (bake.sparse.compression == 0)
        return {};
    run.progress.at("compression", 0);
    bake.compressed = keptOrMade<CompressedTransport>(
        run.store,
        stageKey(Stage::SparseCompression, hashAll(run.transportKey, {bake.sparse.compression})),
        run.progress,
        [&](auto& a, auto& c) {
            compressedFields(a, c, bake.receivers.size(), bake.probes.size(), bake.coefficients());
        },
        [&] {
            return compressTransport(bake.transport, bake.coefficients(),
                                     pointsOf(run.scene, bake.receivers),
                                     float(bake.sparse.compression) / 100, run.progress);
        });
    if (run.progress.cancelled())
        return cancelled();
    const Transport& plain = bake.transport;
    if (bake.compressed.bytes() >= 2 * (plain.probe.size() + plain.coefficients.size())) {
        bake.compressed = {}; // larger than what it would replace
    } else {
        bake.transport.probe = {};
        bake.transport.coefficients = {};
    }
    run.clock.finish("compression");
    return {};
}

} // namespace

std::uint64_t SparseBake::hash() const {
    std::uint64_t h = hashLayout(lightmap, hashValue(sceneHash, 1));
    h = hashVector(receivers.texel, hashVector(receivers.instance, h));
    h = hashVector(receivers.triangle, hashVector(receivers.barycentric, h));
    h = hashVector(receivers.back, hashVector(receivers.width, h));
    h = hashVector(probes, hashVector(hits, h));
    h = hashVector(transport.probe, hashVector(transport.coefficients, h));
    h = hashVector(compressed.receiver, hashVector(compressed.probe, h));
    h = hashVector(compressed.rank, hashVector(compressed.left, h));
    h = hashVector(compressed.right, hashVector(compressed.receiverBegin, h));
    return hashVector(transport.unseen, h);
}

std::uint64_t sparseInputHash(const Scene& scene) {
    const SparseSettings s = sparseSettingsOf(scene.technique);
    const glm::uvec3 grid = scene.bake.grid;
    return hashAll(hashReceivers(scene), {s.probes, s.cells, s.rays, s.bands, s.unchecked,
                                          s.compression, scene.bake.rays, grid.x, grid.y, grid.z});
}

std::vector<LightingCounter> sparseBytes(std::size_t receivers, const SparseSettings& s,
                                         std::size_t probes) {
    constexpr double kReceiver = 3 * 4 + 8 + 1 + 4;
    const double coefficients = double(s.bands) * s.bands, r = double(receivers),
                 p = double(probes);
    const auto bytes = [](const char* id, const char* label, const char* tooltip, double value) {
        return LightingCounter{id, label, tooltip, value, CounterUnit::Bytes};
    };
    return {bytes("receivers", "Receivers", "Places of the lit texels", kReceiver * r),
            bytes("relight_rays", "Relight rays", "Texels that probes see, and their harmonics",
                  4 * double(s.rays) * (p + coefficients)),
            bytes("transport", "Transport", "From probes to texels",
                  kProbesPerReceiver * 2 * (1 + coefficients) * r + 4 * r)};
}

double transportBytes(const SparseBake& bake) {
    const Transport& t = bake.transport;
    return 2 * double(t.probe.size() + t.coefficients.size()) + 4 * double(t.unseen.size()) +
           double(bake.compressed.bytes());
}

Prediction predictSparse(const Scene& scene, bool stored) {
    const double texels = wantedTexels(scene);
    const SparseSettings s = sparseSettingsOf(scene.technique);
    Prediction p{.caches = std::uint64_t(texels),
                 .bytes = sparseBytes(std::size_t(texels), s, s.probes)};
    constexpr double kAtlas = 400; // bytes per texel while charts are placed
    const double bytes = totalOf(p.bytes);
    p.file = std::uint64_t(0.7 * bytes);
    // The bake, its bytes and what they are packed into; finished stages are copied.
    p.working = std::uint64_t((stored ? 4 : 3) * bytes + kAtlas * texels);
    return p;
}

Result<SparseBake> bakeSparse(const TraceScene& trace, const PrepareOptions& options,
                              const Progress& progress) {
    Scene scene = trace.scene();
    if (options.settings)
        scene.bake = *options.settings;
    if (options.choice)
        scene.technique = *options.choice;
    if (const Result<void> possible = check(scene, options.store != nullptr, options.memory);
        !possible)
        return tl::make_unexpected(possible.error());
    SparseRun run{.trace = trace,
                  .scene = scene,
                  .progress = progress,
                  .store = options.store,
                  .bake = {.settings = scene.bake,
                           .sparse = sparseSettingsOf(scene.technique),
                           .sceneHash = sparseInputHash(scene)}};
    for (const auto stage :
         {chartsStage, probesStage, relightRaysStage, transportStage, compressionStage})
        if (const Result<void> done = stage(run); !done)
            return tl::make_unexpected(done.error());
    SparseBake& bake = run.bake;
    bake.lightmap = std::move(run.atlas.layout);
    for (const Instance& i : scene.instances)
        bake.triangles += scene.meshOf(i).triangleCount();
    bake.seconds = std::move(run.clock.seconds);
    bake.keptStages = std::move(run.clock.keptStages);
    return std::move(bake);
}

} // namespace limn
