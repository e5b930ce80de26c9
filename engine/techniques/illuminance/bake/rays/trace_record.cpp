// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/rays/trace_record.h"

#include "engine/core/archive.h"
#include "engine/core/hash.h"
#include "engine/core/parallel.h"
#include "engine/lightmap/layout/layout_rules.h"
#include "engine/scene/mesh/input_hash.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

namespace limn {

namespace {

std::uint64_t hashSurfels(const MeshSurfels& s) {
    const std::uint64_t h = hashVector(s.position, hashVector(s.normal, s.frontCount));
    return hashVector(s.density.density,
                      hashVector(s.areas, hashValue(s.area, hashVector(s.triangle, h))));
}

std::uint64_t hashCache(const Caches& caches, const CachePoints& points, std::size_t c) {
    const std::uint32_t begin = points.begin[c], count = points.begin[c + 1] - begin;
    std::uint64_t h = hashValue(std::uint32_t(caches.kind[c]), points.seed[c]);
    h = hashBytes(&points.position[begin], count * sizeof(glm::vec3), h);
    return hashBytes(&points.normal[begin], count * sizeof(glm::vec3), h);
}

template <class A, class R>
void recordFields(A& a, R& r) {
    constexpr std::uint64_t kMaxSurfels = 1 << 24; // of all instances
    a("rays", r.rays, rule::within(1, 65536));
    a("cachesPerBlock", r.cachesPerBlock, rule::within(1, 65536));
    a("clearance", r.clearance, rule::finite);
    a("instances", r.instances,
      rule::holds("too many surfels",
                  [](const auto& instances) {
                      std::uint64_t sum = 0;
                      for (const TracedInstance& i : instances)
                          sum += i.surfelCount;
                      return sum <= kMaxSurfels;
                  }),
      rule::each("not placed",
                 [](std::size_t, const TracedInstance& i) { return !rule::inReach()(i.toWorld); }));
    a("parted", r.parted, rule::holds("of another length", [&r](const auto& parted) {
          return parted.empty() || parted.size() == r.surfels();
      }));
    a("caches", r.caches, rule::any);
    a("blocks", r.blocks, rule::holds("of another length", [&r](const auto& blocks) {
          return blocks.size() == r.blockCount();
      }));
}

} // namespace

std::uint32_t TraceRecord::surfels() const {
    std::uint32_t sum = 0;
    for (const TracedInstance& i : instances)
        sum += i.surfelCount;
    return sum;
}

TraceRecord describeTrace(const TraceScene& trace, const SurfelSet& set, const OwnerTables& owners,
                          const Caches& caches, const CachePoints& points, std::uint32_t rays,
                          const std::vector<std::uint64_t>& meshes) {
    const Scene& scene = trace.scene();
    TraceRecord record;
    record.rays = rays;
    record.cachesPerBlock = std::clamp((1U << 19) / rays, 1U, 512U);
    record.clearance = trace.epsilonAt(glm::vec3(0));
    std::vector<std::uint64_t> surface(scene.materials.size()), surfels(set.meshes.size());
    for (std::size_t m = 0; m < surface.size(); ++m)
        surface[m] = hashSurface(scene, scene.materials[m], 6);
    for (std::size_t m = 0; m < surfels.size(); ++m)
        surfels[m] = hashSurfels(set.meshes[m]);
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const std::uint32_t count = set.instanceBegin[i + 1] - set.instanceBegin[i];
        if (count > 0)
            record.instances.push_back(
                {hashValue(std::uint32_t(instance.darkBacks),
                           hashValue(surface[instance.material], meshes[instance.mesh])),
                 surfels[instance.mesh], instance.toWorld, count, i});
    }
    record.parted = owners.sides().changed;
    record.caches.resize(caches.size());
    parallelRanges(caches.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c)
            record.caches[c] = hashCache(caches, points, c);
    });
    return record;
}

std::vector<std::uint64_t> ownerKeys(const SurfelSet& set,
                                     const std::vector<std::uint64_t>& meshes) {
    std::vector<std::uint64_t> keys(meshes.size());
    for (std::size_t m = 0; m < keys.size(); ++m)
        keys[m] = hashValue(meshes[m], hashSurfels(set.meshes[m]));
    return keys;
}

