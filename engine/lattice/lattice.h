// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/mesh/bounds.h"

#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

namespace limn {

/// Cubic cells that fill an axis-parallel box.
struct Lattice {
    glm::vec3 lower{0}; ///< [m]
    float cell = 1;     ///< side of a cell [m], > 0
    glm::uvec3 size{1}; ///< number of cells, each >= 1

    std::size_t cells() const { return std::size_t(size.x) * size.y * size.z; }
    Bounds bounds() const { return {lower, lower + glm::vec3(size) * cell}; }
    glm::vec3 centre(glm::uvec3 c) const { return lower + (glm::vec3(c) + 0.5f) * cell; }
    std::uint32_t index(glm::uvec3 c) const { return (c.z * size.y + c.y) * size.x + c.x; }
    glm::uvec3 place(std::uint32_t index) const {
        return {index % size.x, index / size.x % size.y, index / size.x / size.y};
    }
    /// The cell that contains a point; the closest one for a point outside.
    glm::uvec3 at(glm::vec3 p) const;
    bool operator==(const Lattice&) const = default;
};

/// The lattice around a box with `longest` cells (>= 2) along its longest side, which it fills
/// exactly: the faces of a room there are faces of cells. Along the others it is longer than the
/// box by less than a cell, half of that on each side. A box without extent has cells of 1 m.
Lattice latticeOver(const Bounds& box, std::uint32_t longest);

/// The lattice of the cells' corners: shifted by half a cell, with one more cell along each axis.
Lattice cornersOf(const Lattice& lattice);

} // namespace limn
