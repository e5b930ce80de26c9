// SPDX-License-Identifier: MIT
// Glossy reflection. engine/scene/specular.h and engine/math/lobe.h have the same.

const float kPi = 3.14159265358979;

/// Directional albedo of the specular lobe. Karis. Physically Based Shading on Mobile. 2014.
vec3 specularAlbedo(vec3 F0, float roughness, float NoV) {
    const vec4 r = roughness * vec4(-1, -0.0275, -0.572, 0.022) + vec4(1, 0.0425, 1.04, -0.04);
    const float a = min(r.x * r.x, exp2(-9.28 * NoV)) * r.x + r.y;
    return max(F0 * (-1.04 * a + r.z) + (1.04 * a + r.w), 0.0);
}

/// Exponent of the lobe about the mirrored direction. Karis. Specular BRDF Reference. 2013
float lobeExponent(float roughness) {
    const float alpha = max(roughness * roughness, 0.05);
    return max(2.0 / (alpha * alpha) - 2.0, 0.0);
}
