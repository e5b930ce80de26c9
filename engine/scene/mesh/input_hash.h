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

/// Hash of everything that rays through the static scene depend on: meshes, instances, sides and
/// holes, which materials emit, and the instances' texel densities. Excludes lights, albedo,
/// emission and the places and materials of dynamic instances.
std::uint64_t hashStatic(const Scene& scene, std::uint64_t seed);

bool emits(const Material& material);

} // namespace limn
