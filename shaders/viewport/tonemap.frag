// SPDX-License-Identifier: MIT
// Converts scene-referred linear Rec. 709 to sRGB-encoded display values.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/gpu_tonemap.h"

layout(push_constant) uniform Push { GpuTonemap push; };
layout(set = 0, binding = 0) uniform sampler2D linearImage;
layout(location = 0) out vec4 outColor;

// Stephen Hill's fit of the ACES reference and output transforms for sRGB displays (BakingLab, 2016).
vec3 aces(vec3 c) {
    const mat3 toAp1 = transpose(mat3(0.59719, 0.35458, 0.04823, 0.07600, 0.90834, 0.01566, 0.02840,
                                      0.13383, 0.83777));
    const mat3 toRec709 = transpose(mat3(1.60475, -0.53108, -0.07367, -0.10208, 1.10813, -0.00605,
                                         -0.00327, -0.07276, 1.07602));
    c = min(toAp1 * c, 1e4); // the quotient has reached its limit long before; its squares would overflow
    c = (c * (c + 0.0245786) - 0.000090537) / (c * (0.983729 * c + 0.4329510) + 0.238081);
    return clamp(toRec709 * c, 0.0, 1.0);
}

// Troy Sobotka's AgX, base look, in Rec. 2020 with Benjamin Wrensch's polynomial for the curve.
vec3 agx(vec3 c) {
    const mat3 toRec2020 = mat3(0.6274, 0.0691, 0.0164, 0.3293, 0.9195, 0.0880, 0.0433, 0.0113, 0.8956);
    const mat3 toRec709 =
        mat3(1.6605, -0.1246, -0.0182, -0.5876, 1.1329, -0.1006, -0.0728, -0.0083, 1.1187);
    const mat3 inset = mat3(0.856627153315983, 0.137318972929847, 0.11189821299995,
                            0.0951212405381588, 0.761241990602591, 0.0767994186031903,
                            0.0482516061458583, 0.101439036467562, 0.811302368396859);
    const mat3 outset = mat3(1.1271005818144368, -0.1413297634984383, -0.14132976349843826,
                             -0.11060664309660323, 1.157823702216272, -0.11060664309660294,
                             -0.016493938717834573, -0.016493938717834257, 1.2519364065950405);
    const float minEv = -12.47393, maxEv = 4.026069;
    c = inset * (toRec2020 * c);
    c = clamp((log2(max(c, 1e-10)) - minEv) / (maxEv - minEv), 0.0, 1.0);
    const vec3 c2 = c * c, c4 = c2 * c2;
    c = 15.5 * c4 * c2 - 40.14 * c4 * c + 31.96 * c4 - 6.868 * c2 * c + 0.4298 * c2 + 0.1191 * c - 0.00232;
    c = pow(max(outset * c, 0.0), vec3(2.2));
    return clamp(toRec709 * c, 0.0, 1.0);
}

// Khronos PBR Neutral Tone Mapper, 2024.
vec3 pbrNeutral(vec3 c) {
    const float startCompression = 0.8 - 0.04, desaturation = 0.15;
    const float x = min(c.r, min(c.g, c.b));
    c -= x < 0.08 ? x - 6.25 * x * x : 0.04;
    const float peak = max(c.r, max(c.g, c.b));
    if (peak < startCompression)
        return c;
    const float d = 1.0 - startCompression;
    const float newPeak = 1.0 - d * d / (peak + d - startCompression);
    c *= newPeak / peak;
    const float g = 1.0 - 1.0 / (desaturation * (peak - newPeak) + 1.0);
    return mix(c, vec3(newPeak), g);
}

vec3 encodeSrgb(vec3 c) {
    return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, greaterThan(c, vec3(0.0031308)));
}

// Whether a pixel near this one is NaN or Inf; a single pixel would be hard to see.
bool nearInvalid(ivec2 at) {
    const int reach = 2;
    const ivec2 last = textureSize(linearImage, 0) - 1;
    for (int y = -reach; y <= reach; ++y)
        for (int x = -reach; x <= reach; ++x) {
            const vec3 c = texelFetch(linearImage, clamp(at + ivec2(x, y), ivec2(0), last), 0).rgb;
            if (any(isnan(c)) || any(isinf(c)))
                return true;
        }
    return false;
}

void main() {
    vec3 c = texelFetch(linearImage, ivec2(gl_FragCoord.xy), 0).rgb * push.exposure;
    switch (push.curve) {
    case TONEMAP_ACES:
        c = aces(c);
        break;
    case TONEMAP_AGX:
        c = agx(c);
        break;
    case TONEMAP_PBR_NEUTRAL:
        c = pbrNeutral(c);
        break;
    }
    c = encodeSrgb(clamp(c, 0.0, 1.0));
    const float grey = dot(c, vec3(0.2126, 0.7152, 0.0722));
    outColor = vec4(mix(c, vec3(grey), push.fade) * (1.0 - 0.5 * push.fade), 1);
    if (push.invalid != 0u && nearInvalid(ivec2(gl_FragCoord.xy)))
        outColor = vec4(1, 0, 1, 1);
}
