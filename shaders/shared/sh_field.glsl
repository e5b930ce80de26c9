// SPDX-License-Identifier: MIT
// Light that surfaces receive from spherical harmonics of radiance with kBands bands: sums of the coefficients times
// the weights computed here. Needs kPi of specular.glsl, and sh_bands.glsl.
#include "shaders/shared/horizon.h"

/// Weights of irradiance [W m^-2] on a plane facing n. Only the first three bands have weights other than 0.
void irradianceWeights(vec3 n, out float w[kCoefficients]) {
    const float A[3] = float[](kPi, 2.0 / 3.0 * kPi, kPi / 4.0);
    shBasis(n, w);
    [[unroll]] for (int l = 0; l < kBands; ++l)
        [[unroll]] for (int i = l * l; i < (l + 1) * (l + 1); ++i)
            w[i] *= l < 3 ? A[l < 3 ? l : 0] : 0.0;
}

/// First four coefficients of light of radiance 1 below a surface with unit normal n.
vec4 belowSurface(vec3 n) {
    return vec4(BELOW_C0, -BELOW_C1 * n.yzx);
}

/// Weights of the first four coefficients in the radiance with which light continues below: horizonRadiance() of
/// engine/math/horizon.h.
vec4 horizonRadiance(vec3 n) {
    return vec4(HORIZON_C0, HORIZON_C1 * n.yzx);
}

/// Changes weights of light above a surface with unit normal n into those of light that continues below it: weighCut()
/// of engine/math/horizon.h.
void weighCut(vec3 n, inout float w[kCoefficients]) {
    const vec4 ofBelow = belowSurface(n), from = horizonRadiance(n);
    float below = 0.0;
    [[unroll]] for (int i = 0; i < 4; ++i)
        below -= ofBelow[i] * w[i] / HORIZON_GAIN;
    [[unroll]] for (int i = 0; i < 4; ++i)
        w[i] += below * from[i];
}

/// s_l w_l: windowedFactors() of engine/math/lobe.h.
void windowFactors(inout float s[8]) {
    const float kMirrorBlur[9] = float[](0.0, 0.0, 0.20273, 0.12417, 0.09887, 0.02879, 0.02643, 0.01244, 0.00910);
    // exp(-2 t) of the window exp(-t l (l + 1)), t = max(blur - own, 0), own = -log(last band) / (bands (bands - 1)).
    const float window = min(exp(-2.0 * kMirrorBlur[kBands]) *
                                 pow(max(s[kBands - 1], 1e-3), -2.0 / float(kBands * (kBands - 1))),
                             1.0);
    float step = 1.0, windowed = 1.0; // window^l, window^(l (l + 1) / 2)
    [[unroll]] for (int l = 1; l < kBands; ++l) {
        step *= window;
        windowed *= step;
        s[l] *= windowed;
    }
}

/// Weights of the mean radiance in a rotationally symmetric lobe with factors s about d.
void lobeWeights(vec3 d, float s[8], out float w[kCoefficients]) {
    shBasis(d, w);
    [[unroll]] for (int l = 1; l < kBands; ++l)
        [[unroll]] for (int i = l * l; i < (l + 1) * (l + 1); ++i)
            w[i] *= s[l];
}

/// hemisphereSeen() of engine/math/lobe.h.
float hemisphereSeen(float s[8], float cosine) {
    const float kHalf[8] = float[](0.5, 0.75, 0.0, -7.0 / 16.0, 0.0, 11.0 / 32.0, 0.0, -75.0 / 256.0);
    float sum = kHalf[0], before = 1.0, p = cosine;
    [[unroll]] for (int l = 1; l < kBands; ++l) {
        sum += kHalf[l] * s[l] * p;
        const float next = (float(2 * l + 1) * cosine * p - float(l) * before) / float(l + 1);
        before = p;
        p = next;
    }
    return max(sum, 0.5);
}
