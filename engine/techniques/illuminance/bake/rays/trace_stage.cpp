// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/rays/trace_stage.h"

#include "engine/core/archive.h"
#include "engine/core/field_rule.h"
#include "engine/core/hash.h"
#include "engine/core/large_pages.h"
#include "engine/core/memory_budget.h"
#include "engine/core/parallel.h"
#include "engine/scene/mesh/input_hash.h"
#include "engine/stages/stage_keys.h"
#include "engine/techniques/illuminance/bake/rays/trace_record.h"
#include "engine/techniques/illuminance/bake/receivers/trace_grid_depth.h"
#include "engine/techniques/illuminance/bake/senders/cluster_tree.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>

#include <fmt/format.h>

namespace limn {

namespace {

// Keys under which the parts of a trace are stored.
std::uint64_t recordKey(std::uint64_t trace) {
    return stageKey(Stage::TraceRecord, trace);
}
std::uint64_t blockKey(std::uint64_t trace, std::uint32_t block) {
    return stageKey(Stage::TraceBlock, hashValue(block, trace));
}

/// Key of what every trace of a document shares, wherever its objects are.
std::uint64_t documentKey(const TraceInput& in) {
    return stageKey(Stage::TraceOfDocument, hashValue(in.rays, hashVector(in.meshes, 0)));
}

std::uint64_t aimedKey(const TraceInput& in, std::uint64_t trace) {
    constexpr std::uint32_t kAtPatches = 2; // earlier rays ran to surfels' positions
    const std::uint64_t h = hashValue(kAimedFrom, hashValue(std::uint32_t(in.linker), trace));
    return stageKey(Stage::AimedHits, hashLamps(in.trace.scene(), hashValue(kAtPatches, h)));
}

/// A block's caches that differ from an earlier one's, and their hits.
template <class A, class Root, class Changed, class Hits>
void differenceFields(A& a, Root& root, Changed& changed, Hits& hits, std::size_t caches,
                      std::uint32_t rays) {
    a("root", root, rule::any);
    a("changed", changed, rule::below(caches));
    a("hits", hits, rule::count(std::uint64_t(changed.size()) * rays));
}

/// Whether every cache aims from its own points, at existing senders.
bool areAims(const GatherHits& hits, const TraceInput& in) {
    const std::uint64_t senders = in.set.surfels.size() + kSkyCells;
    for (std::size_t c = 0; c < in.caches.size(); ++c)
        for (std::uint32_t k = hits.aimedBegin[c]; k < hits.aimedBegin[c + 1]; ++k) {
            const AimedSample& s = hits.aimed[k];
            if (s.sender >= senders || s.point < in.points.begin[c] ||
                s.point >= in.points.begin[c + 1] || !(s.scale >= 0 && s.scale <= float(senders)))
                return false;
        }
    return true;
}

template <class A, class H>
void aimedFields(A& a, H& hits, const TraceInput& in) {
    a("aimedBegin", hits.aimedBegin, rule::offsets(in.caches.size(), hits.aimed.size()));
    a("aimed", hits.aimed,
      rule::holds("out of range", [&](const auto&) { return areAims(hits, in); }));
}

/// 10585 as "10 585".
std::string grouped(std::uint64_t n) {
    const std::string digits = std::to_string(n);
    std::string s;
    for (std::size_t i = 0; i < digits.size(); ++i) {
        if (i > 0 && (digits.size() - i) % 3 == 0)
            s += ' ';
        s += digits[i];
    }
    return s;
}

/// Form in which a block of caches is stored: all its hits or, where few caches differ from an
/// earlier block, that block's key and the hits of those caches.
struct KeptBlock {
    bool known = false;                 ///< its hits were found
    std::uint64_t root = 0;             ///< key of all hits, its own or the earlier block's
    std::vector<std::uint32_t> changed; ///< caches that differ from it, from the block's first
};

/// An earlier trace whose hits may still be valid.
struct EarlierTrace {
    TraceRecord record;
    InstanceMatch match;
    bool aligned = false;     ///< most of its caches equal the current ones, index by index
    std::vector<RawHit> hits; ///< of all its caches; empty where aligned
    std::vector<KeptBlock> blocks;
    std::unordered_map<std::uint64_t, std::uint32_t> cacheOf; ///< by hash; empty where aligned
    std::unique_ptr<NewObjects> appeared;
};

class Tracing {
public:
    Tracing(const TraceInput& input, const Progress& progress, StageStore* store, GatherHits& hits)
        : in(input), m_progress(progress), m_store(store), m_hits(hits),
          m_gatherer(in.trace, in.set, in.caches, in.points, in.rays, in.owners),
          m_record(
              describeTrace(in.trace, in.set, in.owners, in.caches, in.points, in.rays, in.meshes)),
          m_key(hashRecord(m_record)), m_done(m_record.blockCount()), m_changed(in.caches.size()),
          m_left(m_done.size()) {}

