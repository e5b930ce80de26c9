// SPDX-License-Identifier: MIT
// Hemispherical maps for reflections: engine/techniques/radiance_volumes/glossy_map.h.

const float kGlossyPi = 3.14159265;

/// glossyFrame(): axes in columns, z towards the eye.
mat3 glossyFrame(vec3 toEye) {
    const float distance = length(toEye);
    const vec3 z = distance > 0.0 ? toEye / distance : vec3(0, 0, 1);
    const vec3 across = vec3(z.z, 0.0, -z.x);
    const float width = length(across);
    const vec3 x = width > 1e-6 ? across / width : vec3(1, 0, 0);
    return mat3(x, cross(z, x), z);
}

vec2 squareOfHemisphere(vec3 d) {
    const float radius = sqrt(max(1.0 - d.z, 0.0));
    const float distance = sqrt(d.x * d.x + d.y * d.y);
    if (!(distance > 0.0))
        return vec2(0.5);
    const vec2 p = d.xy * (radius / distance);
    const bool wide = abs(p.x) > abs(p.y);
    const vec2 q = wide ? p : p.yx;
    const float a = q.x < 0.0 ? -radius : radius;
    const float b = a * (4.0 / kGlossyPi) * atan(q.y / q.x);
    return clamp((wide ? vec2(a, b) : vec2(b, a)) * 0.5 + 0.5, 0.0, 1.0);
}

/// glossySplat(): the texel of the finest level that light from unit `direction` adds to, and the factor of its
/// perpendicular irradiance.
uint glossySplat(uint tile, bool microfacet, mat3 frame, vec3 direction, out float factor) {
    const vec3 sum = direction + frame[2];
    const float reach = length(sum);
    factor = 0.0;
    if (!(reach > 1e-6))
        return 0u;
    const vec3 h = sum / reach;
    const uvec2 texel = min(uvec2(squareOfHemisphere(h * frame) * float(tile)), uvec2(tile - 1u));
    const float cosine = dot(h, direction), exponent = float(tile * tile) - 1.0;
    factor = (microfacet ? (exponent + 2.0) / max(cosine, 1.0 / float(tile)) : cosine * (exponent + 8.0)) / (8.0 * kGlossyPi);
    return texel.y * tile + texel.x;
}

/// GlossyMapShape::levels(), firstTexel().
uint glossyLevels(uint tile) {
    return uint(findMSB(tile)) + 1u;
}

uint glossyFirstTexel(uint tile, uint level) {
    uint first = 0u;
    for (uint k = 0u; k < level; ++k)
        first += (tile >> k) * (tile >> k);
    return first;
}
