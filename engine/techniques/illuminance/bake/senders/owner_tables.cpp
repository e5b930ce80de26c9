// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/senders/owner_tables.h"

#include "engine/core/parallel.h"
#include "engine/scene/mesh/input_hash.h"
#include "engine/scene/mesh/triangle_geometry.h"
#include "engine/stages/stage_archive.h"
#include "engine/stages/stage_keys.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <tbb/task_arena.h>

namespace limn {

const SurfelOwners& OwnerTables::tableOf(std::uint32_t mesh) const {
    Lazy& lazy = m_tables[mesh];
    std::call_once(lazy.once, [&] {
        // Isolated: a thread that waits for its helpers must not begin another cache and come back
        // here.
        tbb::this_task_arena::isolate([&] {
            const Mesh& m = m_scene.assets->meshes[mesh];
            const std::size_t cells = m.triangleCount() + 9 * m_set.meshes[mesh].size();
            constexpr std::size_t kWorthKeeping = 2048; // smaller ones are as fast to rebuild
            lazy.owners = keptOrMade<SurfelOwners>(
                cells < kWorthKeeping ? nullptr : m_store,
                stageKey(Stage::SurfelOwners, m_store ? m_keys[mesh] : 0), m_progress,
                [&](auto& a, auto& o) { SurfelOwners::fields(a, o, m, m_set.meshes[mesh]); },
                [&] { return SurfelOwners(m, m_set.meshes[mesh], m_progress); });
        });
    });
    return lazy.owners;
}

/// Calls visit(surfel, triangle, uv of its middle, area [m^2]) for the cells of an instance, once
/// for each lit side.
template <class Visit>
static void forOwnedCells(const Scene& scene, const OwnerTables& owners, std::uint32_t instance,
                          const Visit& visit) {
    const Instance& placed = scene.instances[instance];
    const std::uint32_t sides = isTwoSided(scene.materialOf(placed)) ? 2 : 1;
    for (std::uint32_t t = 0; t < scene.meshOf(placed).triangleCount(); ++t) {
        const auto area = double(triangleWorldArea(scene, placed, t));
        owners.tableOf(placed.mesh).forCellsOf(t, [&](const SurfelOwners::Cell& c) {
            for (std::uint32_t back = 0; back < sides; ++back) {
                const std::uint32_t parts =
                    owners.isSplit(instance, c.index, back != 0) ? SurfelOwners::kParts : 1;
                for (std::uint32_t part = 0; part < parts; ++part)
                    visit(owners.ofCell(instance, {c.index, part}, back != 0), t, c.middle,
                          c.share * area / parts);
            }
        });
    }
}

/// Calls visit(instance), in parallel, for the instances that have surfels.
template <class Visit>
static void forSenders(const Scene& scene, const SurfelSet& set, const Visit& visit) {
    parallelRanges(scene.instances.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (auto i = std::uint32_t(begin); i < end; ++i)
            if (set.instanceBegin[i] < set.instanceBegin[i + 1])
                visit(i);
    });
}

std::vector<float> ownedAreas(const Scene& scene, const SurfelSet& set, const OwnerTables& owners) {
    std::vector<float> result(set.surfels.size());
    forSenders(scene, set, [&](std::uint32_t instance) {
        const std::uint32_t first = set.instanceBegin[instance];
        std::vector<double> sum(set.instanceBegin[instance + 1] - first);
        forOwnedCells(scene, owners, instance,
                      [&](std::uint32_t surfel, std::uint32_t, glm::vec2, double area) {
                          sum[surfel - first] += area;
                      });
        for (std::size_t s = 0; s < sum.size(); ++s)
            result[first + s] = std::max(float(sum[s]), 1e-30f);
    });
    return result;
}

/// Mean squared distance of a triangle's area from its centroid [m^2, world].
static double secondMoment(const Scene& scene, const Instance& instance, std::uint32_t triangle) {
    const Mesh& mesh = scene.meshOf(instance);
    const std::array<std::uint32_t, 3> corner = mesh.triangle(triangle);
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const glm::vec3 edge = mesh.positions[corner[(k + 1) % 3]] - mesh.positions[corner[k]];
        const glm::vec3 placed = glm::mat3(instance.toWorld) * edge;
        sum += double(glm::dot(placed, placed));
    }
    return sum / 36;
}

std::vector<float> lampExtents(const Scene& scene, const SurfelSet& set,
                               const OwnerTables& owners) {
    std::vector<float> result(set.surfels.size());
    forSenders(scene, set, [&](std::uint32_t instance) {
        const Instance& placed = scene.instances[instance];
        if (!emits(scene.materialOf(placed)))
            return;
        const std::uint32_t first = set.instanceBegin[instance];
        struct Moments {
            double area = 0, squared = 0;
        };
        std::vector<Moments> moments(set.instanceBegin[instance + 1] - first);
        forOwnedCells(scene, owners, instance,
                      [&](std::uint32_t surfel, std::uint32_t t, glm::vec2 uv, double area) {
                          const glm::vec3 away =
                              glm::vec3(placed.toWorld *
                                        glm::vec4(trianglePoint(scene.meshOf(placed), t, uv), 1)) -
                              set.surfels.position[surfel];
                          const double whole = double(triangleWorldArea(scene, placed, t));
                          const double share = whole > 0 ? area / whole : 0;
                          Moments& m = moments[surfel - first];
                          m.area += area;
                          m.squared += area * (double(glm::dot(away, away)) +
                                               share * secondMoment(scene, placed, t));
                      });
        for (std::size_t s = 0; s < moments.size(); ++s)
            if (moments[s].area > 0)
                result[first + s] = float(std::sqrt(moments[s].squared / moments[s].area));
    });
    return result;
}

} // namespace limn
