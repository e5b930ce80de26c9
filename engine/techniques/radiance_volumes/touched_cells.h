// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lattice/lattice.h"
#include "engine/scene/scene.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// A bit for each cell of a lattice, in its order.
struct CellBits {
    std::vector<std::uint64_t> words;

    explicit CellBits(std::size_t cells = 0) : words((cells + 63) / 64, 0) {}
    bool test(std::size_t cell) const { return words[cell / 64] >> (cell % 64) & 1; }
    std::size_t count() const;
    bool operator==(const CellBits&) const = default;
};

/// Share of a cell's side by which surfaces reach further, so that rounding misses no cell.
inline constexpr float kTouchMargin = 1e-3f;

/// Calls visit(cell) for each cell that a triangle touches; none outside the lattice. Each column
/// of cells along the axis that the triangle faces is tested in the plane across it, and visited
/// over the triangle's range of depths there. Schwarz, Seidel. Fast Parallel Surface and Solid
/// Voxelization on GPUs. 2010.
void visitTouchedCells(const Lattice& lattice, const std::array<glm::vec3, 3>& corners,
                       const std::function<void(glm::uvec3 cell)>& visit);

/// The corners of a triangle in the world.
std::array<glm::vec3, 3> cornersOf(const Scene& scene, const Instance& instance,
                                   std::uint32_t triangle);

/// The cells that the scene's surfaces touch. Holes of cutouts count as solid.
CellBits touchedCells(const Scene& scene, const Lattice& lattice);

} // namespace limn
