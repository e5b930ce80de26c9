// SPDX-License-Identifier: MIT
#include "engine/lightmap/planar_set.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

float cross2(glm::vec2 a, glm::vec2 b) {
    return a.x * b.y - a.y * b.x;
}

/// Separating axis: true if an edge of `a` has all of `b` on its outer side, within `slack`
/// lengths.
bool edgeSeparates(const Triangle2& a, const Triangle2& b, float slack) {
    const float winding = cross2(a[1] - a[0], a[2] - a[0]) < 0 ? -1.f : 1.f;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::vec2 edge = a[(i + 1) % 3] - a[i];
        const float length = glm::length(edge);
        if (!(length > 0))
            continue;
        float inmost = -1e30f;
        for (const glm::vec2 p : b)
            inmost = std::max(inmost, winding * cross2(edge, p - a[i]) / length);
        if (inmost <= slack)
            return true;
    }
    return false;
}

float extent(const Triangle2& t) {
    const glm::vec2 size =
        glm::max(t[0], glm::max(t[1], t[2])) - glm::min(t[0], glm::min(t[1], t[2]));
    return std::max(size.x, size.y);
}

} // namespace

bool trianglesOverlap(const Triangle2& a, const Triangle2& b) {
    for (int k = 0; k < 2; ++k) // bounds first: most pairs lie apart
        if (std::max({a[0][k], a[1][k], a[2][k]}) < std::min({b[0][k], b[1][k], b[2][k]}) ||
            std::max({b[0][k], b[1][k], b[2][k]}) < std::min({a[0][k], a[1][k], a[2][k]}))
            return false;
    const float slack = 1e-3f * std::min(extent(a), extent(b));
    return !edgeSeparates(a, b, slack) && !edgeSeparates(b, a, slack);
}

template <class F>
void PlanarSet::forCells(const Triangle2& t, F visit) const {
    const auto cell = [&](glm::vec2 p) { return glm::ivec2(glm::floor(p / m_cellSize)); };
    const glm::ivec2 lower = cell(glm::min(t[0], glm::min(t[1], t[2])));
    const glm::ivec2 upper = cell(glm::max(t[0], glm::max(t[1], t[2])));
    for (int y = lower.y; y <= upper.y; ++y)
        for (int x = lower.x; x <= upper.x; ++x)
            visit(std::uint64_t(std::uint32_t(x)) << 32 | std::uint32_t(y));
}

static bool coversManyCells(const Triangle2& t, float cellSize, int limit) {
    const glm::vec2 size =
        glm::max(t[0], glm::max(t[1], t[2])) - glm::min(t[0], glm::min(t[1], t[2]));
    return (size.x / cellSize + 1) * (size.y / cellSize + 1) > float(limit);
}

bool PlanarSet::overlaps(const Triangle2& t) const {
    for (const std::uint32_t i : m_large)
        if (trianglesOverlap(t, m_triangles[i]))
            return true;
    if (coversManyCells(t, m_cellSize, kMaxCells))
        return std::any_of(m_triangles.begin(), m_triangles.end(),
                           [&](const Triangle2& other) { return trianglesOverlap(t, other); });
    bool found = false;
    forCells(t, [&](std::uint64_t key) {
        const auto it = found ? m_cells.end() : m_cells.find(key);
        for (std::uint32_t e = it == m_cells.end() ? ~0U : it->second; !found && e != ~0U;
             e = m_entries[e].next)
            found = trianglesOverlap(t, m_triangles[m_entries[e].triangle]);
    });
    return found;
}

void PlanarSet::insert(const Triangle2& t) {
    const auto index = std::uint32_t(m_triangles.size());
    m_triangles.push_back(t);
    if (coversManyCells(t, m_cellSize, kMaxCells))
        m_large.push_back(index);
    else
        forCells(t, [&](std::uint64_t key) {
            std::uint32_t& first = m_cells.try_emplace(key, ~0U).first->second;
            m_entries.push_back({index, first});
            first = std::uint32_t(m_entries.size() - 1);
        });
}

} // namespace limn