    Result<TraceReport> run();

private:
    std::size_t first(std::uint32_t block) const {
        return std::size_t(block) * m_record.cachesPerBlock;
    }
    std::size_t last(std::uint32_t block) const {
        return std::min(first(block) + m_record.cachesPerBlock, in.caches.size());
    }
    KeptBlock loadBlock(std::uint64_t key, RawHit* out, std::size_t caches,
                        std::uint32_t surfels) const;
    void loadDone();
    void loadEarlier();
    bool loadEarlierHits();
    void noteMoved(std::uint64_t key);
    bool takeFromEarlier(std::uint32_t cache, RawHit* out) const;
    std::uint64_t retrace(std::uint32_t cache, RawHit* out);
    void traceOne(std::uint32_t cache);
    void keepBlock(std::uint32_t block);
    void keepRecord(bool changed);
    bool finish();
    void note();

    const TraceInput& in;
    const Progress& m_progress;
    StageStore* m_store;
    GatherHits& m_hits;
    RayGatherer m_gatherer;
    TraceRecord m_record;
    std::uint64_t m_key;
    bool m_exact = false; ///< this very trace was stored completely
    std::unique_ptr<EarlierTrace> m_earlier;
    std::vector<std::uint8_t> m_done;               ///< per block: its hits are final
    std::vector<std::uint8_t> m_changed;            ///< per cache: differs from the earlier trace
    std::vector<std::atomic<std::uint32_t>> m_left; ///< per block: caches still to do
    std::atomic<std::uint64_t> m_rays = 0, m_retraced = 0;
    TraceReport m_report;
};

/// Whether these are valid hits for `surfels` surfels.
bool areHits(std::span<const RawHit> hits, std::uint32_t surfels) {
    return std::ranges::all_of(hits, [surfels](RawHit hit) {
        return hit == kUntraced || (hit & ~kBack) < (hit & kBack ? surfels : surfels + kSkyCells);
    });
}

/// Loads hits of another trace, of as many surfels, into `out`.
KeptBlock Tracing::loadBlock(std::uint64_t key, RawHit* out, std::size_t caches,
                             std::uint32_t surfels) const {
    const std::size_t bytesPerCache = in.rays * sizeof(RawHit);
    KeptBlock block{.known = false, .root = key, .changed = {}};
    std::optional<std::string> bytes = m_store->find(key);
    std::vector<RawHit> hits;
    if (bytes &&
        bytes->size() != caches * bytesPerCache) { // one that differs from another has fewer
        if (!readFields(*bytes, [&](auto& archive) {
                differenceFields(archive, block.root, block.changed, hits, caches, in.rays);
            }))
            return block;
        bytes = m_store->find(block.root);
    }
    if (!bytes || bytes->size() != caches * bytesPerCache)
        return block;
    std::memcpy(out, bytes->data(), bytes->size());
    for (std::size_t i = 0; i < block.changed.size(); ++i)
        std::copy_n(&hits[i * in.rays], in.rays, out + block.changed[i] * std::size_t(in.rays));
    block.known = areHits({out, caches * in.rays}, surfels);
    return block;
}

/// Loads the blocks of this very trace, whether it was finished or stopped.
void Tracing::loadDone() {
    TraceRecord kept;
    const std::optional<std::string> bytes = m_store->find(recordKey(m_key));
    m_exact = bytes && readRecord(*bytes, kept) && kept.blocks.size() == m_done.size();
    m_record.blocks.resize(m_done.size());
    for (std::uint32_t b = 0; b < m_done.size(); ++b)
        m_record.blocks[b] = m_exact ? kept.blocks[b] : blockKey(m_key, b);
    parallelRanges(m_done.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t b = begin; b < end; ++b) {
            const std::size_t from = first(std::uint32_t(b)), to = last(std::uint32_t(b));
            m_done[b] = loadBlock(m_record.blocks[b], &m_hits.sender[from * in.rays], to - from,
                                  std::uint32_t(in.set.surfels.size()))
                            .known;
        }
    });
}

