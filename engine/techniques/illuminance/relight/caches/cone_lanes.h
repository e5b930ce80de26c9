// SPDX-License-Identifier: MIT
// Reads links of LinkStorage::Rtp, one per lane. Included once for each kind of vector unit, after
// <hwy/highway.h>.
#include "engine/math/packing.h"
#include "engine/techniques/illuminance/format/bake.h"
#include "engine/techniques/illuminance/relight/caches/monic_harmonics.h"

#include <type_traits>

#include <hwy/highway.h>

#if defined(LIMN_CONE_LANES) == defined(HWY_TARGET_TOGGLE)
#ifdef LIMN_CONE_LANES
#undef LIMN_CONE_LANES
#else
#define LIMN_CONE_LANES
#endif

HWY_BEFORE_NAMESPACE();
namespace limn {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using V = hn::Vec<Floats>;

#ifndef LIMN_UNROLLED
/// For lambdas whose variables must stay in registers.
#define LIMN_UNROLLED __attribute__((always_inline))
#endif

template <int I>
using Number = std::integral_constant<int, I>;

/// Calls f(Number<Begin>()) … f(Number<End - 1>()): loops over registers, which have no addresses.
template <int Begin, int End, class F>
HWY_INLINE void unrolled(const F& f) {
    if constexpr (Begin < End) {
        f(Number<Begin>());
        unrolled<Begin + 1, End>(f);
    }
}

/// Factors of the bands for cones of u = 1 - cos(half-angle), times `transport`: as coneFactors,
/// up to constants.
template <int Bands>
HWY_INLINE void coneBands(Floats d, V u, V transport, V* factor) {
    const V x = hn::Sub(hn::Set(d, 1.f), u);
    factor[0] = transport;
    factor[1] = hn::NegMulAdd(u, transport, hn::Add(transport, transport));
    if constexpr (Bands > 2)
        factor[2] = hn::Mul(x, factor[1]);
    unrolled<3, Bands>([&](auto l) LIMN_UNROLLED {
        factor[l] =
            hn::NegMulAdd(hn::Set(d, monicBeta(l, 1)), factor[l - 2], hn::Mul(x, factor[l - 1]));
    });
}

/// Calls add(Number<i>(), value) for the spherical harmonics of those orders of unit directions,
/// each band times its factor: as shBasisFixed, up to constants.
template <int Bands, Orders Of = kEveryOrder, class Add>
HWY_INLINE void basisOf(Floats d, V x, V y, V z, const V* factor, const Add& add) {
    V c = x, s = y;
    unrolled<0, Bands>([&](auto m) LIMN_UNROLLED {
        V q2 = hn::Set(d, 1.f), q1 = z;
        unrolled<contains(Of, m) ? m : Bands, Bands>([&](auto l) LIMN_UNROLLED {
            V q = factor[l];
            if constexpr (l > m + 1) {
                const V next = hn::NegMulAdd(hn::Set(d, monicBeta(l, m)), q2, hn::Mul(z, q1));
                q2 = q1;
                q1 = next;
            }
            if constexpr (l > m)
                q = hn::Mul(q, q1);
            if constexpr (m == 0) {
                add(Number<l*(l + 1)>(), q);
            } else {
                add(Number<l*(l + 1) + m>(), hn::Mul(q, c));
                add(Number<l*(l + 1) - m>(), hn::Mul(q, s));
            }
        });
        if constexpr (m > 0) {
            const V cNext = hn::NegMulAdd(s, y, hn::Mul(c, x));
            s = hn::MulAdd(s, x, hn::Mul(c, y));
            c = cNext;
        }
    });
}

/// 1 / sqrt(v) within some roundings.
HWY_INLINE V inverseRoot(Floats d, V v) {
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
    const V near = hn::ApproximateReciprocalSqrt(v); // 12 or 14 bits
    return hn::Mul(hn::Mul(near, hn::Set(d, 0.5f)),
                   hn::NegMulAdd(hn::Mul(v, near), near, hn::Set(d, 3.f)));
#else
    return hn::Div(hn::Set(d, 1.f), hn::Sqrt(v));
#endif
}

/// The cones of some links: unit axes and factors of the bands.
template <int Bands>
struct Cones {
    V x, y, z, factor[Bands];
};

/// Unpacks one link per lane.
template <int Bands>
HWY_INLINE void readCones(Floats d, const Link* links, Cones<Bands>& cones) {
    const hn::RebindToUnsigned<Floats> du;
    const hn::RebindToSigned<Floats> di;
    hn::Vec<decltype(du)> node, oct, cone;
    hn::LoadInterleaved3(du, reinterpret_cast<const std::uint32_t*>(links), node, oct, cone);
    V x = hn::ConvertTo(d, hn::ShiftRight<16>(hn::BitCast(di, hn::ShiftLeft<16>(oct)))),
      y = hn::ConvertTo(d, hn::ShiftRight<16>(hn::BitCast(di, oct)));
    const V z = hn::Sub(hn::Sub(hn::Set(d, 32767.f), hn::Abs(x)), hn::Abs(y));
    const V fold = hn::Max(hn::Neg(z), hn::Zero(d));
    x = hn::Sub(x, hn::CopySignToAbs(fold, x));
    y = hn::Sub(y, hn::CopySignToAbs(fold, y));
    const V inverse = inverseRoot(d, hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z))));
#if HWY_TARGET == HWY_SCALAR
    const V u = hn::Set(d, halfToFloat(links->u)),
            transport = hn::Set(d, halfToFloat(links->transport));
#else
    const hn::Repartition<hwy::float16_t, Floats> dh;
    const auto halfs = hn::BitCast(dh, cone);
    const V low = hn::PromoteTo(d, hn::LowerHalf(halfs)),
            high = hn::PromoteTo(d, hn::UpperHalf(hn::Half<decltype(dh)>(), halfs));
    const V u = hn::ConcatEven(d, high, low), transport = hn::ConcatOdd(d, high, low);
#endif
    cones.x = hn::Mul(x, inverse), cones.y = hn::Mul(y, inverse), cones.z = hn::Mul(z, inverse);
    coneBands<Bands>(d, u, transport, cones.factor);
}

} // namespace HWY_NAMESPACE
} // namespace limn
HWY_AFTER_NAMESPACE();

#endif
