// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/mesh/bounds.h"

#include <array>
#include <cstdint>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// The eight cells of a grid whose centres surround a point. Beyond the outermost centres, and
/// along an axis of one cell, some of them are the same.
struct CellsAbout {
    std::array<glm::uvec3, 8> cell;     ///< the lowest bit of the position in the array is along x
    std::array<std::uint32_t, 8> index; ///< of the same cells: x fastest, then y, then z
    glm::vec3 f{0}; ///< share of the way from the first cell's centre to the last one's, [0, 1]
};

/// `size`: number of cells along each axis, at least 1.
inline CellsAbout cellsAbout(const Bounds& bounds, glm::uvec3 size, glm::vec3 p) {
    const glm::vec3 cells(size);
    const glm::vec3 x =
        glm::clamp((p - bounds.lower) / bounds.size() * cells - 0.5f, glm::vec3(0), cells - 1.f);
    const glm::uvec3 base = glm::min(glm::uvec3(x), glm::max(size, glm::uvec3(2)) - 2U);
    CellsAbout about{.cell = {}, .index = {}, .f = x - glm::vec3(base)};
    for (std::uint32_t k = 0; k < 8; ++k) {
        const glm::uvec3 cell = glm::min(base + glm::uvec3(k & 1, k >> 1 & 1, k >> 2), size - 1U);
        about.cell[k] = cell;
        about.index[k] = (cell.z * size.y + cell.y) * size.x + cell.x;
    }
    return about;
}

} // namespace limn
