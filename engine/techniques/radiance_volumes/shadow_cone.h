// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/radiance_volumes/volume_settings.h"
#include "engine/techniques/radiance_volumes/voxels.h"

#include <glm/vec3.hpp>

namespace limn {

/// Share of the light of a cone from `from` to `to` that passes the voxels, in [0, 1]. Both are in
/// voxels, from the volume's lower corner; `sine`: of half the cone's angle, in [0, 1).
///
/// Spheres that fill the cone are followed from a distance of two voxels on, each with the opacity
/// of the level whose cells are as large as its radius. Directional: through the chains along the
/// axes, weighted by the squared cosines of the direction, in steps of a radius, until a sphere
/// comes within two voxels of the end. Published: as in the program of Reich. Realtime Global
/// Illumination using Dynamic Radiance Volumes. 2015; through the mean, in steps of a diameter
/// over 1 - sine, 32 of them at most, to the very end. None: 1.
float coneVisibility(const VoxelVolume& volume, ConeShadows shadows, glm::vec3 from, glm::vec3 to,
                     float sine);

} // namespace limn
