// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lattice/lattice.h"
#include "engine/scene/scene.h"
#include "engine/techniques/radiance_volumes/touched_cells.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace limn {

/// Opacities of the cells of one level, x fastest: bytes along x, y and z and of the mean, from the
/// lowest, in 255ths.
using VoxelLevel = std::vector<std::uint32_t>;

/// Number of the mean's byte; along an axis: the axis.
inline constexpr int kMeanOpacity = 3;
inline std::uint32_t opacityByte(std::uint32_t cell, int which) {
    return cell >> (8 * which) & 255;
}

/// The solid voxels of a scene in a cube over it, and their averages. Level k has 2^k times as
/// large cells; level 0 is made of bits, unless voxels fade.
struct VoxelVolume {
    Lattice lattice;   ///< of level 0: a cube with a power of two along each side
    CellBits solid{0}; ///< cells that are not empty
    /// Opacities of level 0 in 255ths, of voxels that fade in and out; empty: all of `solid` are
    /// opaque.
    std::vector<std::uint8_t> opacity;
    /// coarse[k - 1]: level k. The mean is that of eight cells each: Crassin et al. Interactive
    /// Indirect Illumination Using Voxel Cone Tracing. 2011. Along an axis is what light along it
    /// meets: two cells one behind the other let through the product of what each lets through, and
    /// four such pairs are averaged.
    std::vector<VoxelLevel> coarse;
    /// Per cell, the number of cells between it and the nearest solid one, along the axis along
    /// which they lie further apart, plus 1; 0 in a solid one, 255 where that is as far or further.
    std::vector<std::uint8_t> distance;

    std::uint32_t side() const { return lattice.size.x; }
    std::uint32_t levels() const { return std::uint32_t(coarse.size()) + 1; }
    std::size_t bytes() const;
};

/// The cube: one voxel wider on each side than the longest side of `bounds`, so that walls there
/// lie between two voxels. `side`: a power of two >= 16. A scene without extent has cells of 1 m.
Lattice voxelLattice(const Bounds& bounds, std::uint32_t side);

VoxelVolume voxelsOf(const Scene& scene, std::uint32_t side);

/// Opacity of a cell of level 0, in 255ths.
inline std::uint8_t solidOpacity(const VoxelVolume& volume, std::size_t cell) {
    return volume.opacity.empty() ? (volume.solid.test(cell) ? 255 : 0) : volume.opacity[cell];
}

/// Fills all else from `solid` and `opacity`.
void averageVoxels(VoxelVolume& volume);

/// Whether all cells of level 0 within `reach` cells of `p` along each axis are empty. May return
/// false where they are.
bool isEmptyAbout(const VoxelVolume& volume, glm::vec3 p, float reach);

/// Trilinear opacity at a point of a level, in [0, 1]: of the mean, or, where `weight` is not 0,
/// of those along the axes, weighted by it; its sum is 1. `p`: in cells of level 0, from the
/// lower corner; outside the cube nothing is opaque.
float opacityAt(const VoxelVolume& volume, std::uint32_t level, glm::vec3 p, glm::vec3 weight);

} // namespace limn
