// SPDX-License-Identifier: MIT
#pragma once

#include "engine/math/sh_basis.h"

#include <array>
#include <cstddef>

namespace limn {

/// (l-1-m)(l-1+m) / ((2l-1)(2l-3)): q_l^m = x q_{l-1}^m - beta q_{l-2}^m, q_m^m = 1, are the
/// associated Legendre polynomials without (1-x^2)^{m/2} and with leading coefficients of 1.
constexpr float monicBeta(int l, int m) {
    return float(double((l - 1 - m) * (l - 1 + m)) / double((2 * l - 1) * (2 * l - 3)));
}

/// The factors that these omit from Y_lm and from a cone's factor of band l, at l(l+1)+m.
constexpr auto monicScales() {
    std::array<float, kMaxCoefficients> scale{};
    double odd = 1, factorial = 1; // (2l-1)!!, l!
    for (int l = 0; l < kMaxBands; ++l) {
        if (l > 0)
            odd *= 2 * l - 1, factorial *= l;
        const double cone = l > 0 ? odd / (factorial * (l + 1)) : 1;
        double below = factorial; // (l-m)!
        for (int m = 0; m <= l; ++m) {
            if (m > 0)
                below /= l - m + 1;
            const double k = double(sh_detail::kNormalisation[std::size_t(l * (l + 1) / 2 + m)]);
            scale[std::size_t(l * (l + 1) + m)] = scale[std::size_t(l * (l + 1) - m)] =
                float(k * cone * odd / below);
        }
    }
    return scale;
}
inline constexpr auto kMonicScale = monicScales();

/// Sets of orders m of harmonics, of both signs: bit |m|.
using Orders = unsigned;
inline constexpr Orders kEveryOrder = ~0u, kEvenOrders = 0x55, kOddOrders = 0xaa;

constexpr bool contains(Orders orders, int m) {
    return (orders >> (m < 0 ? -m : m) & 1) != 0;
}

} // namespace limn
