// SPDX-License-Identifier: MIT
// The harmonics of links, one link per lane. See gather_range.h.
#pragma once

#include "engine/runtime/lanes.h"

namespace limn::runtime {
namespace {

/// (l-1-m)(l-1+m) / ((2l-1)(2l-3)): q_l = z q_{l-1} - beta q_{l-2} are the associated Legendre
/// polynomials of order m without (1-z^2)^{m/2} and with leading coefficients of 1.
constexpr float monicBeta(int l, int m) {
    return float(double((l - 1 - m) * (l - 1 + m)) / double((2 * l - 1) * (2 * l - 3)));
}

/// The links of some lanes: axis and factors of the bands, up to the constants of monicScale().
template <int Bands>
struct Cones {
    Floats x, y, z, factor[Bands];
};

/// Links from `count` on get no transport.
template <int Bands>
LIMNRT_INLINE void readCones(const Link* links, std::uint32_t count, Cones<Bands>& cones) {
    Ints oct, cone;
    readWords(links, oct, cone);
    Floats x = toFloats((oct << 16) >> 16), y = toFloats(oct >> 16);
    const Floats z = 32767.f - magnitude(x) - magnitude(y);
    const Floats fold = z < 0.f ? -z : Floats{};
    x -= withSignOf(fold, x);
    y -= withSignOf(fold, y);
    const Floats inverse = inverseRoot(x * x + y * y + z * z);
    cones.x = x * inverse, cones.y = y * inverse, cones.z = z * inverse;
    const Floats u = halfsToFloats(cone & 0xffff);
    Floats transport = halfsToFloats((cone >> 16) & 0xffff);
    if (count < std::uint32_t(kLanes))
        transport = kLaneNumbers < int(count) ? transport : Floats{};
    const Floats cosine = 1.f - u;
    cones.factor[0] = transport;
    cones.factor[1] = (2.f - u) * transport;
    if constexpr (Bands > 2)
        cones.factor[2] = cosine * cones.factor[1];
    for (int l = 3; l < Bands; ++l)
        cones.factor[l] = cosine * cones.factor[l - 1] - monicBeta(l, 1) * cones.factor[l - 2];
}

/// Writes the harmonics times the bands' factors, up to constants.
template <int Bands>
LIMNRT_INLINE void writeBasis(const Cones<Bands>& cones, Floats* basis) {
    Floats c = cones.x, s = cones.y; // r^m cos(m phi), r^m sin(m phi)
#pragma GCC unroll 8
    for (int m = 0; m < Bands; ++m) {
        Floats before = all(1), q = cones.z;
#pragma GCC unroll 8
        for (int l = m; l < Bands; ++l) {
            Floats value = cones.factor[l];
            if (l > m + 1) {
                const Floats next = cones.z * q - monicBeta(l, m) * before;
                before = q;
                q = next;
            }
            if (l > m)
                value *= q;
            basis[l * (l + 1) + m] = m == 0 ? value : value * c;
            if (m > 0)
                basis[l * (l + 1) - m] = value * s;
        }
        if (m > 0) {
            const Floats next = c * cones.x - s * cones.y;
            s = s * cones.x + c * cones.y;
            c = next;
        }
    }
}

} // namespace
} // namespace limn::runtime