std::uint64_t hashLamps(const Scene& scene, std::uint64_t seed) {
    for (const Instance& i : scene.instances)
        seed = hashValue(std::uint32_t(emits(scene.materialOf(i))), seed);
    return seed;
}

std::uint64_t hashRecord(const TraceRecord& r) {
    std::uint64_t h = hashValue(r.clearance, hashValue(r.rays, 7));
    for (const TracedInstance& i : r.instances) {
        h = hashValue(i.shape, hashValue(i.surfels, hashValue(i.surfelCount, h)));
        h = hashBytes(&i.toWorld, sizeof i.toWorld, h);
    }
    return hashVector(r.caches, hashVector(r.parted, h));
}

std::string recordBytes(const TraceRecord& record) {
    ByteWriter writer;
    recordFields(writer, record);
    return std::move(writer.bytes);
}

bool readRecord(const std::string& bytes, TraceRecord& record) {
    return readFields(bytes, [&](auto& archive) { recordFields(archive, record); });
}

InstanceMatch matchInstances(const TraceRecord& before, const TraceRecord& now) {
    InstanceMatch match;
    match.surfelNow.reserve(before.surfels());
    std::multimap<std::uint64_t, std::size_t> waiting; // instances of `now` by shape, in order
    std::vector<std::uint32_t> firstNow(now.instances.size());
    for (std::size_t i = 0, first = 0; i < now.instances.size(); ++i) {
        waiting.emplace(now.instances[i].shape, i);
        firstNow[i] = std::uint32_t(first);
        first += now.instances[i].surfelCount;
    }
    std::map<std::uint64_t, std::uint32_t> departed; // shapes no longer at a place
    for (const TracedInstance& old : before.instances) {
        const auto [begin, end] = waiting.equal_range(old.shape);
        const auto same = std::find_if(begin, end, [&](const auto& entry) {
            return old.inPlace(now.instances[entry.second]);
        });
        const bool there = same != end;
        const bool sampled = there && old.surfels == now.instances[same->second].surfels;
        for (std::uint32_t s = 0; s < old.surfelCount; ++s)
            match.surfelNow.push_back(sampled ? firstNow[same->second] + s : InstanceMatch::kGone);
        match.resampled += there && !sampled ? 1 : 0;
        if (there) {
            waiting.erase(same);
        } else {
            ++departed[old.shape];
            const auto sameShape =
                std::find_if(now.instances.begin(), now.instances.end(),
                             [&](const TracedInstance& i) { return i.shape == old.shape; });
            match.departed.push_back(
                {old.toWorld, sameShape != now.instances.end() ? sameShape->instance : ~0U});
        }
    }
    for (const auto& [shape, i] : waiting) {
        match.appeared.push_back(now.instances[i].instance);
        if (std::uint32_t& gone = departed[shape]; gone > 0) {
            --gone;
            ++match.moved;
        } else {
            ++match.added;
        }
    }
    for (const auto& [shape, count] : departed)
        match.removed += count;
    // A patch that another wall splits has other hits, even though its surfel has not moved.
    const auto partedAt = [](const TraceRecord& r, std::uint32_t s) {
        return r.parted.empty() ? 0 : r.parted[s];
    };
    for (std::uint32_t s = 0; s < match.surfelNow.size(); ++s)
        if (std::uint32_t& to = match.surfelNow[s];
            to != InstanceMatch::kGone && partedAt(before, s) != partedAt(now, to))
            to = InstanceMatch::kGone;
    for (std::uint32_t s = 0; s < match.surfelNow.size(); ++s)
        match.identity = match.identity &&
                         (match.surfelNow[s] == s || match.surfelNow[s] == InstanceMatch::kGone);
    match.identity = match.identity && before.surfels() == now.surfels();
    return match;
}

std::string matchWords(const InstanceMatch& match) {
    std::string words;
    const auto add = [&](std::uint32_t count, const char* what) {
        if (count > 0)
            words +=
                fmt::format("{}{} {}{}", words.empty() ? "" : ", ", count,
                            words.empty() ? (count == 1 ? "instance " : "instances ") : "", what);
    };
    add(match.moved, "moved");
    add(match.added, "added");
    add(match.removed, "removed");
    add(match.resampled, "with other surfels");
    return words;
}

} // namespace limn