/// Whether more of the caches have kept their index than not.
bool alignedCaches(const TraceRecord& before, const TraceRecord& now) {
    std::size_t same = 0;
    for (std::size_t c = 0; c < std::min(before.caches.size(), now.caches.size()); ++c)
        same += before.caches[c] == now.caches[c] ? 1 : 0;
    return before.caches.size() == now.caches.size() && 2 * same > now.caches.size();
}

/// Loads the latest finished trace of the document, if its rays start alike.
void Tracing::loadEarlier() {
    std::uint64_t key = 0;
    const std::optional<std::string> pointer = m_store->find(documentKey(in));
    if (!pointer || pointer->size() != sizeof key)
        return;
    std::memcpy(&key, pointer->data(), sizeof key);
    auto earlier = std::make_unique<EarlierTrace>();
    const std::optional<std::string> bytes = m_store->find(recordKey(key));
    if (!bytes || !readRecord(*bytes, earlier->record) || earlier->record.rays != m_record.rays ||
        earlier->record.cachesPerBlock != m_record.cachesPerBlock ||
        earlier->record.clearance != m_record.clearance)
        return;
    earlier->match = matchInstances(earlier->record, m_record);
    earlier->aligned = alignedCaches(earlier->record, m_record);
    m_earlier = std::move(earlier);
    if (!loadEarlierHits()) {
        m_earlier = nullptr;
        return;
    }
    noteMoved(key);
    if (!m_earlier->match.appeared.empty())
        m_earlier->appeared = std::make_unique<NewObjects>(in.trace, m_earlier->match.appeared);
}

/// Loads the earlier trace's hits. Returns false where memory does not suffice.
bool Tracing::loadEarlierHits() {
    EarlierTrace& earlier = *m_earlier;
    const std::size_t caches = earlier.record.caches.size();
    if (!earlier.aligned) {
        if (caches * in.rays * sizeof(RawHit) > halfOfMemory() / 2)
            return false;
        earlier.hits.resize(caches * in.rays);
        for (std::uint32_t c = 0; c < caches; ++c)
            earlier.cacheOf.emplace(earlier.record.caches[c], c);
    }
    earlier.blocks.resize(earlier.record.blocks.size());
    parallelRanges(earlier.blocks.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t b = begin; b < end; ++b) {
            if (earlier.aligned && m_done[b])
                continue;
            const std::size_t from = b * m_record.cachesPerBlock;
            const std::size_t to = std::min<std::size_t>(from + m_record.cachesPerBlock, caches);
            RawHit* out = (earlier.aligned ? m_hits.sender : earlier.hits).data() + from * in.rays;
            earlier.blocks[b] =
                loadBlock(earlier.record.blocks[b], out, to - from, earlier.record.surfels());
        }
    });
    return true;
}

/// Reports what moved since the earlier trace `key`, where that can be determined.
void Tracing::noteMoved(std::uint64_t key) {
    const InstanceMatch& match = m_earlier->match;
    if (!match.identity)
        return;
    const Scene& scene = in.trace.scene();
    MovedSince moved{.key = key, .elsewhere = {}, .places = {}};
    for (const std::uint32_t s : match.surfelNow)
        moved.elsewhere.push_back(s == InstanceMatch::kGone ? 1 : 0);
    for (const InstanceMatch::Departed& departed : match.departed) {
        if (departed.sameShape == ~0U)
            return;
        const Mesh& mesh = scene.meshOf(scene.instances[departed.sameShape]);
        moved.places.push_back(sphereAround(in.trace, mesh, departed.toWorld));
    }
    for (const std::uint32_t i : match.appeared) {
        const Instance& instance = scene.instances[i];
        moved.places.push_back(sphereAround(in.trace, scene.meshOf(instance), instance.toWorld));
    }
    m_report.moved = std::move(moved);
}

/// Copies an earlier cache's hits to `out`, unless they are already there.
bool Tracing::takeFromEarlier(std::uint32_t cache, RawHit* out) const {
    if (!m_earlier)
        return false;
    if (m_earlier->aligned)
        return m_earlier->blocks[cache / m_record.cachesPerBlock].known &&
               m_earlier->record.caches[cache] == m_record.caches[cache];
    const auto it = m_earlier->cacheOf.find(m_record.caches[cache]);
    if (it == m_earlier->cacheOf.end() ||
        !m_earlier->blocks[it->second / m_record.cachesPerBlock].known)
        return false;
    std::copy_n(m_earlier->hits.data() + std::size_t(it->second) * in.rays, in.rays, out);
    return true;
}

