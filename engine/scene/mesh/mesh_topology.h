// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/scene/mesh/mesh.h"
#include "engine/scene/mesh/triangle_geometry.h"

#include <cstdint>
#include <vector>

namespace limn {

/// Joins vertices of equal position (and of equal uv1 if `byUv1`). Returns the new number of each
/// vertex, counted from 0 in the order of first use. Incomplete when cancelled.
std::vector<std::uint32_t> weldVertices(const Mesh& mesh, bool byUv1,
                                        const Progress& progress = {});

inline constexpr std::uint32_t kNoEdge = ~0U;

/// Partner of every half-edge. Half-edge 3 t + k runs from corner k of triangle t to the next
/// corner; its partner runs the other way between vertices of the same positions. kNoEdge marks a
/// border, an edge of more than two triangles, or an edge of two triangles with opposite winding.
/// Incomplete when cancelled.
std::vector<std::uint32_t> edgePartners(const Mesh& mesh, const Progress& progress = {});

/// The point at fraction `s`, in [0, 1], along half-edge `e`, from its first corner.
MeshPoint pointOfEdge(std::uint32_t e, float s);

} // namespace limn
