// SPDX-License-Identifier: MIT
// Vectors of LIMNRT_LANES lanes, one link per lane. See gather_range.h.
#pragma once

#include "engine/runtime/gather.h"

#include <cstring>

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
LIMNRT_INLINE Floats withSignOf(Floats v, Floats sign) {
    return bitsAs<Floats>(bitsAs<Ints>(v) | (bitsAs<Ints>(sign) & kSign));
}
/// 1 / sqrt(v) within some roundings: an estimate from the exponent, three steps of Newton's.
LIMNRT_INLINE Floats inverseRoot(Floats v) {
    Floats r = bitsAs<Floats>(0x5f375a86 - (bitsAs<Ints>(v) >> 1));
    const Floats half = v * 0.5f;
    r *= 1.5f - half * r * r;
    r *= 1.5f - half * r * r;
    return r * (1.5f - half * r * r);
}

#if LIMNRT_LANES == 4
constexpr Ints kLaneNumbers = {0, 1, 2, 3};
#elif LIMNRT_LANES == 8
constexpr Ints kLaneNumbers = {0, 1, 2, 3, 4, 5, 6, 7};
#else
constexpr Ints kLaneNumbers = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
#endif
typedef std::int32_t Int4 __attribute__((vector_size(16)));

/// kLanes / 4 vectors of four lanes as one.
template <class Quarter>
LIMNRT_INLINE auto joined(const Quarter* q) {
    if constexpr (kLanes == 4)
        return q[0];
    else if constexpr (kLanes == 8)
        return __builtin_shufflevector(q[0], q[1], 0, 1, 2, 3, 4, 5, 6, 7);
    else
        return __builtin_shufflevector(__builtin_shufflevector(q[0], q[1], 0, 1, 2, 3, 4, 5, 6, 7),
                                       __builtin_shufflevector(q[2], q[3], 0, 1, 2, 3, 4, 5, 6, 7),
                                       0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
}

/// The second and third words of some links: the direction; u and transport.
LIMNRT_INLINE void readWords(const Link* links, Ints& oct, Ints& cone) {
    Int4 octs[kLanes / 4], cones[kLanes / 4];
#pragma GCC unroll 4
    for (int k = 0; k < kLanes / 4; ++k) {
        const auto* words = reinterpret_cast<const char*>(links + 4 * k);
        Int4 a, b, c;
        std::memcpy(&a, words, 16);
        std::memcpy(&b, words + 16, 16);
        std::memcpy(&c, words + 32, 16);
        octs[k] = __builtin_shufflevector(__builtin_shufflevector(a, b, 1, 4, 7, 7), c, 0, 1, 2, 6);
        cones[k] =
            __builtin_shufflevector(__builtin_shufflevector(a, b, 2, 5, 5, 5), c, 0, 1, 4, 7);
    }
    oct = joined(octs);
    cone = joined(cones);
}

/// Values of halfs in the lower 16 bits, which are finite and >= 0.
LIMNRT_INLINE Floats halfsToFloats(Ints half) {
    const Floats normal = bitsAs<Floats>((half << 13) + (112 << 23)),
                 denormal = toFloats(half) * 0x1p-24f;
    return half < 0x400 ? denormal : normal;
}

} // namespace
} // namespace limn::runtime
