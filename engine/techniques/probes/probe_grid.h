// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/mesh/bounds.h"

#include <cstdint>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// Probes in the middles of equal cells that fill a box, in the order of IndirectField::grid.
struct ProbeGrid {
    Bounds bounds;
    glm::uvec3 size{0}; ///< number of probes along each axis; 0: none

    std::uint32_t count() const { return size.x * size.y * size.z; }
    glm::vec3 step() const { return bounds.size() / glm::vec3(size); } ///< [m]
    glm::vec3 position(std::uint32_t probe) const {
        const glm::uvec3 cell(probe % size.x, probe / size.x % size.y, probe / size.x / size.y);
        return bounds.lower + (glm::vec3(cell) + 0.5f) * step();
    }
    bool operator==(const ProbeGrid&) const = default;
};

/// About `wanted` probes with nearly equal steps along all axes, over `bounds`. A box that is
/// thinner than a step gets a layer of probes on each of its sides. Returns no probes for a box
/// without any extent.
ProbeGrid chooseProbes(const Bounds& bounds, std::uint32_t wanted);

} // namespace limn
