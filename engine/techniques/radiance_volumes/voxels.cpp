// SPDX-License-Identifier: MIT
#include "engine/techniques/radiance_volumes/voxels.h"

#include "engine/core/parallel.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

namespace limn {

namespace {

std::uint8_t toByte(float opacity) {
    return std::uint8_t(opacity * 255 + 0.5f);
}

/// Opacities of a level, whether it consists of bits or of bytes.
struct LevelView {
    const CellBits* bits;
    const VoxelLevel* bytes;
    std::size_t side;

    float operator()(std::size_t x, std::size_t y, std::size_t z) const {
        const std::size_t cell = (z * side + y) * side + x;
        return bits ? (bits->test(cell) ? 1.f : 0.f) : float((*bytes)[cell]) * (1 / 255.f);
    }
};

/// The next level of `fine`. `axis`: that of a chain of VoxelVolume::along; -1: the mean.
VoxelLevel coarser(const LevelView& fine, int axis) {
    const std::size_t side = fine.side / 2;
    VoxelLevel level(side * side * side);
    parallelRanges(side, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t z = begin; z < end; ++z)
            for (std::size_t y = 0; y < side; ++y)
                for (std::size_t x = 0; x < side; ++x) {
                    float child[8];
                    for (std::size_t k = 0; k < 8; ++k)
                        child[k] = fine(2 * x + (k & 1), 2 * y + (k >> 1 & 1), 2 * z + (k >> 2));
                    float sum = 0;
                    for (std::size_t k = 0; k < 8; ++k) {
                        const std::size_t behind = axis < 0 ? 0 : std::size_t(1) << axis;
                        if (axis < 0)
                            sum += child[k] / 8;
                        else if ((k & behind) == 0)
                            sum += (1 - (1 - child[k]) * (1 - child[k | behind])) / 4;
                    }
                    level[(z * side + y) * side + x] = toByte(sum);
                }
    });
    return level;
}

std::vector<VoxelLevel> chainOf(const CellBits& solid, std::size_t side, int axis) {
    std::vector<VoxelLevel> chain;
    for (std::size_t s = side; s > 1; s /= 2)
        chain.push_back(coarser(
            {chain.empty() ? &solid : nullptr, chain.empty() ? nullptr : &chain.back(), s}, axis));
    return chain;
}

/// Lowers the distances of the cells in x of one row to those of a row beside it, plus 1.
void nearer(std::uint8_t* row, const std::uint8_t* beside, std::size_t side) {
    for (std::size_t x = 0; x < side; ++x)
        for (std::size_t k = x > 0 ? x - 1 : 0; k <= std::min(x + 1, side - 1); ++k)
            row[x] = std::min<std::uint8_t>(row[x], std::uint8_t(std::min(beside[k] + 1, 255)));
}

/// Two passes over all rows, each of which hands distances on to the rows that follow. Borgefors.
/// Distance Transformations in Digital Images. 1986
VoxelLevel distances(const CellBits& solid, std::size_t side) {
    VoxelLevel distance(side * side * side, 255);
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
    std::size_t sum = solid.words.size() * sizeof(std::uint64_t) + distance.size();
    for (const std::vector<VoxelLevel>* chain : {&mean, &along[0], &along[1], &along[2]})
        for (const VoxelLevel& level : *chain)
            sum += level.size();
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
    volume.mean = chainOf(volume.solid, volume.side(), -1);
    for (int axis = 0; axis < 3; ++axis)
        volume.along[std::size_t(axis)] = chainOf(volume.solid, volume.side(), axis);
}

bool isEmptyAbout(const VoxelVolume& volume, glm::vec3 p, float reach) {
    const int side = int(volume.side());
    const glm::ivec3 c = glm::clamp(glm::ivec3(glm::floor(p)), glm::ivec3(0), glm::ivec3(side - 1));
    // The cell's own extent, and how far p lies outside the cube.
    const glm::vec3 outside = glm::abs(p - (glm::vec3(c) + 0.5f));
    const float away = std::max({outside.x, outside.y, outside.z});
    const std::size_t cell =
        (std::size_t(c.z) * std::size_t(side) + std::size_t(c.y)) * std::size_t(side) +
        std::size_t(c.x);
    return float(volume.distance[cell]) - 0.5f - away >= reach;
}

float opacityAt(const VoxelVolume& volume, std::uint32_t level, glm::vec3 p, glm::vec3 weight) {
    const int side = int(volume.side() >> level);
    const glm::vec3 at = p / float(1U << level) - 0.5f;
    const glm::vec3 base = glm::floor(at), f = at - base;
    const glm::ivec3 c(base);
    const bool directional = weight != glm::vec3(0);
    float sum = 0;
    for (int k = 0; k < 8; ++k) {
        const glm::ivec3 step(k & 1, k >> 1 & 1, k >> 2), cell = c + step;
        // Negative ones are above all sides as unsigned numbers.
        if (glm::any(glm::greaterThanEqual(glm::uvec3(cell), glm::uvec3(std::uint32_t(side)))))
            continue;
        const glm::vec3 w = glm::mix(1.f - f, f, glm::vec3(step));
        const std::size_t i = std::size_t((cell.z * side + cell.y) * side + cell.x);
        float opacity = 0;
        if (level == 0)
            opacity = volume.distance[i] == 0 ? 255.f : 0.f;
        else if (directional)
            opacity = weight.x * float(volume.along[0][level - 1][i]) +
                      weight.y * float(volume.along[1][level - 1][i]) +
                      weight.z * float(volume.along[2][level - 1][i]);
        else
            opacity = float(volume.mean[level - 1][i]);
        sum += w.x * w.y * w.z * opacity;
    }
    return sum * (1 / 255.f);
}

} // namespace limn
