// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include <glm/vec2.hpp>

namespace limn {

using Triangle2 = std::array<glm::vec2, 3>;

/// Whether the interiors overlap by more than rounding (shared edges and corners do not count).
/// Accepts either winding.
bool trianglesOverlap(const Triangle2& a, const Triangle2& b);

/// Triangles in a plane, with a hash grid that finds whether another triangle would overlap them.
class PlanarSet {
public:
    /// `cellSize` > 0, about the size of a typical triangle.
    explicit PlanarSet(float cellSize) : m_cellSize(cellSize) {}

    bool overlaps(const Triangle2& t) const;
    void insert(const Triangle2& t);

private:
    template <class F>
    void forCells(const Triangle2& t, F visit) const;

    /// Triangles that cover more cells than this are kept in a list that every query searches.
    static constexpr int kMaxCells = 256;

    float m_cellSize;
    std::vector<Triangle2> m_triangles;
    std::vector<std::uint32_t> m_large;
    struct Entry {
        std::uint32_t triangle, next; ///< next in the same cell; ~0: none
    };
    std::vector<Entry> m_entries;
    std::unordered_map<std::uint64_t, std::uint32_t> m_cells; ///< first entry of each
};

} // namespace limn
