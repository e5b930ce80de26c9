// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/radiance_volumes/cache_grids.h"

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// Where a cache lies, and which way the surfaces that it lights face.
struct CachePlace {
    glm::vec3 position{0};
    glm::vec3 normal{0}; ///< mean of the surfaces' unit normals
    float height = 0;    ///< mean height above their planes [m]

    /// The cache's place, moved along `normal` until it is at least `least` above the surfaces on
    /// average, so that these do not hide what it looks for. Where they face opposite ways, as the
    /// two sides of a thin wall do, it stays.
    glm::vec3 raised(float least) const;
    bool operator==(const CachePlace&) const = default;
};

/// Which nodes surfaces want a cache at. Whole numbers are summed, so that the result does not
/// depend on the order; the functions may run in several threads at once.
class NodeDemand {
public:
    explicit NodeDemand(const CacheGrids& grids);

    /// Wants the eight nodes of a cell.
    void want(std::size_t grid, glm::uvec3 cell);
    /// The same, for a surface through point `p` with that unit normal, which counts in the places
    /// of their caches.
    void want(std::size_t grid, glm::uvec3 cell, glm::vec3 p, glm::vec3 normal);

    bool wanted(std::size_t grid, std::size_t node) const;
    std::size_t count() const;
    CachePlace place(std::size_t grid, std::size_t node) const;

private:
    struct Sums {
        std::int64_t surfaces = 0, x = 0, y = 0, z = 0, height = 0;
    };
    const CacheGrids& m_grids;
    std::vector<std::size_t> m_first; ///< node of each grid
    std::vector<std::uint8_t> m_wanted;
    std::vector<Sums> m_sums;
};

} // namespace limn
