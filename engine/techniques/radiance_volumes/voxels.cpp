// SPDX-License-Identifier: MIT
#include "engine/techniques/radiance_volumes/voxels.h"

#include "engine/core/parallel.h"

#include <algorithm>
#include <cmath>

namespace limn {

namespace {

std::uint32_t toByte(float opacity) {
    return std::uint32_t(opacity * 255 + 0.5f);
}

/// Eight cells whose opacities become that of one: of bit k & 1, k >> 1 & 1 and k >> 2 along the
/// axes.
using Children = float[8];

float meanOf(const Children& child) {
    float sum = 0;
    for (const float c : child)
        sum += c / 8;
    return sum;
}

float alongAxis(const Children& child, int axis) {
    const std::size_t behind = std::size_t(1) << axis;
    float sum = 0;
    for (std::size_t k = 0; k < 8; ++k)
        if ((k & behind) == 0)
            sum += (1 - (1 - child[k]) * (1 - child[k | behind])) / 4;
    return sum;
}

/// The level with half of `side`. opacity(cell, which) is that of a cell of the finer one.
template <class Opacity>
VoxelLevel halved(std::size_t side, const Opacity& opacity) {
    const std::size_t half = side / 2;
    VoxelLevel level(half * half * half);
    parallelRanges(half, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t z = begin; z < end; ++z)
            for (std::size_t y = 0; y < half; ++y)
                for (std::size_t x = 0; x < half; ++x) {
                    std::uint32_t cell = 0;
                    for (int which = 0; which < 4; ++which) {
                        Children child;
                        for (std::size_t k = 0; k < 8; ++k)
                            child[k] =
                                opacity(((2 * z + (k >> 2)) * side + 2 * y + (k >> 1 & 1)) * side +
                                            2 * x + (k & 1),
                                        which);
                        cell |=
                            toByte(which == kMeanOpacity ? meanOf(child) : alongAxis(child, which))
                            << (8 * which);
                    }
                    level[(z * half + y) * half + x] = cell;
                }
    });
    return level;
}

/// std::floor() of what an int can hold; the standard one is a call.
int lowerInteger(float x) {
    const int towardsZero = int(x);
    return towardsZero - (x < float(towardsZero) ? 1 : 0);
}

/// Lowers the distances of the cells in x of one row to those of a row beside it, plus 1.
void nearer(std::uint8_t* row, const std::uint8_t* beside, std::size_t side) {
    for (std::size_t x = 0; x < side; ++x)
        for (std::size_t k = x > 0 ? x - 1 : 0; k <= std::min(x + 1, side - 1); ++k)
            row[x] = std::min<std::uint8_t>(row[x], std::uint8_t(std::min(beside[k] + 1, 255)));
}

/// Two passes over all rows, each of which hands distances on to the rows that follow. Borgefors.
/// Distance Transformations in Digital Images. 1986
std::vector<std::uint8_t> distances(const CellBits& solid, std::size_t side) {
    std::vector<std::uint8_t> distance(side * side * side, 255);
    for (std::size_t c = 0; c < distance.size(); ++c)
        if (solid.test(c))
            distance[c] = 0;
    const auto rowAt = [&](std::size_t y, std::size_t z) {
        return &distance[(z * side + y) * side];
    };
    const auto along = [&](std::uint8_t* row) {
        for (std::size_t x = 1; x < side; ++x)
            row[x] = std::min<std::uint8_t>(row[x], std::uint8_t(std::min(row[x - 1] + 1, 255)));
        for (std::size_t x = side - 1; x-- > 0;)
            row[x] = std::min<std::uint8_t>(row[x], std::uint8_t(std::min(row[x + 1] + 1, 255)));
    };
    for (std::size_t z = 0; z < side; ++z)
        for (std::size_t y = 0; y < side; ++y) {
            if (y > 0)
                nearer(rowAt(y, z), rowAt(y - 1, z), side);
            for (std::size_t k = y > 0 ? y - 1 : 0; z > 0 && k <= std::min(y + 1, side - 1); ++k)
                nearer(rowAt(y, z), rowAt(k, z - 1), side);
            along(rowAt(y, z));
        }
    for (std::size_t z = side; z-- > 0;)
        for (std::size_t y = side; y-- > 0;) {
            if (y + 1 < side)
                nearer(rowAt(y, z), rowAt(y + 1, z), side);
            for (std::size_t k = y > 0 ? y - 1 : 0; z + 1 < side && k <= std::min(y + 1, side - 1);
                 ++k)
                nearer(rowAt(y, z), rowAt(k, z + 1), side);
            along(rowAt(y, z));
        }
    return distance;
}

} // namespace

