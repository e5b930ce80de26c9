// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/mesh/mesh.h"
#include "engine/scene/surface/material.h"

#include <cstdint>
#include <span>
#include <vector>

namespace limn {

/// Joins triangles that lie back to back: the same corners in the opposite order, with opposite
/// normals, and the same colours and TEXCOORD_0. Files without two-sided materials have them, as
/// our own exports do, whose two sides have texels of their own; each would hide the other. Of
/// each pair the first stays and becomes two-sided, by a variant of its material at the end of
/// `materials`, or by the material itself where all that has it is paired. `parts`: meshes that
/// are seen together, by their indices; only triangles of one part and of equal materials are
/// compared. What is divided gets meshes at the end of `meshes`; those that lose all triangles
/// stay, empty, and leave the parts. Returns the number of pairs.
std::size_t joinBacks(std::span<std::vector<std::uint32_t>> parts, std::vector<Mesh>& meshes,
                      std::vector<Material>& materials);

} // namespace limn
