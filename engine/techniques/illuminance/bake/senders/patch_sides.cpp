// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/senders/patch_sides.h"

#include "engine/core/hash.h"
#include "engine/core/parallel.h"
#include "engine/scene/mesh/triangle_geometry.h"
#include "engine/techniques/illuminance/bake/receivers/cache_points.h"
#include "engine/techniques/illuminance/bake/senders/owner_tables.h"
#include "engine/trace/clear_along.h"
#include "engine/trace/rays_together.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <map>
#include <mutex>
#include <numeric>
#include <optional>
#include <span>
#include <tuple>

#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr float kHeight = 0.25f;   ///< above the surface at which segments run [spacings]
constexpr float kToCorner = 0.45f; ///< from a cell's middle, along its sides [cells]

constexpr std::uint32_t kBehind = ~0U, kNone = ~0U;

/// A cell on one side of an instance that is to be given to a surfel.
struct CellToOwn {
    SurfelOwners::Cell cell;
    std::uint32_t triangle;
    std::uint32_t surfel; ///< the nearest on this side, index into MeshSurfels
    bool back;
    RaisedPoint from{glm::vec3(0), true}; ///< the middle, raised

    MeshPoint middle() const { return {triangle, cell.middle()}; }
};

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
    WorldPoint placeOf(const MeshPoint& point, bool back) const;
    RaisedPoint raisedPoint(const MeshPoint& point, bool back, float height) const;
    void raiseCells(std::span<CellToOwn> cells) const;
    bool onSameSide(const RaisedPoint& cell, glm::vec3 normal, std::uint32_t surfel) const;
    std::uint32_t entryOf(const CellToOwn& cell) const {
        return cell.cell.index + (cell.back ? owners.cells() : 0);
    }
    void findBeside(std::span<CellToOwn> cells, std::span<std::uint32_t> owner) const;
    bool askOthers(std::span<const CellToOwn> cells, std::span<std::uint32_t> owner) const;
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

WorldPoint Patches::placeOf(const MeshPoint& point, bool back) const {
    return worldPoint(trace.scene(), trace.scene().instances[instance], point, back);
}

RaisedPoint Patches::raisedPoint(const MeshPoint& point, bool back, float height) const {
    ++rays;
    return raise(trace, placeOf(point, back), height);
}

bool Patches::onSameSide(const RaisedPoint& cell, glm::vec3 normal, std::uint32_t surfel) const {
    constexpr float kAlike = 0.5f; // cosine of 60 degrees
    ++rays;
    return clearAlong(trace, cell.position, raised[surfel], [&](const Hit& hit) {
        return hit.instance == instance && std::abs(glm::dot(hit.geometricNormal, normal)) > kAlike;
    });
}

/// Raises a place of each cell: its middle or, where that is covered, an open one closer to the
/// corners.
void Patches::raiseCells(std::span<CellToOwn> cells) const {
    constexpr std::array<glm::vec2, 4> kToCorners = {glm::vec2(-1), glm::vec2(1, -1),
                                                     glm::vec2(-1, 1), glm::vec2(1)};
    struct Top {
        CellToOwn* cell;
        glm::vec3 position;
    };
    RaysTogether<Top> up(trace, TraceMask::Static);
    const auto open = [](const Top& top) {
        if (top.cell->from.covered)
            top.cell->from = {top.position, false};
    };
    const auto look = [&](CellToOwn& cell, glm::vec2 uv) {
        const float height = heightOf(cell.surfel);
        const Ray ray = rayAbove(trace, placeOf({cell.triangle, uv}, cell.back), height);
        up.add(ray, {&cell, ray.origin + height * ray.direction}, open);
    };
    for (CellToOwn& cell : cells)
        look(cell, cell.cell.middle());
    up.flush(open);
    std::vector<CellToOwn*> covered;
    for (CellToOwn& cell : cells)
        if (cell.from.covered)
            covered.push_back(&cell);
    for (CellToOwn* cell : covered)
        for (const glm::vec2 corner : kToCorners)
            if (const glm::vec2 uv =
                    cell->cell.at(cell->cell.inside * (1.f + 2 * kToCorner * corner));
                isInTriangle(uv))
                look(*cell, uv);
    up.flush(open);
    rays += up.traced();
    for (CellToOwn* cell : covered)
        if (cell->from.covered)
            cell->from = raisedPoint(cell->middle(), cell->back, heightOf(cell->surfel));
}

