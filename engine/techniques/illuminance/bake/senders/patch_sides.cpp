// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/senders/patch_sides.h"

#include "engine/core/hash.h"
#include "engine/core/parallel.h"
#include "engine/scene/mesh/triangle_geometry.h"
#include "engine/techniques/illuminance/bake/receivers/cache_points.h"
#include "engine/techniques/illuminance/bake/senders/owner_tables.h"
#include "engine/trace/clear_along.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <map>
#include <mutex>
#include <optional>
#include <span>

#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr float kHeight = 0.25f;   ///< above the surface at which segments run [spacings]
constexpr float kToCorner = 0.45f; ///< from a cell's middle, along u and v [cells]

/// The patches of one instance.
struct Patches {
    const TraceScene& trace;
    const SurfelSet& set;
    const SurfelOwners& owners;
    std::uint32_t instance;
    const NearestPoint& nearest;
    std::atomic<std::uint64_t>& rays;
    std::vector<glm::vec3> raised = {}; ///< per surfel of the instance: its place, raised

    const MeshSurfels& surfels() const {
        return set.meshes[trace.scene().instances[instance].mesh];
    }
    float heightOf(std::uint32_t surfel) const {
        return kHeight * std::sqrt(set.surfels.area[set.instanceBegin[instance] + surfel]);
    }
    void raiseSurfels();
    RaisedPoint raisedPoint(const MeshPoint& point, bool back, float height) const;
    RaisedPoint raisedCell(const MeshPoint& middle, float size, bool back, float height) const;
    bool onSameSide(const RaisedPoint& cell, glm::vec3 normal, std::uint32_t surfel) const;
    std::uint32_t ownerOf(const MeshPoint& middle, float size, std::uint32_t nearestOwner,
                          bool back) const;
    std::uint32_t ownerAt(const MeshPoint& point, const RaisedPoint& from,
                          std::uint32_t nearestOwner, bool back) const;
    std::uint32_t ownerOfPart(const MeshPoint& point, std::uint32_t ownerOfCell, bool back) const;
};

void Patches::raiseSurfels() {
    const std::uint32_t first = set.instanceBegin[instance];
    raised.resize(set.instanceBegin[instance + 1] - first);
    parallelRanges(raised.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (auto s = std::uint32_t(begin); s < end; ++s)
            raised[s] =
                raise(trace, {set.surfels.position[first + s], set.surfels.normal[first + s]},
                      heightOf(s))
                    .position;
    });
    rays += raised.size();
}

RaisedPoint Patches::raisedPoint(const MeshPoint& point, bool back, float height) const {
    const Scene& scene = trace.scene();
    WorldPoint p = worldPoint(scene, scene.instances[instance], point);
    if (back)
        p.normal = -p.normal;
    ++rays;
    return raise(trace, p, height);
}

/// A place of a cell: its middle or, where that is covered, one closer to the corners that is not.
RaisedPoint Patches::raisedCell(const MeshPoint& middle, float size, bool back,
                                float height) const {
    constexpr std::array<glm::vec2, 5> kPlaces = {glm::vec2(0), glm::vec2(-1), glm::vec2(1, -1),
                                                  glm::vec2(-1, 1), glm::vec2(1)};
    std::optional<RaisedPoint> first;
    for (const glm::vec2 place : kPlaces) {
        const glm::vec2 uv = middle.barycentric + place * (kToCorner * size);
        if (uv.x + uv.y > 1)
            continue;
        const RaisedPoint point = raisedPoint({middle.triangle, uv}, back, height);
        if (!point.covered)
            return point;
        if (!first)
            first = point;
    }
    return *first;
}

bool Patches::onSameSide(const RaisedPoint& cell, glm::vec3 normal, std::uint32_t surfel) const {
    constexpr float kAlike = 0.5f; // cosine of 60 degrees
    ++rays;
    return clearAlong(trace, cell.position, raised[surfel], [&](const Hit& hit) {
        return hit.instance == instance && std::abs(glm::dot(hit.geometricNormal, normal)) > kAlike;
    });
}

std::uint32_t Patches::ownerOf(const MeshPoint& middle, float size, std::uint32_t nearestOwner,
                               bool back) const {
    const std::uint32_t first = back ? surfels().frontCount : 0;
    return ownerAt(middle, raisedCell(middle, size, back, heightOf(first + nearestOwner)),
                   nearestOwner, back);
}

