// SPDX-License-Identifier: MIT
#include "engine/techniques/light_skin/lanes.h"

namespace limn {

static Lanes fromBits(LaneBits bits) {
    Lanes v;
    std::memcpy(&v, &bits, sizeof v);
    return v;
}

Lanes powerOf(Lanes x, float exponent) {
    LaneBits bits;
    std::memcpy(&bits, &x, sizeof bits);
    // x = 2^e m, m in [sqrt(1/2), sqrt(2)).
    LaneBits e = (bits - 0x3f3504f3) >> 23;
    const Lanes m = fromBits(bits - (e << 23));
    // ln m = 2 artanh(s), s = (m - 1) / (m + 1), |s| < 0.172: the series' next term is below 2e-8.
    const Lanes s = (m - 1) / (m + 1), s2 = s * s;
    const Lanes ln = 2 * s * (1 + s2 * (1 / 3.f + s2 * (1 / 5.f + s2 * (1 / 7.f + s2 / 9))));
    const Lanes power = (__builtin_convertvector(e, Lanes) + ln * 1.44269504f) * exponent;
    const auto small = power < -123 || x < 1e-37f;
    // 2^power = 2^k e^f, |f| <= 0.347. The sum of the series up to f^7 is exact to 1e-8.
    const Lanes bounded = small ? Lanes{} - 123 : power;
    const LaneBits k = __builtin_convertvector(bounded - 0.5f, LaneBits); // towards 0: rounds
    const Lanes f = (bounded - __builtin_convertvector(k, Lanes)) * 0.69314718f;
    const Lanes exponential =
        1 +
        f * (1 + f * (1 / 2.f + f * (1 / 6.f + f * (1 / 24.f + f * (1 / 120.f +
                                                                    f * (1 / 720.f + f / 5040))))));
    const Lanes result = fromBits((k + 127) << 23) * exponential;
    return small ? Lanes{} : result;
}

} // namespace limn
