// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/scene/mesh/mesh.h"

#include <cstdint>
#include <vector>

namespace limn {

/// Number of each vertex after joining those at equal position (and equal uv1 when asked), from 0
/// in the order of first use. Incomplete when cancelled.
std::vector<std::uint32_t> weldVertices(const Mesh& mesh, bool byUv1,
                                        const Progress& progress = {});

inline constexpr std::uint32_t kNoEdge = ~0U;

/// Half-edge 3 t + k runs from corner k of triangle t to the next. Its partner is the half-edge
/// that runs the other way between vertices of the same positions. kNoEdge: a border, an edge of
/// more than two triangles, or one of two triangles wound against each other. Incomplete when
/// cancelled.
std::vector<std::uint32_t> edgePartners(const Mesh& mesh, const Progress& progress = {});

} // namespace limn
