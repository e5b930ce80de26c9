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

#include <glm/geometric.hpp>

namespace limn {

namespace {

/// The patches of one instance.
struct Patches {
    const TraceScene& trace;
    const SurfelSet& set;
    const SurfelOwners& owners;
    std::uint32_t instance;
    const NearestPoint& nearest;
    std::atomic<std::uint64_t>& rays;

    const MeshSurfels& surfels() const {
        return set.meshes[trace.scene().instances[instance].mesh];
    }
    bool together(const WorldPoint& cell, std::uint32_t surfel) const;
    std::uint32_t ownerOf(std::uint32_t triangle, glm::vec2 uv, std::uint32_t nearestOwner,
                          bool back) const;
};

bool Patches::together(const WorldPoint& cell, std::uint32_t surfel) const {
    constexpr float kHeight = 0.25f, kAlike = 0.5f; // [spacings]; cosine of 60 degrees
    const std::uint32_t s = set.instanceBegin[instance] + surfel;
    const glm::vec3 normal = set.surfels.normal[s];
    const float height = kHeight * std::sqrt(set.surfels.area[s]);
    ++rays;
    return clearAlong(trace, trace.clearOf(cell.position, cell.normal) + cell.normal * height,
                      trace.clearOf(set.surfels.position[s], normal) + normal * height,
                      [&](const Hit& hit) {
                          return hit.instance == instance &&
                                 std::abs(glm::dot(hit.geometricNormal, cell.normal)) > kAlike;
                      });
}

std::uint32_t Patches::ownerOf(std::uint32_t triangle, glm::vec2 uv, std::uint32_t nearestOwner,
                               bool back) const {
    constexpr std::size_t kCompared = 8;
    const Scene& scene = trace.scene();
    const std::uint32_t first = back ? surfels().frontCount : 0;
    WorldPoint cell = worldPoint(scene, scene.instances[instance], {triangle, uv});
    if (back)
        cell.normal = -cell.normal;
    if (together(cell, first + nearestOwner))
        return first + nearestOwner;
    const Mesh& mesh = scene.meshOf(scene.instances[instance]);
    std::array<NearestPoint::Near, kCompared> near;
    const std::size_t count =
        nearest.findSome(trianglePoint(mesh, triangle, uv), triangleNormal(mesh, triangle), near);
    for (std::size_t k = 0; k < count; ++k)
        if (near[k].point != nearestOwner && together(cell, first + near[k].point))
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
    parallelRanges(mesh.triangleCount(), 64, [&](std::size_t begin, std::size_t end) {
        for (auto t = std::uint32_t(begin); t < end && !progress.cancelled(); ++t) {
            for (std::uint32_t side = 0; side < sides; ++side) {
                const std::uint32_t first = side * patches.surfels().frontCount;
                owners.forCellsOf(t, [&](std::uint32_t cell, glm::vec2 uv, double) {
                    const std::uint32_t near = owners.front(cell),
                                        own = patches.ownerOf(t, uv * 0.999f, near, side == 1);
                    result[side * owners.cells() + cell] = own;
                    if (own != first + near)
                        differs = true;
                });
            }
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
    for (std::uint32_t i = 0; i < scene.instances.size() && !progress.cancelled(); ++i) {
        const std::uint32_t mesh = scene.instances[i].mesh;
        const MeshSurfels& surfels = set.meshes[mesh];
        if (set.instanceBegin[i] == set.instanceBegin[i + 1] || surfels.frontCount < 2)
            continue;
        const NearestPoint nearest(std::span(surfels.position.data(), surfels.frontCount),
                                   std::span(surfels.normal.data(), surfels.frontCount),
                                   std::sqrt(std::max(surfels.area, 1e-30f)));
        result.owner[i] = partedOwners({trace, set, owners.of(mesh), i, nearest, rays}, progress);
        if (result.owner[i].empty())
            continue;
        result.changed.resize(set.surfels.size());
        noteChanges(owners.of(mesh), surfels, set.instanceBegin[i], result.owner[i],
                    result.changed);
    }
    result.rays = rays;
    return result;
}

} // namespace limn
