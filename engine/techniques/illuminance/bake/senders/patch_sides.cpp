// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/senders/patch_sides.h"

#include "engine/core/hash.h"
#include "engine/core/parallel.h"
#include "engine/math/nearest_point.h"
#include "engine/scene/mesh/triangle_geometry.h"
#include "engine/techniques/illuminance/bake/receivers/cache_points.h"
#include "engine/techniques/illuminance/bake/senders/owner_tables.h"
#include "engine/trace/clear_along.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr float kHeight = 0.25f; ///< above the surface at which segments run [spacings]

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
    RaisedPoint raisedCell(const MeshPoint& middle, float size, bool back, float height) const;
    bool together(const RaisedPoint& cell, glm::vec3 normal, std::uint32_t surfel) const;
    std::uint32_t ownerOf(const MeshPoint& middle, float size, std::uint32_t nearestOwner,
                          bool back) const;
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

/// A place of a cell: its middle or, where that is covered, one closer to the corners that is not.
RaisedPoint Patches::raisedCell(const MeshPoint& middle, float size, bool back,
                                float height) const {
    constexpr std::array<glm::vec2, 5> kPlaces = {glm::vec2(0), glm::vec2(-1), glm::vec2(1, -1),
                                                  glm::vec2(-1, 1), glm::vec2(1)};
    constexpr float kToCorner = 0.45f; // [cells]
    const Scene& scene = trace.scene();
    std::optional<RaisedPoint> first;
    for (const glm::vec2 place : kPlaces) {
        const glm::vec2 uv = middle.barycentric + place * (kToCorner * size);
        if (uv.x + uv.y > 1)
            continue;
        WorldPoint p = worldPoint(scene, scene.instances[instance], {middle.triangle, uv});
        if (back)
            p.normal = -p.normal;
        ++rays;
        const RaisedPoint point = raise(trace, p, height);
        if (!point.covered)
            return point;
        if (!first)
            first = point;
    }
    return *first;
}

bool Patches::together(const RaisedPoint& cell, glm::vec3 normal, std::uint32_t surfel) const {
    constexpr float kAlike = 0.5f; // cosine of 60 degrees
    ++rays;
    return clearAlong(trace, cell.position, raised[surfel], [&](const Hit& hit) {
        return hit.instance == instance && std::abs(glm::dot(hit.geometricNormal, normal)) > kAlike;
    });
}

std::uint32_t Patches::ownerOf(const MeshPoint& middle, float size, std::uint32_t nearestOwner,
                               bool back) const {
    constexpr std::size_t kCompared = 8;
    const Scene& scene = trace.scene();
    const std::uint32_t first = back ? surfels().frontCount : 0;
    const RaisedPoint cell = raisedCell(middle, size, back, heightOf(first + nearestOwner));
    const glm::vec3 normal = worldPoint(scene, scene.instances[instance], middle).normal;
    if (together(cell, normal, first + nearestOwner))
        return first + nearestOwner;
    const Mesh& mesh = scene.meshOf(scene.instances[instance]);
    std::array<NearestPoint::Near, kCompared> near;
    const std::size_t count =
        nearest.findSome(trianglePoint(mesh, middle.triangle, middle.barycentric),
                         triangleNormal(mesh, middle.triangle), near);
    for (std::size_t k = 0; k < count; ++k)
        if (near[k].point != nearestOwner && together(cell, normal, first + near[k].point))
            return first + near[k].point;
    return first + nearestOwner;
}

/// Owners of all cells, fronts first; empty where no wall splits any patch.
std::vector<std::uint32_t> partedOwners(const Patches& patches, const Progress& progress) {
    const Scene& scene = patches.trace.scene();
    const Instance& instance = scene.instances[patches.instance];
    const Mesh& mesh = scene.meshOf(instance);
    const SurfelOwners& owners = patches.owners;
    const std::uint32_t sides = isTwoSided(scene.materialOf(instance)) ? 2 : 1;
    std::vector<std::uint32_t> result(std::size_t(owners.cells()) * sides);
    // Cells that no place lies in stay with the first surfel of their side.
    std::fill(result.begin() + owners.cells(), result.end(), patches.surfels().frontCount);
    std::atomic<bool> differs = false;
    owners.forTriangles(mesh, progress, [&](std::uint32_t t) {
        for (std::uint32_t side = 0; side < sides; ++side) {
            const std::uint32_t first = side * patches.surfels().frontCount;
            owners.forCellsOf(t, [&](std::uint32_t cell, glm::vec2 uv, double share) {
                const auto size = float(std::sqrt(share / 2)); // smaller where it is cut
                const std::uint32_t near = owners.front(cell),
                                    own = patches.ownerOf({t, uv * 0.999f}, size, near, side == 1);
                result[side * owners.cells() + cell] = own;
                if (own != first + near)
                    differs = true;
            });
        }
    });
    return differs ? std::move(result) : std::vector<std::uint32_t>();
}

/// Adds the reassigned cells of an instance to the hashes of their old and new surfels.
void noteChanges(const SurfelOwners& owners, const MeshSurfels& surfels, std::uint32_t first,
                 const std::vector<std::uint32_t>& parted, std::vector<std::uint64_t>& changed) {
    for (std::uint32_t c = 0; c < parted.size(); ++c) {
        const bool back = c >= owners.cells();
        const std::uint32_t before =
            owners.front(back ? c - owners.cells() : c) + (back ? surfels.frontCount : 0);
        if (parted[c] == before)
            continue;
        for (const std::uint32_t s : {before, parted[c]})
            changed[first + s] = hashValue(c, hashValue(parted[c], changed[first + s] + 1));
    }
}

} // namespace

PatchSides findPatchSides(const TraceScene& trace, const SurfelSet& set, const OwnerTables& owners,
                          const Progress& progress) {
    const Scene& scene = trace.scene();
    PatchSides result;
    result.owner.resize(scene.instances.size());
    std::atomic<std::uint64_t> rays = 0;
    parallelRanges(scene.instances.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (auto i = std::uint32_t(begin); i < end && !progress.cancelled(); ++i) {
            const std::uint32_t mesh = scene.instances[i].mesh;
            const MeshSurfels& surfels = set.meshes[mesh];
            if (set.instanceBegin[i] == set.instanceBegin[i + 1] || surfels.frontCount < 2)
                continue;
            const NearestPoint nearest(std::span(surfels.position.data(), surfels.frontCount),
                                       std::span(surfels.normal.data(), surfels.frontCount),
                                       std::sqrt(std::max(surfels.area, 1e-30f)));
            Patches patches{trace, set, owners.of(mesh), i, nearest, rays};
            patches.raiseSurfels();
            result.owner[i] = partedOwners(patches, progress);
        }
    });
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        if (result.owner[i].empty())
            continue;
        const std::uint32_t mesh = scene.instances[i].mesh;
        result.changed.resize(set.surfels.size());
        noteChanges(owners.of(mesh), set.meshes[mesh], set.instanceBegin[i], result.owner[i],
                    result.changed);
    }
    result.rays = rays;
    return result;
}

} // namespace limn
