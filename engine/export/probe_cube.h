// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/export/export_format.h"

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// Radiance from all directions [W m^-2 sr^-1] on the faces +X, -X, +Y, -Y, +Z, -Z of a cube, laid
/// out as OpenGL lays out cube maps.
struct CubeMap {
    std::uint32_t size = 0;     ///< texels along each side of a face
    std::vector<glm::vec3> rgb; ///< rgb[(face * size + row) * size + column]

    std::size_t texels() const { return std::size_t(6) * size * size; }
};

/// Unit direction to the centre of a texel of CubeMap::rgb.
glm::vec3 cubeDirection(std::uint32_t size, std::size_t texel);

/// Texel of CubeMap::rgb that a direction leads to.
std::size_t cubeTexel(std::uint32_t size, glm::vec3 direction);

/// Where a single probe of the scene stands: the centre of the grid's cell that is nearest to the
/// middle of the grid and from which no surface shows a black back, or the middle if there is none.
/// Precondition: the field has a grid.
glm::vec3 probePosition(const ExportScene& scene);

/// What is seen from `p` in a direction (unit): surfaces send what they emit and, as Lambertian
/// ones, their bounced and direct light, metals with the colour that they mirror; behind them is
/// the sky. Black backs are black.
glm::vec3 radianceSeen(const ExportScene& scene, glm::vec3 p, glm::vec3 direction);

/// The same in all directions. Incomplete when cancelled.
CubeMap cubeSeenFrom(const ExportScene& scene, glm::vec3 p, std::uint32_t size,
                     const Progress& progress);

/// The cube as mirrors of roughness `alpha` (GGX, in (0, 1]) show it that face their viewer, with
/// `size` texels a side: the mean of the radiance weighted by D(h) (n l).
/// Karis. Real Shading in Unreal Engine 4. 2013
CubeMap prefiltered(const CubeMap& cube, float alpha, std::uint32_t size);

/// The cube in a world that is mirrored: by -1 along the axes of `signs` that are -1, and 1 along
/// the others.
CubeMap mirrored(const CubeMap& cube, glm::vec3 signs);

} // namespace limn
