// SPDX-License-Identifier: MIT
#pragma once

#include "engine/export/sh_conventions.h"
#include "engine/field/indirect_field.h"

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// Maximum number of probes; a grid with more cells is thinned.
inline constexpr std::uint32_t kMaxGodotProbes = 32768;

/// The probes of a LightmapGIData of Godot 4: points in tetrahedra, and a tree of planes that finds
/// the tetrahedron of a position.
struct GodotProbes {
    struct Node {
        std::array<float, 4> plane; ///< normal, and its dot product with points of the plane
        /// Where positions on the normal's side go on, and the others: the index of a node, or -1 -
        /// that of a tetrahedron.
        std::int32_t over = 0, under = 0;
    };
    std::vector<glm::vec3> points; ///< [m], in the file's coordinates
    std::vector<Sh3> harmonics;    ///< as of godotProbe(), one for each point
    std::vector<std::array<std::uint32_t, 4>> tetrahedra; ///< of points
    std::vector<Node> nodes;                              ///< the root is the first
    glm::vec3 lower{0}, upper{0};                         ///< bounds of the points
};

/// Probes at the centres of the grid's cells, with five tetrahedra between each eight neighbours.
/// Of an axis with a single cell, its two borders are the probes. Positions are moved by `origin`.
/// Precondition: the field has a grid.
GodotProbes godotProbes(const IndirectField& field, glm::vec3 origin);

} // namespace limn
