// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// Finds, among points with normals, the one nearest to a query in |dx|^2 + 16 spacing^2 (1 - n.m):
/// points of another orientation count as further away, by four spacings at right angles. Uses a
/// kd-tree. Deterministic; ties go to the lower index.
class NearestPoint {
public:
    struct Near {
        float cost; ///< the sum above
        std::uint32_t point;

        bool operator<(const Near& o) const {
            return cost != o.cost ? cost < o.cost : point < o.point;
        }
    };

    /// The spans must have equal length and outlive the object; for find they must not be empty.
    NearestPoint(std::span<const glm::vec3> points, std::span<const glm::vec3> normals,
                 float spacing);

    std::uint32_t find(glm::vec3 p, glm::vec3 normal) const;

    /// Index of the point nearest to point `index` other than itself; ~0 if there is no other.
    std::uint32_t findOther(std::uint32_t index) const;

    /// Fills `out` with the nearest points in order, as many as exist and fit. Returns their
    /// number.
    std::size_t findSome(glm::vec3 p, glm::vec3 normal, std::span<Near> out) const;

private:
    struct Query;
    void build(std::uint32_t begin, std::uint32_t end);
    void search(std::uint32_t begin, std::uint32_t end, Query& query) const;

    std::span<const glm::vec3> m_points, m_normals;
    float m_orientationWeight;          ///< 16 spacing^2
    std::vector<std::uint32_t> m_order; ///< kd-tree in place: the middle of a range splits it
    std::vector<std::uint8_t> m_axis;
};

} // namespace limn