/// Writes the surfels nearest to `cells` to `owner`, the entries of partedOwners(), where they lie
/// on the same side of all walls, as most do, and kBehind elsewhere. Rays are traced together.
void Patches::findBeside(std::span<CellToOwn> cells, std::span<std::uint32_t> owner) const {
    raiseCells(cells);
    RaysTogether<CellToOwn*> along(trace, TraceMask::Static);
    const auto isBeside = [&](CellToOwn* cell) { owner[entryOf(*cell)] = cell->surfel; };
    for (CellToOwn& cell : cells) {
        owner[entryOf(cell)] = kBehind;
        along.add(rayBetween(cell.from.position, raised[cell.surfel]), &cell, isBeside);
    }
    along.flush(isBeside);
    rays += along.traced();
}

/// Finds owners of the cells that are kBehind, one by one. Returns whether any is not the nearest
/// surfel.
bool Patches::askOthers(std::span<const CellToOwn> cells, std::span<std::uint32_t> owner) const {
    bool differs = false;
    for (const CellToOwn& cell : cells)
        if (std::uint32_t& surfel = owner[entryOf(cell)]; surfel == kBehind) {
            surfel = ownerAt(cell.middle(), cell.from, cell.surfel, cell.back);
            differs |= surfel != cell.surfel;
        }
    return differs;
}

/// The surfel on the same side of all walls as a point, which is raised to `from`: the nearest one,
/// or one of a few others, or the nearest again where all are behind walls.
std::uint32_t Patches::ownerAt(const MeshPoint& point, const RaisedPoint& from,
                               std::uint32_t nearestOwner, bool back) const {
    constexpr std::size_t kCompared = 8;
    const Scene& scene = trace.scene();
    // Surfels of both sides have the same places.
    const std::uint32_t first = back ? surfels().frontCount : 0;
    const glm::vec3 normal = worldPoint(scene, scene.instances[instance], point).normal;
    if (onSameSide(from, normal, nearestOwner))
        return nearestOwner;
    const Mesh& mesh = scene.meshOf(scene.instances[instance]);
    std::array<NearestPoint::Near, kCompared> near;
    const std::size_t count =
        nearest.findSome(trianglePoint(mesh, point.triangle, point.barycentric),
                         triangleNormal(mesh, point.triangle), near);
    for (std::size_t k = 0; k < count; ++k)
        if (first + near[k].point != nearestOwner &&
            onSameSide(from, normal, first + near[k].point))
            return first + near[k].point;
    return nearestOwner;
}

/// The owner of a part of a cell: that of the cell, unless a wall stands between the two.
std::uint32_t Patches::ownerOfPart(const MeshPoint& point, std::uint32_t ownerOfCell,
                                   bool back) const {
    const RaisedPoint from = raisedPoint(point, back, heightOf(ownerOfCell));
    if (from.covered)
        return ownerOfCell;
    return ownerAt(point, from, ownerOfCell, back);
}

/// A cell of a triangle that is smaller than a cell.
struct SmallCell {
    glm::ivec3 cube; ///< of a cell's size, from the surfel's place on
    std::uint32_t cell;

    bool isBefore(const SmallCell& c) const {
        return std::tuple(cube.x, cube.y, cube.z, cell) <
               std::tuple(c.cube.x, c.cube.y, c.cube.z, c.cell);
    }
};

/// The small cells of a mesh. Those of a front's surfel s are [begin[s], begin[s + 1]), cube after
/// cube. Both are empty where a mesh has few triangles for its surfels.
struct SmallCells {
    std::vector<std::uint32_t> begin;
    std::vector<SmallCell> cells;
};

