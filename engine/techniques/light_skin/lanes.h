// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace limn {

/// Numbers that are worked on together, one of each virtual light.
inline constexpr std::size_t kSkinLanes = 4;
typedef float Lanes __attribute__((vector_size(4 * kSkinLanes)));
typedef std::int32_t LaneBits __attribute__((vector_size(4 * kSkinLanes)));

/// The values from `first` on; 0 from the one after `count` on.
inline Lanes loadLanes(const std::vector<float>& values, std::size_t first, std::size_t count) {
    Lanes v{};
    std::memcpy(&v, values.data() + first, std::min(count, kSkinLanes) * sizeof(float));
    return v;
}

inline Lanes notBelow(Lanes v, float bound) {
    return v > bound ? v : Lanes{} + bound;
}
inline Lanes positive(Lanes v) {
    return v > 0 ? v : Lanes{};
}

/// Of numbers >= 0.
inline bool anyAbove0(Lanes v) {
    float sum = 0;
    for (std::size_t i = 0; i < kSkinLanes; ++i)
        sum += v[i];
    return sum > 0;
}

/// The sum in a fixed order.
inline double sumOf(const Lanes& v) {
    double sum = 0;
    for (std::size_t i = 0; i < kSkinLanes; ++i)
        sum += double(v[i]);
    return sum;
}

/// x^exponent for x in [0, 1] and exponent > 0, to within 3e-7 (1 + exponent) of the value; 0 where
/// that is below 1e-37. x < 1e-37 counts as 0.
Lanes powerOf(Lanes x, float exponent);

} // namespace limn
