// SPDX-License-Identifier: MIT
#pragma once

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
    glm::vec3 shift{0};  ///< to the mean of the points that want the cache [m]

    /// The cache's place, moved along `normal` until it is `minHeight` above the surfaces on
    /// average, so that these do not hide what it looks for. Where they face opposite ways, as the
    /// two sides of a thin wall do, it stays.
    glm::vec3 raised(float minHeight) const;
    /// Where cones start: the mean of the points that want the cache, moved along `normal` until it
    /// is as high above the surfaces as the cache, and `minHeight` at least. Where surfaces face
    /// opposite ways, the cache's place. The points can be seen, while the cache may lie behind a
    /// wall that does not want it, such as one at the end of a floor.
    glm::vec3 seenFrom(float minHeight) const;
    bool operator==(const CachePlace&) const = default;
};

/// Sums over surfaces about a cache, in whole numbers: kPlaceUnit for a normal's unit and for a
/// height, and for a shift, of a cell.
struct PlaceSums {
    std::int64_t surfaces = 0, x = 0, y = 0, z = 0, height = 0;
    std::int64_t shiftX = 0, shiftY = 0, shiftZ = 0;
};
inline constexpr float kPlaceUnit = 4096;

/// The place of a cache at `position` of a grid whose cells have the side `cell` [m].
CachePlace placeOf(const PlaceSums& sums, glm::vec3 position, float cell);

/// Sums over the surfaces about each cache. Whole numbers are summed, so that the result does not
/// depend on the order, and several threads may add at once.
class CachePlaceSums {
public:
    explicit CachePlaceSums(std::size_t caches) : m_sums(caches) {}

    /// Adds a surface through point `p` with unit `normal`. `position`, `cell`: place of the cache,
    /// and the side of its grid's cells [m].
    void add(std::size_t cache, glm::vec3 position, float cell, glm::vec3 p, glm::vec3 normal);
    const PlaceSums& sums(std::size_t cache) const { return m_sums[cache]; }

private:
    std::vector<PlaceSums> m_sums;
};

} // namespace limn