std::size_t VoxelVolume::bytes() const {
    std::size_t sum = solid.words.size() * sizeof(std::uint64_t) + opacity.size() + distance.size();
    for (const VoxelLevel& level : coarse)
        sum += level.size() * sizeof(std::uint32_t);
    return sum;
}

Lattice voxelLattice(const Bounds& bounds, std::uint32_t side) {
    const glm::vec3 extent = bounds.size();
    const float longest = std::max({extent.x, extent.y, extent.z});
    Lattice lattice{.cell = longest > 0 ? longest / float(side - 2) : 1, .size = glm::uvec3(side)};
    lattice.lower = bounds.centre() - glm::vec3(lattice.cell * float(side) / 2);
    return lattice;
}

VoxelVolume voxelsOf(const Scene& scene, std::uint32_t side) {
    const Lattice lattice = voxelLattice(scene.bounds, side);
    VoxelVolume volume{.lattice = lattice, .solid = touchedCells(scene, lattice)};
    averageVoxels(volume);
    return volume;
}

void averageVoxels(VoxelVolume& volume) {
    volume.distance = distances(volume.solid, volume.side());
    volume.coarse.clear();
    for (std::size_t side = volume.side(); side > 1; side /= 2)
        volume.coarse.push_back(
            volume.coarse.empty()
                ? halved(side,
                         [&](std::size_t c, int) { return float(solidOpacity(volume, c)) / 255; })
                : halved(side, [&, &fine = volume.coarse.back()](std::size_t c, int which) {
                      return float(opacityByte(fine[c], which)) * (1 / 255.f);
                  }));
}

bool isEmptyAbout(const VoxelVolume& volume, glm::vec3 p, float reach) {
    const int side = int(volume.side());
    int cell[3];
    float away = 0; // of p from the middle of the nearest cell in the cube
    for (int axis = 0; axis < 3; ++axis) {
        cell[axis] = std::clamp(lowerInteger(p[axis]), 0, side - 1);
        away = std::max(away, std::abs(p[axis] - (float(cell[axis]) + 0.5f)));
    }
    const auto index = std::size_t((cell[2] * side + cell[1]) * side + cell[0]);
    return float(volume.distance[index]) - 0.5f - away >= reach;
}

float opacityAt(const VoxelVolume& volume, std::uint32_t level, glm::vec3 p, glm::vec3 weight) {
    const int side = int(volume.side() >> level);
    const glm::vec3 q = p / float(1U << level) - 0.5f;
    const glm::ivec3 c(lowerInteger(q.x), lowerInteger(q.y), lowerInteger(q.z));
    const float f[3] = {q.x - float(c.x), q.y - float(c.y), q.z - float(c.z)};
    const bool directional = weight != glm::vec3(0);
    const std::uint8_t* const fading = volume.opacity.empty() ? nullptr : volume.opacity.data();
    float sum = 0;
    for (int k = 0; k < 8; ++k) {
        const int x = c.x + (k & 1), y = c.y + (k >> 1 & 1), z = c.z + (k >> 2);
        // Negative ones are above all sides as unsigned numbers.
        if (std::max({unsigned(x), unsigned(y), unsigned(z)}) >= unsigned(side))
            continue;
        const auto i = std::size_t((z * side + y) * side + x);
        float opacity = 0;
        if (level == 0) {
            opacity = float(fading ? fading[i] : volume.distance[i] == 0 ? 255 : 0);
        } else if (const std::uint32_t cell = volume.coarse[level - 1][i]; directional) {
            opacity = weight.x * float(cell & 255) + weight.y * float(cell >> 8 & 255) +
                      weight.z * float(cell >> 16 & 255);
        } else {
            opacity = float(cell >> 24);
        }
        sum += (k & 1 ? f[0] : 1 - f[0]) * (k & 2 ? f[1] : 1 - f[1]) * (k & 4 ? f[2] : 1 - f[2]) *
               opacity;
    }
    return sum * (1 / 255.f);
}

} // namespace limn
