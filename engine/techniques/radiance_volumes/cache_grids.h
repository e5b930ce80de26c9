// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/mesh/bounds.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// The first node of a cell is its corner 0; corner 7 is the one opposite.
inline glm::uvec3 cellCorner(glm::uvec3 cell, std::uint32_t corner) {
    return cell + glm::uvec3(corner & 1, corner >> 1 & 1, corner >> 2);
}

/// A regular grid of nodes at which there may be caches.
struct CacheGrid {
    glm::vec3 lower{0};  ///< place of the first node
    float cell = 1;      ///< distance of neighbouring nodes [m]
    glm::uvec3 nodes{2}; ///< along each axis, each >= 2
    /// Points in this box are lit by the grid, if by no finer one.
    Bounds decision;

    std::size_t count() const { return std::size_t(nodes.x) * nodes.y * nodes.z; }
    std::size_t index(glm::uvec3 node) const {
        return (std::size_t(node.z) * nodes.y + node.y) * nodes.x + node.x;
    }
    glm::uvec3 node(std::size_t index) const {
        return {index % nodes.x, index / nodes.x % nodes.y, index / nodes.x / nodes.y};
    }
    glm::vec3 place(glm::uvec3 node) const { return lower + glm::vec3(node) * cell; }
    /// The first node of the cell that contains a point, or of the nearest one.
    glm::uvec3 cellAt(glm::vec3 p) const {
        return glm::uvec3(glm::clamp((p - lower) / cell, glm::vec3(0), glm::vec3(nodes - 2U)));
    }
    bool operator==(const CacheGrid&) const = default;
};

/// Nested grids, the finest first.
struct CacheGrids {
    std::vector<CacheGrid> grids;
    float transition = 0; ///< in cells of the finer grid: where two grids are mixed
    bool operator==(const CacheGrids&) const = default;

    std::size_t nodes() const;
    /// Number of the first node of a grid among those of all.
    std::size_t firstNode(std::size_t grid) const;
};

/// The point at which caches are asked for and looked up for a surface at `p` with unit `normal`: a
/// hundredth of the finest cell above it. Walls often lie on nodes, where rounding would choose the
/// cell. Precondition: there is a grid.
inline glm::vec3 aboveSurface(const CacheGrids& grids, glm::vec3 p, glm::vec3 normal) {
    return p + normal * (0.01f * grids.grids[0].cell);
}

/// Grids of `nodes` nodes a side about the eye, which is clamped to `bounds`; each has half the
/// edge of the next, and the last twice the longest side of `bounds`, so that it holds all of it.
/// Nodes stay where they are while the eye moves by less than a cell. None where `bounds` has no
/// extent.
CacheGrids cascadesAbout(glm::vec3 eye, const Bounds& bounds, std::uint32_t cascades,
                         std::uint32_t nodes, float transition);

/// One grid over `bounds`, with `cells` cells along the longest side.
CacheGrids gridOver(const Bounds& bounds, std::uint32_t cells);

/// The grids that light a point, and their shares of its light, whose sum is 1: one grid, or two
/// near the faces of a decision box.
struct GridShares {
    struct Share {
        std::uint32_t grid = 0;
        float weight = 0;
    };
    std::array<Share, 2> share{};
    std::size_t count = 0;
};
GridShares gridShares(const CacheGrids& grids, glm::vec3 p);

/// No cache.
inline constexpr std::uint32_t kNoCache = ~0U;

/// The caches from which a point is lit.
struct CacheLookup {
    std::array<std::uint32_t, 16> cache{};
    std::array<float, 16> weight{}; ///< their sum is 1
    std::size_t count = 0;          ///< 0: the point is missed
};

/// Trilinear weights of the caches at the eight nodes about a point in each grid of gridShares().
/// Nodes without a cache drop out and the others are scaled up; where a grid has none of them, the
/// next coarser one takes its place. `address`: a cache or kNoCache for each node of each grid.
CacheLookup lookUpCaches(const CacheGrids& grids, std::span<const std::uint32_t> address,
                         glm::vec3 p);
/// The same aboveSurface().
CacheLookup lookUpCaches(const CacheGrids& grids, std::span<const std::uint32_t> address,
                         glm::vec3 p, glm::vec3 normal);

} // namespace limn
