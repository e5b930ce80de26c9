// SPDX-License-Identifier: MIT
// Computes the bounced irradiance of every surfel from the four caches around it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/relight.glsl"
#include "shaders/shared/sh_bands.glsl"

layout(std430, binding = RELIGHT_SURFELS) readonly buffer Surfels { GpuSurfel surfels[]; };
layout(std430, binding = RELIGHT_INDIRECT) writeonly buffer Indirect { vec4 indirect[]; };
layout(std430, binding = RELIGHT_SH) readonly buffer Sh { vec4 sh[]; };

const float kPi = 3.14159265358979;
// kIrradianceBands and their A_l of engine/math/sh.h.
const int kIrradianceBands = 3;
const float kIrradiance[kIrradianceBands] = float[](kPi, 2.0 / 3.0 * kPi, kPi / 4.0);

vec3 mixedCoefficient(GpuSurfel s, uint i) {
    vec3 mixed = vec3(0);
    [[unroll]] for (int k = 0; k < 4; ++k)
        if (s.cache[k] != ~0u)
            mixed += sh[s.cache[k] * kCoefficients + i].rgb * s.cacheWeight[k];
    return mixed;
}

void main() {
    const uint i = itemIndex();
    if (i >= range.end)
        return;
    const GpuSurfel s = surfels[i];
    float Y[kCoefficients];
    shBasis(s.normal, Y);
    vec3 E = vec3(0);
    [[unroll]] for (int l = 0; l < kIrradianceBands; ++l) {
        if (l >= kBands)
            continue;
        vec3 band = vec3(0);
        [[unroll]] for (int k = 0; k < 2 * kIrradianceBands - 1; ++k)
            if (k <= 2 * l)
                band += mixedCoefficient(s, l * l + k) * Y[l * l + k];
        E += band * kIrradiance[l];
    }
    indirect[i] = vec4(max(E, 0.0), 0);
}
