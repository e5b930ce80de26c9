// SPDX-License-Identifier: MIT
// What surfaces make of spherical harmonics of radiance, kBands of them: sums of coefficients by the weights that are
// worked out here. Needs specular.glsl and sh_bands.glsl.

/// Of irradiance [W m^-2] on a plane facing n: of the first three bands, the others 0.
void irradianceWeights(vec3 n, out float w[kCoefficients]) {
    const float A[3] = float[](kPi, 2.0 / 3.0 * kPi, kPi / 4.0);
    shBasis(n, w);
    [[unroll]] for (int l = 0; l < kBands; ++l)
        [[unroll]] for (int i = l * l; i < (l + 1) * (l + 1); ++i)
            w[i] *= l < 3 ? A[l < 3 ? l : 0] : 0.0;
}

/// Of mean radiance in the lobe cos^n about d: windowedLobeFactors() of engine/math/lobe.h.
void lobeWeights(vec3 d, float n, out float w[kCoefficients]) {
    const float kMirrorBlur[9] = float[](0.0, 0.0, 0.20273, 0.12417, 0.09887, 0.02879, 0.02643, 0.01244, 0.00910);
    // exp(-2 t) of the window exp(-t l (l + 1)), t = max(blur - log((n + 2) / (n + 1)) / 2, 0).
    const float window = min(exp(-2.0 * kMirrorBlur[kBands]) * ((n + 2.0) / (n + 1.0)), 1.0);
    float s[kBands];
    s[0] = 1.0;
    s[1] = (n + 1.0) / (n + 2.0);
    [[unroll]] for (int l = 2; l < kBands; ++l)
        s[l] = s[l - 2] * (n + 2.0 - float(l)) / (n + float(l) + 1.0);
    shBasis(d, w);
    float step = 1.0, windowed = 1.0; // window^l, window^(l (l + 1) / 2)
    [[unroll]] for (int l = 0; l < kBands; ++l) {
        step *= l == 0 ? 1.0 : window;
        windowed *= step;
        const float factor = s[l] * windowed;
        [[unroll]] for (int i = l * l; i < (l + 1) * (l + 1); ++i)
            w[i] *= factor;
    }
}
