// SPDX-License-Identifier: MIT
#include "engine/math/point_grid.h"

#include <bit>
#include <numeric>

namespace limn {

void PointGrid::build(std::span<const glm::vec3> points, float cellSize) {
    glm::vec3 lower(points.empty() ? glm::vec3(0) : points[0]), upper = lower;
    for (const glm::vec3 p : points) {
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
    }
    m_origin = lower + (upper - lower) * 0.5f;
    m_perSize = 1 / cellSize;
    const std::size_t buckets = std::bit_ceil(std::max<std::size_t>(points.size(), 2));
    m_shift = 64 - std::countr_zero(buckets);
    m_begin.assign(buckets + 1, 0);
    std::vector<std::uint64_t> keys(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        keys[i] = keyOf(cellOf(points[i]));
        ++m_begin[bucketOf(keys[i]) + 1];
    }
    std::partial_sum(m_begin.begin(), m_begin.end(), m_begin.begin());
    m_entries.resize(points.size());
    std::vector<std::uint32_t> next(m_begin.begin(), m_begin.end() - 1);
    for (std::uint32_t i = 0; i < points.size(); ++i)
        m_entries[next[bucketOf(keys[i])]++] = {keys[i], i};
}

} // namespace limn
