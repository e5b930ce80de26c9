// SPDX-License-Identifier: MIT
// Computes B = albedo (E_direct + E_indirect) + pi L_e of every surfel, its change, and the brightest value.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/relight.glsl"

layout(std430, binding = RELIGHT_SURFELS) readonly buffer Surfels { GpuSurfel surfels[]; };
layout(std430, binding = RELIGHT_DIRECT) readonly buffer Direct { vec4 direct[]; };
layout(std430, binding = RELIGHT_ALBEDO) readonly buffer Albedo { vec4 albedo[]; };
layout(std430, binding = RELIGHT_EMITTED) readonly buffer Emitted { vec4 emitted[]; };
layout(std430, binding = RELIGHT_INDIRECT) readonly buffer Indirect { vec4 indirect[]; };
layout(std430, binding = RELIGHT_RADIOSITY) buffer Radiosity { vec4 radiosity[]; };
layout(std430, binding = RELIGHT_CHANGE) writeonly buffer Change { vec4 change[]; };

shared vec4 changes[kLanes];

void main() {
    const uint lane = gl_LocalInvocationIndex, i = itemIndex();
    changes[lane] = vec4(0);
    if (i < range.end) {
        const vec3 B = albedo[i].rgb * (direct[i].rgb + indirect[i].rgb) + emitted[i].rgb;
        const vec3 d = abs(B - radiosity[i].rgb);
        const float change = d.r + d.g + d.b, share = surfels[i].seenShare;
        // relativeChange() of engine/techniques/illuminance/relight/bouncing.h
        const float all = B.r + B.g + B.b;
        const float relative = change > 0.0 ? min(change / max(all, 1.1755e-38), 1.0) : 0.0;
        changes[lane] = vec4(vec2(change, all) * surfels[i].area, relative * share, max(B.r, max(B.g, B.b)));
        radiosity[i] = vec4(B, 0);
    }
    barrier();
    if (lane == 0 && i < range.end) { // in a fixed order, so that the same light gives the same bits
        vec3 sum = vec3(0);
        float brightest = 0.0;
        for (uint k = 0; k < kLanes; ++k) {
            sum += changes[k].xyz;
            brightest = max(brightest, changes[k].w);
        }
        change[range.changeBegin + groupIndex()] = vec4(sum, brightest);
    }
}
