// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/parallel.h"
#include "engine/scene/mesh/triangle_geometry.h"
#include "engine/techniques/illuminance/bake/senders/owner_tables.h"

#include <cstdint>

namespace limn {

/// A parallelogram of barycentrics on one side of a triangle that belongs to one surfel: a cell of
/// the mesh's SurfelOwners or, where a wall crosses that, a part of it. The triangle may cut it.
struct OwnedCell {
    std::uint32_t surfel, triangle;
    bool back;                    ///< of the two sides of the triangle
    glm::vec2 origin, across, up; ///< (u, v) of a corner, and the sides from there
    glm::vec2 middle; ///< (u, v) of the middle of what lies in the triangle, or of the cell's
    double area;      ///< of its share of the triangle [m^2]
};

/// Calls visit(OwnedCell) for the cells of an instance, once for each lit side.
template <class Visit>
void forOwnedCells(const Scene& scene, const OwnerTables& owners, std::uint32_t instance,
                   const Visit& visit) {
    const Instance& placed = scene.instances[instance];
    const std::uint32_t sides = isTwoSided(scene, placed) ? 2 : 1;
    for (std::uint32_t t = 0; t < scene.meshOf(placed).triangleCount(); ++t) {
        const auto area = double(triangleWorldArea(scene, placed, t));
        owners.tableOf(placed.mesh).forCellsOf(t, [&](const SurfelOwners::Cell& c) {
            for (std::uint32_t back = 0; back < sides; ++back) {
                const bool split = owners.isSplit(instance, c.index, back != 0);
                const std::uint32_t parts = split ? SurfelOwners::kAcross : 1;
                for (std::uint32_t part = 0; part < parts * parts; ++part) {
                    const glm::vec2 corner = glm::vec2(part % parts, part / parts) / float(parts),
                                    middle = c.at(corner + 0.5f / float(parts));
                    const bool holds = split && isInTriangle(middle);
                    visit(OwnedCell{owners.ofCell(instance, {c.index, part}, back != 0), t,
                                    back != 0, c.at(corner), c.across / float(parts),
                                    c.up / float(parts), holds ? middle : c.middle(),
                                    c.share * area / (parts * parts)});
                }
            }
        });
    }
}

/// Calls visit(instance), in parallel, for the instances that have surfels.
template <class Visit>
void forSenders(const Scene& scene, const SurfelSet& set, const Visit& visit) {
    parallelRanges(scene.instances.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (auto i = std::uint32_t(begin); i < end; ++i)
            if (set.instanceBegin[i] < set.instanceBegin[i + 1])
                visit(i);
    });
}

} // namespace limn