SmallCells findSmallCells(const Patches& patches) {
    constexpr std::uint32_t kFew = 16;   // triangles for each surfel
    constexpr float kFarthest = 1 << 20; // cubes
    const SurfelOwners& owners = patches.owners;
    const Scene& scene = patches.trace.scene();
    const Instance& instance = scene.instances[patches.instance];
    const Mesh& mesh = scene.meshOf(instance);
    SmallCells result;
    if (mesh.triangleCount() / kFew < owners.frontCount())
        return result;
    const auto forSmall = [&](const auto& visit) {
        for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t)
            if (owners.isOneCell(t))
                owners.forCellsOf(t, [&](const SurfelOwners::Cell& cell) { visit(t, cell); });
    };
    std::vector<std::uint32_t>& begin = result.begin;
    begin.resize(owners.frontCount() + 1);
    forSmall([&](std::uint32_t, const auto& cell) { ++begin[owners.front(cell.index) + 1]; });
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    result.cells.resize(begin.back());
    std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
    const Surfels& surfels = patches.set.surfels;
    const std::uint32_t first = patches.set.instanceBegin[patches.instance];
    forSmall([&](std::uint32_t t, const SurfelOwners::Cell& cell) {
        const std::uint32_t s = owners.front(cell.index);
        const glm::vec3 place =
            instance.toWorld * glm::vec4(trianglePoint(mesh, t, cell.middle()), 1);
        const float size = std::sqrt(surfels.area[first + s]) / SurfelOwners::kCellsPerSpacing;
        const glm::vec3 cube = glm::floor((place - surfels.position[first + s]) / size);
        result.cells[next[s]++] = {glm::ivec3(glm::clamp(cube, -kFarthest, kFarthest)), cell.index};
    });
    parallelRanges(owners.frontCount(), 64, [&](std::size_t from, std::size_t to) {
        const auto all = result.cells.begin();
        for (std::size_t s = from; s < to; ++s)
            std::sort(all + begin[s], all + begin[s + 1],
                      [](const SmallCell& a, const SmallCell& b) { return a.isBefore(b); });
    });
    return result;
}

/// Writes the entries of `owner` for which `wanted(entry)` is true: the surfel nearest to the cell
/// or, where a wall stands between the two, another one on the cell's side if `ask`, else kBehind.
/// Returns whether another one was written.
template <class Wanted>
bool ownCells(const Patches& patches, const Progress& progress, bool ask, const Wanted& wanted,
              std::vector<std::uint32_t>& owner) {
    constexpr std::size_t kTogether = 1024;
    const Scene& scene = patches.trace.scene();
    const SurfelOwners& owners = patches.owners;
    const std::uint32_t backs = patches.surfels().frontCount,
                        sides = std::uint32_t(owner.size() / owners.cells());
    std::atomic<bool> differs = false;
    owners.forTriangles(scene.meshOf(scene.instances[patches.instance]), progress,
                        [&](std::uint32_t begin, std::uint32_t end) {
                            std::vector<CellToOwn> cells;
                            const auto finish = [&] {
                                patches.findBeside(cells, owner);
                                if (ask && patches.askOthers(cells, owner))
                                    differs = true;
                                cells.clear();
                            };
                            for (std::uint32_t side = 0; side < sides; ++side)
                                for (std::uint32_t t = begin; t < end; ++t)
                                    owners.forCellsOf(t, [&](const SurfelOwners::Cell& cell) {
                                        if (!wanted(cell.index + side * owners.cells()))
                                            return;
                                        cells.push_back({cell, t,
                                                         side * backs + owners.front(cell.index),
                                                         side == 1});
                                        if (cells.size() == kTogether)
                                            finish();
                                    });
                            finish();
                        });
    return differs;
}

/// By entry of `owner`, the one that is asked for it, of those that are kBehind; kNone for others.
/// Small cells of one cube and side ask once.
std::vector<std::uint32_t> askedFor(const SmallCells& small, std::uint32_t cells,
                                    const std::vector<std::uint32_t>& owner) {
    std::vector<std::uint32_t> asked(owner.size(), kNone);
    for (std::uint32_t k = 0; k < owner.size(); ++k)
        if (owner[k] == kBehind)
            asked[k] = k;
    for (std::uint32_t side = 0; side < owner.size() / cells; ++side)
        for (std::size_t s = 0; s + 1 < small.begin.size(); ++s) {
            const SmallCell* before = nullptr; // the latest of its cube that is behind a wall
            for (std::uint32_t k = small.begin[s]; k < small.begin[s + 1]; ++k) {
                const SmallCell& c = small.cells[k];
                const std::uint32_t entry = c.cell + side * cells;
                if (owner[entry] != kBehind)
                    continue;
                if (before && before->cube == c.cube)
                    asked[entry] = asked[before->cell + side * cells];
                before = &c;
            }
        }
    return asked;
}

