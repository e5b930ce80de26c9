// SPDX-License-Identifier: MIT
#include "engine/math/nearest_point.h"

#include "engine/math/median_split.h"

#include <numeric>

#include <glm/geometric.hpp>

namespace limn {

struct NearestPoint::Query {
    glm::vec3 p, normal;
    std::span<Near> best;        ///< in order
    std::size_t found = 0;       ///< of `best`
    std::uint32_t leftOut = ~0U; ///< a point that does not count

    void offer(const Near& near) {
        if (near.point == leftOut || (found == best.size() && !(near < best.back())))
            return;
        std::size_t slot = found < best.size() ? found++ : found - 1;
        for (; slot > 0 && near < best[slot - 1]; --slot)
            best[slot] = best[slot - 1];
        best[slot] = near;
    }
    bool mayHold(float distance2) const {
        return found < best.size() || distance2 <= best.back().cost;
    }
};

NearestPoint::NearestPoint(std::span<const glm::vec3> points, std::span<const glm::vec3> normals,
                           float spacing)
    : m_points(points), m_normals(normals), m_orientationWeight(16 * spacing * spacing),
      m_order(points.size()), m_axis(points.size()) {
    std::iota(m_order.begin(), m_order.end(), 0U);
    build(0, std::uint32_t(m_order.size()));
}

void NearestPoint::build(std::uint32_t begin, std::uint32_t end) {
    if (end - begin < 2)
        return;
    const std::uint32_t middle = begin + (end - begin) / 2;
    const std::size_t axis =
        medianSplit<3>(std::span(m_order).subspan(begin, end - begin),
                       [&](std::uint32_t i, std::size_t k) { return m_points[i][int(k)]; });
    m_axis[middle] = std::uint8_t(axis);
    build(begin, middle);
    build(middle + 1, end);
}

void NearestPoint::search(std::uint32_t begin, std::uint32_t end, Query& q) const {
    if (begin >= end)
        return;
    const std::uint32_t middle = begin + (end - begin) / 2, candidate = m_order[middle];
    const glm::vec3 d = m_points[candidate] - q.p;
    q.offer({glm::dot(d, d) + m_orientationWeight * (1 - glm::dot(m_normals[candidate], q.normal)),
             candidate});
    if (end - begin == 1)
        return;
    const float side = -d[m_axis[middle]];
    const bool lowerFirst = side <= 0;
    lowerFirst ? search(begin, middle, q) : search(middle + 1, end, q);
    if (q.mayHold(side * side))
        lowerFirst ? search(middle + 1, end, q) : search(begin, middle, q);
}

std::size_t NearestPoint::findSome(glm::vec3 p, glm::vec3 normal, std::span<Near> out) const {
    Query query{p, normal, out};
    search(0, std::uint32_t(m_order.size()), query);
    return query.found;
}

std::uint32_t NearestPoint::find(glm::vec3 p, glm::vec3 normal) const {
    Near nearest{0, 0};
    findSome(p, normal, {&nearest, 1});
    return nearest.point;
}

std::uint32_t NearestPoint::findOther(std::uint32_t index) const {
    Near nearest{0, ~0U};
    Query query{m_points[index], m_normals[index], {&nearest, 1}, 0, index};
    search(0, std::uint32_t(m_order.size()), query);
    return nearest.point;
}

} // namespace limn
