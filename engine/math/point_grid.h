// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// A spatial hash of points in the cells of a cubic grid.
class PointGrid {
public:
    /// `cellSize` > 0. Deterministic.
    void build(std::span<const glm::vec3> points, float cellSize);

    /// Calls visit(index) for the points of the 27 cells around `p`, hence for all points within a
    /// cell's size. Of a cell with more than kMaxPerCell points it visits at most that many, evenly
    /// spaced, which bounds the work where a surface overlaps itself a thousand times.
    template <class Visit>
    void forNear(glm::vec3 p, const Visit& visit) const {
        const glm::ivec3 middle = cellOf(p);
        for (int z = -1; z <= 1; ++z)
            for (int y = -1; y <= 1; ++y)
                for (int x = -1; x <= 1; ++x)
                    forCell(keyOf(middle + glm::ivec3(x, y, z)), visit);
    }

    static constexpr std::uint32_t kMaxPerCell = 32;

private:
    struct Entry {
        std::uint64_t key;
        std::uint32_t point;
    };

    glm::ivec3 cellOf(glm::vec3 p) const {
        constexpr float kMaximum = float(1 << 20) - 2; // keys have 21 bits per axis
        return glm::ivec3(glm::clamp(glm::floor((p - m_origin) * m_perSize), -kMaximum, kMaximum));
    }
    static std::uint64_t keyOf(glm::ivec3 cell) {
        constexpr int kOffset = 1 << 20;
        const glm::uvec3 c(cell + kOffset);
        return std::uint64_t(c.x) | std::uint64_t(c.y) << 21 | std::uint64_t(c.z) << 42;
    }
    std::size_t bucketOf(std::uint64_t key) const {
        return std::size_t(key * 0x9e3779b97f4a7c15ULL >> m_shift);
    }
    template <class Visit>
    void forCell(std::uint64_t key, const Visit& visit) const {
        const std::size_t bucket = bucketOf(key);
        const std::uint32_t begin = m_begin[bucket], end = m_begin[bucket + 1];
        const std::uint32_t stride = (end - begin) / kMaxPerCell + 1;
        for (std::uint32_t i = begin; i < end; i += stride)
            if (m_entries[i].key == key)
                visit(m_entries[i].point);
    }

    glm::vec3 m_origin{0};
    float m_perSize = 1;
    int m_shift = 63;
    std::vector<std::uint32_t> m_begin; ///< per bucket (+1)
    std::vector<Entry> m_entries;       ///< by bucket, then in the points' order
};

} // namespace limn