/// Owners of all cells, fronts first; empty where no wall splits any patch.
std::vector<std::uint32_t> partedOwners(const Patches& patches, const Progress& progress) {
    const Scene& scene = patches.trace.scene();
    const std::uint32_t sides = isTwoSided(scene, scene.instances[patches.instance]) ? 2 : 1,
                        cells = patches.owners.cells();
    std::vector<std::uint32_t> result(std::size_t(cells) * sides);
    // Cells that no place lies in stay with the first surfel of their side.
    std::fill(result.begin() + cells, result.end(), patches.surfels().frontCount);
    const SmallCells small = findSmallCells(patches);
    const auto all = [](std::uint32_t) { return true; };
    bool differs = ownCells(patches, progress, small.cells.empty(), all, result);
    if (!small.cells.empty()) {
        const std::vector<std::uint32_t> asked = askedFor(small, cells, result);
        const auto asks = [&](std::uint32_t entry) { return asked[entry] == entry; };
        differs = ownCells(patches, progress, true, asks, result);
        for (std::uint32_t k = 0; k < asked.size(); ++k)
            if (asked[k] != kNone)
                result[k] = result[asked[k]];
    }
    return differs ? std::move(result) : std::vector<std::uint32_t>();
}

/// By two indices into MeshSurfels, the smaller one first: whether no wall stands between them.
using PairsOnSameSide = std::map<std::pair<std::uint32_t, std::uint32_t>, bool>;

/// Barycentrics of a place of the cell that lies `step` [cells] from another; none where that cell
/// hardly meets the triangle.
std::optional<glm::vec2> placeBeside(const SurfelOwners::Cell& cell, glm::vec2 step) {
    // A cell that the triangle cuts has its share of it near its first corner.
    for (const float from : {1.f, 0.5f, 0.25f, 0.125f})
        if (const glm::vec2 uv = cell.at(step + from * cell.inside); isInTriangle(uv))
            return uv;
    return {};
}

/// Whether a wall may cross a cell: a wall stands between its owner and that of a cell beside it on
/// the triangle. Answers for pairs of owners are kept in `pairs`.
bool mayBeCrossed(const Patches& patches, const std::vector<std::uint32_t>& owner,
                  std::uint32_t triangle, const SurfelOwners::Cell& cell, bool back,
                  PairsOnSameSide& pairs) {
    const SurfelOwners& owners = patches.owners;
    const std::uint32_t side = back ? owners.cells() : 0, surfel = owner[side + cell.index];
    const Surfels& s = patches.set.surfels;
    const std::uint32_t first = patches.set.instanceBegin[patches.instance];
    const auto isParted = [&](glm::vec2 step) {
        const std::optional<glm::vec2> uv = placeBeside(cell, step);
        const std::uint32_t beside =
            uv ? owner[side + owners.cellAt(triangle, uv->x, uv->y).cell] : surfel;
        if (beside == surfel)
            return false;
        const auto [pair, isNew] = pairs.try_emplace(std::minmax(surfel, beside));
        if (isNew)
            pair->second =
                patches.onSameSide({patches.raised[pair->first.first], false},
                                   s.normal[first + pair->first.first], pair->first.second);
        return !pair->second;
    };
    return isParted({1, 0}) || isParted({-1, 0}) || isParted({0, 1}) || isParted({0, -1}) ||
           // A cell that the triangle cuts may have none beyond it on its row or column.
           (cell.inside < 0.5f && (isParted({1, -1}) || isParted({-1, 1})));
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
        const auto ownerAt = [&](glm::vec2 place) {
            const glm::vec2 uv = cell.at(place);
            return isInTriangle(uv) ? patches.ownerOfPart({t, uv}, surfel, back) : surfel;
        };
        bool crossed = false;
        for (const float x : {0.5f - kToCorner, 0.5f + kToCorner})
            for (const float y : {0.5f - kToCorner, 0.5f + kToCorner})
                crossed = crossed || ownerAt({x, y}) != surfel;
        if (!crossed)
            return;
        Parts parts;
        for (std::uint32_t k = 0; k < kParts; ++k)
            parts[k] = ownerAt((glm::vec2(float(k % kAcross), float(k / kAcross)) + 0.5f) /
                               float(kAcross));
        if (std::ranges::count(parts, surfel) == std::ptrdiff_t(kParts))
            return;
        const std::lock_guard lock(mutex);
        found.emplace(entry, parts);
    };
    owners.forTriangles(scene.meshOf(instance), progress,
                        [&](std::uint32_t begin, std::uint32_t end) {
                            for (std::uint32_t t = begin; t < end; ++t) {
                                if (owners.isOneCell(t))
                                    continue;
                                PairsOnSameSide pairs;
                                owners.forCellsOf(t, [&](const SurfelOwners::Cell& cell) {
                                    for (const bool back : {false, true})
                                        if ((!back || twoSided) &&
                                            mayBeCrossed(patches, owner, t, cell, back, pairs))
                                            split(t, cell, back);
                                });
                            }
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
