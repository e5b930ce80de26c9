// SPDX-License-Identifier: MIT
#pragma once

#include "engine/math/sh.h"

#include <array>
#include <numbers>

namespace limn {

namespace sh_detail {

constexpr double root(double x) {
    double r = x > 1 ? x : 1;
    for (int i = 0; i < 64; ++i)
        r = (r + x / r) / 2;
    return r;
}

/// K_lm = sqrt((2l+1)/4pi (l-m)!/(l+m)!), times sqrt(2) for m > 0, at l(l+1)/2 + m.
constexpr auto normalisation() {
    std::array<float, kMaxBands*(kMaxBands + 1) / 2> k{};
    for (int l = 0; l < kMaxBands; ++l) {
        double ratio = 1; // (l-m)!/(l+m)!
        for (int m = 0; m <= l; ++m) {
            if (m > 0)
                ratio /= double(l + m) * double(l - m + 1);
            const double square = (2 * l + 1) / (4 * std::numbers::pi) * ratio * (m > 0 ? 2 : 1);
            k[std::size_t(l * (l + 1) / 2 + m)] = float(root(square));
        }
    }
    return k;
}

inline constexpr auto kNormalisation = normalisation();

} // namespace sh_detail

/// shBasis() for a number of bands known at compile time, for inner loops. `d` needs to be unit up
/// to rounding only.
template <int Bands>
inline void shBasisFixed(glm::vec3 d, float* y) {
    // P_l^m = sin^m(theta) Q_l^m(z); c and s are the real and imaginary parts of (x + iy)^m, which
    // contain the sin^m. Q_m^m = (2m-1)!!, Q_{m+1}^m = (2m+1) z Q_m^m, (l-m) Q_l^m = (2l-1) z
    // Q_{l-1}^m - (l+m-1) Q_{l-2}^m.
    float c = 1, s = 0, qmm = 1;
    for (int m = 0; m < Bands; ++m) {
        float q2 = 0, q1 = 0;
        for (int l = m; l < Bands; ++l) {
            const float q = l == m ? qmm
                                   : (float(2 * l - 1) * d.z * q1 - float(l + m - 1) * q2) *
                                         (1.f / float(l - m));
            const float kq = sh_detail::kNormalisation[std::size_t(l * (l + 1) / 2 + m)] * q;
            y[l * (l + 1) + m] = kq * c;
            if (m > 0)
                y[l * (l + 1) - m] = kq * s;
            q2 = q1;
            q1 = q;
        }
        const float cNext = c * d.x - s * d.y;
        s = s * d.x + c * d.y;
        c = cNext;
        qmm *= float(2 * m + 1);
    }
}

/// Calls f.operator()<Bands>() for a number of bands known at run time, in [1, kMaxBands].
template <class F>
decltype(auto) withBands(int bands, F&& f) {
    switch (bands) {
    case 1:
        return f.template operator()<1>();
    case 2:
        return f.template operator()<2>();
    case 3:
        return f.template operator()<3>();
    case 4:
        return f.template operator()<4>();
    case 5:
        return f.template operator()<5>();
    case 6:
        return f.template operator()<6>();
    case 7:
        return f.template operator()<7>();
    default:
        return f.template operator()<8>();
    }
}

} // namespace limn
