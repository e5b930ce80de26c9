// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

namespace limn {

/// Splits point numbers at the median of their widest axis: afterwards order[size / 2] is in its
/// sorted position and no element before it is greater. Ties are broken by number, so the result
/// depends on the points only. Returns the axis in [0, kAxes). `coordinate(point, axis)` returns a
/// float. Precondition: `order` is not empty.
template <std::size_t kAxes, class Coordinate>
std::size_t medianSplit(std::span<std::uint32_t> order, const Coordinate& coordinate) {
    std::array<float, kAxes> lower, upper;
    lower.fill(std::numeric_limits<float>::max());
    upper.fill(std::numeric_limits<float>::lowest());
    for (const std::uint32_t point : order)
        for (std::size_t k = 0; k < kAxes; ++k) {
            lower[k] = std::min(lower[k], coordinate(point, k));
            upper[k] = std::max(upper[k], coordinate(point, k));
        }
    std::size_t axis = 0;
    for (std::size_t k = 1; k < kAxes; ++k)
        if (upper[k] - lower[k] > upper[axis] - lower[axis])
            axis = k;
    std::nth_element(order.begin(), order.begin() + std::ptrdiff_t(order.size() / 2), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) {
                         const float x = coordinate(a, axis), y = coordinate(b, axis);
                         return x != y ? x < y : a < b;
                     });
    return axis;
}

} // namespace limn
