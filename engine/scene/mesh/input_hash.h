// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

#include <cstdint>
#include <vector>

namespace limn {

/// Hash of a mesh's triangles and texture coordinates.
std::uint64_t hashMesh(const Mesh& mesh);

/// hashMesh of every mesh of the scene's assets, in parallel.
std::vector<std::uint64_t> hashMeshes(const Scene& scene);

/// Hash of the properties of a material that rays depend on: its sides and its holes.
std::uint64_t hashSurface(const Scene& scene, const Material& material, std::uint64_t seed);

bool emits(const Material& material);

} // namespace limn