/// Brings an earlier cache's hits up to date; returns the number of rays traced again.
std::uint64_t Tracing::retrace(std::uint32_t cache, RawHit* out) {
    const std::vector<std::uint32_t>& now = m_earlier->match.surfelNow;
    const auto sky = std::uint32_t(in.set.surfels.size());
    std::vector<std::uint8_t> again(in.rays);
    for (std::uint32_t r = 0; r < in.rays; ++r) {
        if (out[r] == kUntraced)
            continue;
        const std::uint32_t back = out[r] & kBack, sender = out[r] & ~kBack;
        const std::uint32_t moved =
            sender < now.size() ? now[sender] : std::uint32_t(sender - now.size()) + sky;
        again[r] = moved == InstanceMatch::kGone ? 1 : 0;
        out[r] = again[r] ? 0 : moved | back;
    }
    if (m_earlier->appeared)
        m_rays += m_earlier->appeared->mark(m_gatherer, in.points, cache, again);
    std::uint64_t count = 0;
    const CacheRays rays = m_gatherer.directions(cache);
    for (std::uint32_t r = 0; r < in.rays; ++r)
        if (again[r] && out[r] != kUntraced) {
            out[r] = m_gatherer.trace(m_gatherer.ray(rays, cache, r));
            ++count;
        }
    return count > 0 ? count + m_gatherer.traceRest(cache, out) : 0;
}

void Tracing::traceOne(std::uint32_t cache) {
    RawHit* out = &m_hits.sender[std::size_t(cache) * in.rays];
    const std::uint32_t block = cache / m_record.cachesPerBlock;
    const std::uint64_t rays =
        takeFromEarlier(cache, out) ? retrace(cache, out) : m_gatherer.traceCache(cache, out);
    m_rays += rays;
    m_retraced += rays > 0 ? 1 : 0;
    m_changed[cache] = rays > 0 ? 1 : 0;
    if (--m_left[block] == 0 && m_store && !m_progress.cancelled())
        keepBlock(block);
}

/// Stores a block, only as its difference from the earlier one where possible.
void Tracing::keepBlock(std::uint32_t block) {
    const std::size_t begin = first(block), caches = last(block) - begin;
    const RawHit* hits = &m_hits.sender[begin * in.rays];
    const bool known = m_earlier && m_earlier->aligned && m_earlier->match.identity &&
                       m_earlier->blocks[block].known;
    std::vector<std::uint8_t> changed(m_changed.begin() + std::ptrdiff_t(begin),
                                      m_changed.begin() + std::ptrdiff_t(begin + caches));
    if (known && std::count(changed.begin(), changed.end(), 1) == 0) {
        m_record.blocks[block] = m_earlier->record.blocks[block];
        return;
    }
    m_record.blocks[block] = blockKey(m_key, block);
    if (known)
        for (const std::uint32_t c : m_earlier->blocks[block].changed)
            changed[c] = 1;
    if (const auto count = std::size_t(std::count(changed.begin(), changed.end(), 1));
        known && 2 * count < caches) {
        std::vector<std::uint32_t> which;
        std::vector<RawHit> theirs;
        for (std::uint32_t c = 0; c < caches; ++c)
            if (changed[c]) {
                which.push_back(c);
                theirs.insert(theirs.end(), hits + std::size_t(c) * in.rays,
                              hits + std::size_t(c + 1) * in.rays);
            }
        ByteWriter writer;
        differenceFields(writer, m_earlier->blocks[block].root, which, theirs, caches, in.rays);
        m_store->put(m_record.blocks[block], writer.bytes);
        return;
    }
    m_store->put(m_record.blocks[block],
                 {reinterpret_cast<const char*>(hits), caches * in.rays * sizeof(RawHit)});
}

/// Stores the record and marks this trace as the latest of the document.
void Tracing::keepRecord(bool changed) {
    if (changed)
        m_store->put(recordKey(m_key), recordBytes(m_record));
    const std::string latest(reinterpret_cast<const char*>(&m_key), sizeof m_key);
    if (m_store->find(documentKey(in)) != latest)
        m_store->put(documentKey(in), latest);
}

