// SPDX-License-Identifier: MIT
#include "engine/lattice/lattice.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

namespace limn {

glm::uvec3 Lattice::at(glm::vec3 p) const {
    const glm::vec3 x = (p - lower) / cell;
    return glm::uvec3(glm::clamp(x, glm::vec3(0), glm::vec3(size) - 0.5f));
}

Lattice latticeOver(const Bounds& box, std::uint32_t longest) {
    const glm::vec3 extent = box.size();
    const float maxExtent = std::max({extent.x, extent.y, extent.z});
    Lattice lattice{.cell = maxExtent > 0 ? maxExtent / float(longest) : 1};
    for (int axis = 0; axis < 3; ++axis) {
        // Rounding must not add a cell to a side of a whole number of cells.
        const auto whole = std::uint32_t(std::ceil(extent[axis] / lattice.cell - 1e-3f));
        lattice.size[axis] = std::clamp(whole, 2U, longest);
    }
    lattice.lower = box.centre() - glm::vec3(lattice.size) * (lattice.cell * 0.5f);
    return lattice;
}

Lattice cornersOf(const Lattice& lattice) {
    return {lattice.lower - lattice.cell * 0.5f, lattice.cell, lattice.size + 1U};
}

} // namespace limn
