// SPDX-License-Identifier: MIT
// Spherical harmonics with a number of bands that is fixed when the pipeline is created; real, orthonormal, no
// Condon-Shortley sign; index l(l+1)+m. The same steps as engine/math/sh_basis.h and engine/math/cone.h, in the same
// order.
#extension GL_EXT_control_flow_attributes : require
#include "shaders/shared/sh_normalisation.h"

#ifndef SH_BANDS_CONSTANT
#define SH_BANDS_CONSTANT 1
#endif
layout(constant_id = SH_BANDS_CONSTANT) const int kBands = 3;
const int kCoefficients = kBands * kBands;

const float kNormalisation[36] = float[](SH_NORMALISATION);

void shBasis(vec3 d, out float Y[kCoefficients]) {
    float c = 1.0, s = 0.0, qmm = 1.0;
    [[unroll]] for (int m = 0; m < kBands; ++m) {
        float q2 = 0.0, q1 = 0.0;
        // Starts at 0 and not at m, because loops of a fixed length can be unrolled.
        [[unroll]] for (int l = 0; l < kBands; ++l) {
            if (l < m)
                continue;
            const float q = l == m ? qmm
                                   : (float(2 * l - 1) * d.z * q1 - float(l + m - 1) * q2) * (1.0 / float(l - m));
            const float kq = kNormalisation[l * (l + 1) / 2 + m] * q;
            Y[l * (l + 1) + m] = kq * c;
            if (m > 0)
                Y[l * (l + 1) - m] = kq * s;
            q2 = q1;
            q1 = q;
        }
        const float cNext = c * d.x - s * d.y;
        s = s * d.x + c * d.y;
        c = cNext;
        qmm *= float(2 * m + 1);
    }
}

/// Factors g_l of a cone of directions with u = 1 - cos(half-angle).
void coneFactors(float u, out float g[kBands]) {
    const float x = 1.0 - u;
    g[0] = 1.0;
    float d2 = 0.0, d1 = 0.0;
    [[unroll]] for (int l = 1; l < kBands; ++l) {
        const float d = l == 1 ? 1.0 : (float(2 * l - 1) * x * d1 - float(l) * d2) * (1.0 / float(l - 1));
        g[l] = (2.0 - u) * d * (1.0 / float(l * (l + 1)));
        d2 = d1;
        d1 = d;
    }
}
