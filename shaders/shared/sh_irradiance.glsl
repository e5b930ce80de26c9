// SPDX-License-Identifier: MIT
// Spherical harmonics of radiance, 3 bands, real, orthonormal, no Condon-Shortley sign; index l(l+1)+m.

const float kPi = 3.14159265358979;

void shBasis(vec3 d, out float Y[9]) {
    Y[0] = 0.282094792;
    Y[1] = 0.488602512 * d.y;
    Y[2] = 0.488602512 * d.z;
    Y[3] = 0.488602512 * d.x;
    Y[4] = 1.092548431 * d.x * d.y;
    Y[5] = 1.092548431 * d.y * d.z;
    Y[6] = 0.315391565 * (3.0 * d.z * d.z - 1.0);
    Y[7] = 1.092548431 * d.x * d.z;
    Y[8] = 0.546274215 * (d.x * d.x - d.y * d.y);
}

/// Sum over bands of A_l times the band of SH c in direction d.
vec3 shEvaluate(vec3 c[9], vec3 d, vec3 A) {
    float Y[9];
    shBasis(d, Y);
    vec3 sum = A.x * c[0] * Y[0];
    for (int i = 1; i < 4; ++i)
        sum += A.y * c[i] * Y[i];
    for (int i = 4; i < 9; ++i)
        sum += A.z * c[i] * Y[i];
    return max(sum, 0.0);
}

/// Irradiance [W m^-2] on a plane facing n.
vec3 shIrradiance(vec3 c[9], vec3 n) {
    return shEvaluate(c, n, vec3(kPi, 2.0 / 3.0 * kPi, kPi / 4.0));
}

/// Mean radiance in the normalised lobe cos^e about d: s_0 = 1, s_1 = (e+1)/(e+2), s_2 = e/(e+3).
vec3 shLobe(vec3 c[9], vec3 d, float e) {
    return shEvaluate(c, d, vec3(1, (e + 1.0) / (e + 2.0), e / (e + 3.0)));
}