/// The surfel on the same side of all walls as a point, which is raised to `from`: the nearest one,
/// or one of a few others, or the nearest again where all are behind walls. `nearestOwner` is the
/// index of the nearest surfel on the front, also if `back`: surfels of both sides have the same
/// places.
std::uint32_t Patches::ownerAt(const MeshPoint& point, const RaisedPoint& from,
                               std::uint32_t nearestOwner, bool back) const {
    constexpr std::size_t kCompared = 8;
    const Scene& scene = trace.scene();
    const std::uint32_t first = back ? surfels().frontCount : 0;
    const glm::vec3 normal = worldPoint(scene, scene.instances[instance], point).normal;
    if (onSameSide(from, normal, first + nearestOwner))
        return first + nearestOwner;
    const Mesh& mesh = scene.meshOf(scene.instances[instance]);
    std::array<NearestPoint::Near, kCompared> near;
    const std::size_t count =
        nearest.findSome(trianglePoint(mesh, point.triangle, point.barycentric),
                         triangleNormal(mesh, point.triangle), near);
    for (std::size_t k = 0; k < count; ++k)
        if (near[k].point != nearestOwner && onSameSide(from, normal, first + near[k].point))
            return first + near[k].point;
    return first + nearestOwner;
}

/// The owner of a part of a cell: that of the cell, unless a wall stands between the two.
std::uint32_t Patches::ownerOfPart(const MeshPoint& point, std::uint32_t ownerOfCell,
                                   bool back) const {
    const RaisedPoint from = raisedPoint(point, back, heightOf(ownerOfCell));
    if (from.covered)
        return ownerOfCell;
    return ownerAt(point, from, ownerOfCell - (back ? surfels().frontCount : 0), back);
}

/// Owners of all cells, fronts first; empty where no wall splits any patch.
std::vector<std::uint32_t> partedOwners(const Patches& patches, const Progress& progress) {
    const Scene& scene = patches.trace.scene();
    const Instance& instance = scene.instances[patches.instance];
    const Mesh& mesh = scene.meshOf(instance);
    const SurfelOwners& owners = patches.owners;
    const std::uint32_t sides = isTwoSided(scene, instance) ? 2 : 1;
    std::vector<std::uint32_t> result(std::size_t(owners.cells()) * sides);
    // Cells that no place lies in stay with the first surfel of their side.
    std::fill(result.begin() + owners.cells(), result.end(), patches.surfels().frontCount);
    std::atomic<bool> differs = false;
    owners.forTriangles(mesh, progress, [&](std::uint32_t t) {
        for (std::uint32_t side = 0; side < sides; ++side) {
            const std::uint32_t first = side * patches.surfels().frontCount;
            owners.forCellsOf(t, [&](const SurfelOwners::Cell& cell) {
                const auto size = float(std::sqrt(cell.share / 2)); // smaller where it is cut
                const std::uint32_t near = owners.front(cell.index),
                                    surfel = patches.ownerOf({t, cell.middle * 0.999f}, size, near,
                                                             side == 1);
                result[side * owners.cells() + cell.index] = surfel;
                if (surfel != first + near)
                    differs = true;
            });
        }
    });
    return differs ? std::move(result) : std::vector<std::uint32_t>();
}

/// By two indices into MeshSurfels, the smaller one first: whether no wall stands between them.
using PairsOnSameSide = std::map<std::pair<std::uint32_t, std::uint32_t>, bool>;

/// Whether a wall may cross a cell: a wall stands between its owner and that of a cell beside it on
/// the triangle. Answers for pairs of owners are kept in `pairs`.
bool mayBeCrossed(const Patches& patches, const std::vector<std::uint32_t>& owner,
                  std::uint32_t triangle, const SurfelOwners::Cell& cell, bool back,
                  PairsOnSameSide& pairs) {
    const SurfelOwners& owners = patches.owners;
    const std::uint32_t side = back ? owners.cells() : 0, surfel = owner[side + cell.index];
    const Surfels& s = patches.set.surfels;
    const std::uint32_t first = patches.set.instanceBegin[patches.instance];
    for (const glm::vec2 step :
         {glm::vec2(1, 0), glm::vec2(-1, 0), glm::vec2(0, 1), glm::vec2(0, -1)}) {
        const glm::vec2 uv = cell.middle + cell.side * step;
        if (!(uv.x > 0 && uv.y > 0 && uv.x + uv.y < 1))
            continue;
        const std::uint32_t beside = owner[side + owners.cellAt(triangle, uv.x, uv.y).cell];
        if (beside == surfel)
            continue;
        const auto [pair, isNew] = pairs.try_emplace(std::minmax(surfel, beside));
        if (isNew)
            pair->second =
                patches.onSameSide({patches.raised[pair->first.first], false},
                                   s.normal[first + pair->first.first], pair->first.second);
        if (!pair->second)
            return true;
    }
    return false;
}

