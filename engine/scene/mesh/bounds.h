// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <ranges>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// An axis-aligned bounding box.
struct Bounds {
    glm::vec3 lower{0}, upper{0};

    glm::vec3 size() const { return upper - lower; }
    glm::vec3 centre() const { return (lower + upper) * 0.5f; }
    bool operator==(const Bounds&) const = default;
};

/// Empty box; extending it by a point yields the box of that point alone.
inline constexpr Bounds kNoBounds{glm::vec3(std::numeric_limits<float>::infinity()),
                                  glm::vec3(-std::numeric_limits<float>::infinity())};

inline bool isEmpty(const Bounds& b) {
    return !(b.lower.x <= b.upper.x);
}

inline void extend(Bounds& bounds, glm::vec3 p) {
    bounds.lower = glm::min(bounds.lower, p);
    bounds.upper = glm::max(bounds.upper, p);
}

inline void extend(Bounds& bounds, const Bounds& other) {
    bounds.lower = glm::min(bounds.lower, other.lower);
    bounds.upper = glm::max(bounds.upper, other.upper);
}

/// Bounding box of all points; kNoBounds if there are none.
template <std::ranges::input_range Points>
Bounds boundsOf(Points&& points) {
    Bounds bounds = kNoBounds;
    for (const glm::vec3 p : points)
        extend(bounds, p);
    return bounds;
}

} // namespace limn
