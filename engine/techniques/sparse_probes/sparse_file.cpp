// SPDX-License-Identifier: MIT
#include "engine/lightmap/layout/layout_rules.h"
#include "engine/scene/bake_settings_archive.h"
#include "engine/stages/chunk_file.h"
#include "engine/stages/stage_archive.h"
#include "engine/techniques/sparse_probes/compressed_fields.h"
#include "engine/techniques/sparse_probes/relight_rays.h"
#include "engine/techniques/sparse_probes/sparse_bake.h"

#include <algorithm>

namespace limn {

namespace {

constexpr ChunkFormat kFormat = {kSparseMark, 2};

template <class A, class B>
void settingsFields(A& a, B& b) {
    bakeSettingsFields(a, b.settings);
    visitSparseSettings(b.sparse, [&](const TechniqueSetting& setting, auto& value) {
        a(setting.setting.key, value, rule::within(setting.range.lower, setting.range.upper));
    });
    a("sceneHash", b.sceneHash, rule::any);
    a("gridSize", b.gridSize, rule::within(0, 256));
    a("gridBounds.lower", b.gridBounds.lower, rule::inReach());
    a("gridBounds.upper", b.gridBounds.upper, rule::inReach());
    a("triangles", b.triangles, rule::any), a("rays", b.rays, rule::any); // only shown
    secondsFields(a, b.seconds);
}

template <class A, class B>
void receiverFields(A& a, B& b, const Scene* scene) {
    auto& r = b.receivers;
    const std::uint64_t n = r.texel.size();
    a("texel", r.texel, rule::below(std::uint64_t(b.lightmap.width) * b.lightmap.height),
      rule::holds("not in ascending order", [](const auto& texel) {
          return std::ranges::adjacent_find(texel, std::greater_equal{}) == texel.end();
      }));
    a("instance", r.instance, rule::count(n), rule::below(b.lightmap.instances.size()));
    a("triangle", r.triangle, rule::count(n),
      rule::each("out of range", [&r, scene](std::size_t i, std::uint32_t t) {
          return !scene || t < scene->meshOf(scene->instances[r.instance[i]]).triangleCount();
      }));
    a("barycentric", r.barycentric, rule::count(n), rule::within(-1e-4, 1 + 1e-4));
    a("back", r.back, rule::count(n), rule::below(2));
    a("width", r.width, rule::count(n), rule::within(0, 2 * double(kMaxCoordinate)));
}

template <class A, class B>
void probeFields(A& a, B& b) {
    a("probes", b.probes, rule::inReach(),
      rule::holds("too many", [](const auto& probes) { return probes.size() < kNoProbe; }));
    a("hits", b.hits, rule::count(std::uint64_t(b.sparse.rays) * b.probes.size()),
      rule::each("out of range", [&b](std::size_t, std::uint32_t hit) {
          return hit < b.receivers.size() || hit >= kDarkHit;
      }));
}

template <class A, class B>
void transportFields(A& a, B& b) {
    // pi times the largest harmonic of eight bands is below 4; weights of a probe are at most 1.
    constexpr std::uint16_t kLargest = 0x4400; // half of 4
    const std::uint64_t n = b.compressed.empty() ? b.receivers.size() * kProbesPerReceiver : 0;
    auto& t = b.transport;
    a("probe", t.probe, rule::count(n), rule::belowOr(b.probes.size(), kNoProbe));
    a("coefficients", t.coefficients, rule::count(n * b.coefficients()),
      rule::each("more light than there is",
                 [](std::size_t, std::uint16_t half) { return (half & 0x7fff) <= kLargest; }));
    a("unseen", t.unseen, rule::count(b.receivers.size()), rule::within(0, 1));
}

/// Calls visit(name, fields) for every chunk; `fields(archive, bake)` lists its fields. `scene`:
/// the one that it was made from; null where it is not known.
template <class Visit>
void forChunks(const Scene* scene, const Visit& visit) {
    visit("SETTINGS", [](auto& a, auto& b) { settingsFields(a, b); });
    visit("LIGHTMAP",
          [scene](auto& a, auto& b) { layoutFields(a, b.lightmap, b.receivers.size(), scene); });
    visit("RECEIVER", [scene](auto& a, auto& b) { receiverFields(a, b, scene); });
    visit("PROBES  ", [](auto& a, auto& b) { probeFields(a, b); });
    visit("COMPRESS", [](auto& a, auto& b) {
        compressedFields(a, b.compressed, b.receivers.size(), b.probes.size(), b.coefficients());
    });
    visit("TRANSPRT", [](auto& a, auto& b) { transportFields(a, b); });
}

constexpr auto kForChunks = [](const auto& visit) { forChunks(nullptr, visit); };

} // namespace

Result<void> writeSparse(const std::string& path, const SparseBake& bake) {
    return writeChunks(path, kFormat, bake, kForChunks);
}

Result<SparseBake> readSparse(const std::string& path, const MemoryBudget& memory) {
    Result<SparseBake> bake = readChunks<SparseBake>(path, kFormat, memory, kForChunks);
    if (!bake)
        return bake;
    if (const std::string defect = sparseDefect(*bake, nullptr); !defect.empty())
        return fail(fmt::format("{}: {}", path, defect));
    return bake;
}

std::string sparseDefect(const SparseBake& bake, const Scene* scene) {
    return chunksDefect(bake, [scene](const auto& visit) { forChunks(scene, visit); });
}

} // namespace limn