/// Splits the cells that a wall crosses. `owner`: from partedOwners(). Returns PatchSides::parts of
/// the instance.
std::vector<std::uint32_t> splitCells(const Patches& patches, const Progress& progress,
                                      std::vector<std::uint32_t>& owner) {
    constexpr std::uint32_t kAcross = SurfelOwners::kAcross, kParts = SurfelOwners::kParts;
    const Scene& scene = patches.trace.scene();
    const Instance& instance = scene.instances[patches.instance];
    const SurfelOwners& owners = patches.owners;
    if (owner.empty())
        return {};
    const bool twoSided = isTwoSided(scene, instance);
    using Parts = std::array<std::uint32_t, kParts>;
    std::map<std::uint32_t, Parts> found; // by index into `owner`
    std::mutex mutex;
    const auto split = [&](std::uint32_t t, const SurfelOwners::Cell& cell, bool back) {
        const std::uint32_t entry = cell.index + (back ? owners.cells() : 0), surfel = owner[entry];
        const auto ownerAt = [&](glm::vec2 offset) { // [cells] from the middle
            const glm::vec2 uv = cell.middle + offset * cell.side;
            return uv.x + uv.y < 1 ? patches.ownerOfPart({t, uv}, surfel, back) : surfel;
        };
        bool crossed = false;
        for (const float x : {-kToCorner, kToCorner})
            for (const float y : {-kToCorner, kToCorner})
                crossed = crossed || ownerAt({x, y}) != surfel;
        if (!crossed)
            return;
        Parts parts;
        for (std::uint32_t k = 0; k < kParts; ++k)
            parts[k] = ownerAt(
                (glm::vec2(float(k % kAcross), float(k / kAcross)) + 0.5f) / float(kAcross) - 0.5f);
        const std::lock_guard lock(mutex);
        found.emplace(entry, parts);
    };
    owners.forTriangles(scene.meshOf(instance), progress, [&](std::uint32_t t) {
        PairsOnSameSide pairs;
        owners.forCellsOf(t, [&](const SurfelOwners::Cell& cell) {
            for (const bool back : {false, true})
                if ((!back || twoSided) && mayBeCrossed(patches, owner, t, cell, back, pairs))
                    split(t, cell, back);
        });
    });
    std::vector<std::uint32_t> result;
    for (const auto& [cell, parts] : found) {
        owner[cell] = PatchSides::kSplit | std::uint32_t(result.size() / kParts);
        result.insert(result.end(), parts.begin(), parts.end());
    }
    return result;
}

/// Adds the reassigned cells of an instance to the hashes of their old and new surfels.
void noteChanges(const SurfelOwners& owners, const MeshSurfels& surfels, std::uint32_t first,
                 const std::vector<std::uint32_t>& parted, std::span<const std::uint32_t> parts,
                 std::vector<std::uint64_t>& changed) {
    constexpr std::uint32_t kParts = SurfelOwners::kParts;
    for (std::uint32_t c = 0; c < parted.size(); ++c) {
        const bool back = c >= owners.cells();
        const std::uint32_t before =
            owners.front(back ? c - owners.cells() : c) + (back ? surfels.frontCount : 0);
        if (parted[c] == before)
            continue;
        const bool split = parted[c] & PatchSides::kSplit;
        const std::span<const std::uint32_t> owned =
            split ? parts.subspan(std::size_t(parted[c] & ~PatchSides::kSplit) * kParts, kParts)
                  : std::span(&parted[c], 1);
        std::uint64_t hash = hashValue(c, 1);
        for (const std::uint32_t s : owned)
            hash = hashValue(s, hash);
        changed[first + before] = hashValue(hash, changed[first + before]);
        for (const std::uint32_t s : owned)
            changed[first + s] = hashValue(hash, changed[first + s]);
    }
}

} // namespace

PatchSides findPatchSides(const TraceScene& trace, const SurfelSet& set, const OwnerTables& owners,
                          const Progress& progress) {
    const Scene& scene = trace.scene();
    PatchSides result;
    result.owner.resize(scene.instances.size());
    result.parts.resize(scene.instances.size());
    std::atomic<std::uint64_t> rays = 0;
    parallelRanges(scene.instances.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (auto i = std::uint32_t(begin); i < end && !progress.cancelled(); ++i) {
            const std::uint32_t mesh = scene.instances[i].mesh;
            const MeshSurfels& surfels = set.meshes[mesh];
            if (set.instanceBegin[i] == set.instanceBegin[i + 1] || surfels.frontCount < 2)
                continue;
            const NearestPoint nearest = nearestFront(surfels);
            Patches patches{trace, set, owners.tableOf(mesh), i, nearest, rays};
            patches.raiseSurfels();
            result.owner[i] = partedOwners(patches, progress);
            result.parts[i] = splitCells(patches, progress, result.owner[i]);
        }
    });
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        if (result.owner[i].empty())
            continue;
        const std::uint32_t mesh = scene.instances[i].mesh;
        result.changed.resize(set.surfels.size());
        noteChanges(owners.tableOf(mesh), set.meshes[mesh], set.instanceBegin[i], result.owner[i],
                    result.parts[i], result.changed);
    }
    result.rays = rays;
    return result;
}

} // namespace limn
