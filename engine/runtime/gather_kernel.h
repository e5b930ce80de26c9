// SPDX-License-Identifier: MIT
// The harmonics of links, one link per lane. See gather_sums.h.
#pragma once

#include "engine/runtime/gather.h"

#include <cstring>
#include <utility>

#ifndef LIMNRT_LANES
#define LIMNRT_LANES 4
#endif

namespace limn::runtime {
namespace {

constexpr int kLanes = LIMNRT_LANES;
typedef float Floats __attribute__((vector_size(4 * kLanes)));
typedef std::int32_t Ints __attribute__((vector_size(4 * kLanes)));

#define LIMNRT_INLINE inline __attribute__((always_inline))

template <class To, class From>
LIMNRT_INLINE To bitsAs(From v) {
    static_assert(sizeof(To) == sizeof(From));
    To to;
    std::memcpy(&to, &v, sizeof to);
    return to;
}
LIMNRT_INLINE Floats all(float v) {
    return v - Floats{};
}
LIMNRT_INLINE Floats toFloats(Ints v) {
    return __builtin_convertvector(v, Floats);
}

constexpr std::int32_t kSign = std::int32_t(0x80000000U);
LIMNRT_INLINE Floats magnitude(Floats v) {
    return bitsAs<Floats>(bitsAs<Ints>(v) & ~kSign);
}
/// `v` >= 0 with the sign of another.
LIMNRT_INLINE Floats withSignOf(Floats v, Floats of) {
    return bitsAs<Floats>(bitsAs<Ints>(v) | (bitsAs<Ints>(of) & kSign));
}
/// 1 / sqrt(v) within some roundings: an estimate from the exponent, three steps of Newton's.
LIMNRT_INLINE Floats inverseRoot(Floats v) {
    Floats r = bitsAs<Floats>(0x5f375a86 - (bitsAs<Ints>(v) >> 1));
    const Floats half = v * 0.5f;
    r *= 1.5f - half * r * r;
    r *= 1.5f - half * r * r;
    return r * (1.5f - half * r * r);
}

/// Every third word of three vectors in a row, from the word `At` on.
template <int At, std::size_t... K>
LIMNRT_INLINE Ints everyThird(Ints a, Ints b, Ints c, std::index_sequence<K...>) {
    const Ints low =
        __builtin_shufflevector(a, b, (3 * int(K) + At < 2 * kLanes ? 3 * int(K) + At : 0)...);
    return __builtin_shufflevector(
        low, c, (3 * int(K) + At < 2 * kLanes ? int(K) : kLanes + 3 * int(K) + At - 2 * kLanes)...);
}

/// Values of halfs in the lower 16 bits, which are finite and >= 0.
LIMNRT_INLINE Floats halfsToFloats(Ints half) {
    const Floats normal = bitsAs<Floats>((half << 13) + (112 << 23)),
                 denormal = toFloats(half) * 0x1p-24f;
    return half < 0x400 ? denormal : normal;
}

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

template <int Bands>
LIMNRT_INLINE void readCones(const Link* links, Cones<Bands>& cones) {
    Ints words[3];
    std::memcpy(words, links, sizeof words);
    const auto lanes = std::make_index_sequence<kLanes>();
    const Ints oct = everyThird<1>(words[0], words[1], words[2], lanes),
               cone = everyThird<2>(words[0], words[1], words[2], lanes);
    Floats x = toFloats((oct << 16) >> 16), y = toFloats(oct >> 16);
    const Floats z = 32767.f - magnitude(x) - magnitude(y);
    const Floats fold = z < 0.f ? -z : Floats{};
    x -= withSignOf(fold, x);
    y -= withSignOf(fold, y);
    const Floats inverse = inverseRoot(x * x + y * y + z * z);
    cones.x = x * inverse, cones.y = y * inverse, cones.z = z * inverse;
    const Floats u = halfsToFloats(cone & 0xffff), transport = halfsToFloats((cone >> 16) & 0xffff);
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