/// Turns the raw hits into those that the cut needs, aimed rays included.
bool Tracing::finish() {
    const bool aims = maxAimed(in.trace.scene(), in.set, in.linker, in.rays) > 0;
    const std::uint64_t key = aimedKey(in, m_key);
    if (aims && m_store)
        if (const std::optional<std::string> bytes = m_store->find(key))
            if (!readFields(*bytes, [&](auto& archive) { aimedFields(archive, m_hits, in); }))
                m_hits.aimedBegin.clear(), m_hits.aimed.clear();
    m_report.gridDepth =
        gridDepths(in.set.surfels, in.caches, in.points, m_hits.sender, in.rays, in.gridReach);
    const bool fresh = m_hits.aimedBegin.empty();
    std::uint64_t aimed = 0;
    m_hits.lamps = in.linker == Linker::Gather
                       ? findLampPatches(in.trace.scene(), in.set, in.owners)
                       : LampPatches{};
    if (!classifyHits(in.trace, in.set, in.caches, in.points, in.linker, m_progress, m_hits, aimed))
        return false;
    m_rays += aimed;
    if (aims && m_store && fresh) {
        ByteWriter writer;
        aimedFields(writer, std::as_const(m_hits), in);
        m_store->put(key, writer.bytes);
    }
    return true;
}

void Tracing::note() {
    const std::string caches = grouped(in.caches.size());
    const auto kept = std::size_t(std::count(m_done.begin(), m_done.end(), 1));
    const std::string why = m_earlier ? matchWords(m_earlier->match) : "";
    if (m_earlier && m_retraced > 0)
        m_report.notes.push_back(fmt::format("{}: {} of {} caches re-traced",
                                             why.empty() ? "Texels or cells changed" : why,
                                             grouped(m_retraced), caches));
    else if (m_earlier && !m_exact)
        m_report.notes.push_back(fmt::format("{}: no ray of {} caches meets it",
                                             why.empty() ? "Nothing moved" : why, caches));
    else if (m_exact && m_retraced == 0)
        m_report.notes.push_back(fmt::format("Rays kept from an earlier bake: 0 of {} caches "
                                             "re-traced",
                                             caches));
    if (!m_exact && kept > 0)
        m_report.notes.push_back(fmt::format(
            "Resumed: {} of {} blocks of caches were traced before", kept, m_done.size()));
}

Result<TraceReport> Tracing::run() {
    m_report.key = m_key;
    m_progress.at("trace", 0);
    m_hits.rays = in.rays;
    resizeLarge(m_hits.sender, in.caches.size() * in.rays);
    m_hits.aimedBegin.clear();
    m_record.blocks.resize(m_done.size());
    if (m_store) {
        loadDone();
        if (std::count(m_done.begin(), m_done.end(), 0) > 0)
            loadEarlier();
    }
    std::vector<std::uint32_t> caches;
    for (std::uint32_t b = 0; b < m_done.size(); ++b) {
        m_left[b] = std::uint32_t(last(b) - first(b));
        for (std::size_t c = first(b); !m_done[b] && c < last(b); ++c)
            caches.push_back(std::uint32_t(c));
    }
    const std::size_t grain = std::clamp<std::size_t>(8192 / in.rays, 1, 8);
    if (!parallelRanges(caches.size(), grain, m_progress, "trace",
                        [&](std::size_t begin, std::size_t end) {
                            for (std::size_t i = begin; i < end; ++i)
                                traceOne(caches[i]);
                        }))
        return fail("cancelled");
    if (m_store)
        keepRecord(!m_exact || !caches.empty());
    note();
    if (!finish())
        return fail("cancelled");
    m_report.rays = m_rays;
    return m_report;
}

} // namespace

Result<TraceReport> traceHits(const TraceInput& in, const Progress& progress, StageStore* store,
                              GatherHits& hits) {
    const std::uint64_t caches = in.caches.size(),
                        aimed = maxAimed(in.trace.scene(), in.set, in.linker, in.rays),
                        bytes = caches * (in.rays * sizeof(RawHit) + aimed * sizeof(AimedSample)),
                        maximum = halfOfMemory();
    if (bytes > maximum)
        return fail(fmt::format(
            "bake settings: {} rays for each of {} caches need {:.1f} GiB, more than half of this "
            "machine's memory ({:.1f} GiB): lower rays, lightmap or grid",
            in.rays, caches, double(bytes) / (1 << 30), double(maximum) / (1 << 30)));
    return Tracing(in, progress, store, hits).run();
}

} // namespace limn
