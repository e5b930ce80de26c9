// SPDX-License-Identifier: MIT
#pragma once

namespace limn {

/// Factors g_l per band of a cone of directions with u = 1 - cos(half-angle) = solid angle / 2 pi,
/// u in [0, 2]: the mean of Y_lm over the cone about d is g_l Y_lm(d). g_0 = 1, g_l = (2-u)
/// P_l'(1-u) / (l(l+1)). Exact to rounding for every u, whereas forms in cos(half-angle) lose all
/// digits as u -> 0. bands in [1, kMaxBands]. These are the zonal coefficients of Jendersie, Kuri,
/// Grosch. Real-Time Global Illumination Using Precomputed Illuminance Composition with Chrominance
/// Compression. 2016, eq. for the cone projection, divided by the cone's solid angle.
inline void coneFactors(int bands, float u, float* g) {
    const float x = 1 - u;
    g[0] = 1;
    // Recurrence (l-1) P_l' = (2l-1) x P_{l-1}' - l P_{l-2}', the derivative of the Legendre
    // recurrence.
    float d2 = 0, d1 = 0;
    for (int l = 1; l < bands; ++l) {
        const float d =
            l == 1 ? 1.f : (float(2 * l - 1) * x * d1 - float(l) * d2) * (1.f / float(l - 1));
        g[l] = (2 - u) * d * (1.f / float(l * (l + 1)));
        d2 = d1;
        d1 = d;
    }
}

} // namespace limn
