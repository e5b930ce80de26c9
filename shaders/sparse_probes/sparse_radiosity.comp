// SPDX-License-Identifier: MIT
// Computes the radiance that receivers send, L = albedo / pi (E_direct + E_bounced) + L_e, its change and the brightest
// value.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/sparse.glsl"

layout(std430, binding = SPARSE_RECEIVERS) readonly buffer Receivers { GpuReceiver receivers[]; };
layout(std430, binding = SPARSE_DIRECT) readonly buffer Direct { vec4 direct[]; };
layout(std430, binding = SPARSE_ALBEDO) readonly buffer Albedo { vec4 albedo[]; };
layout(std430, binding = SPARSE_EMISSION) readonly buffer Emission { vec4 emission[]; };
layout(std430, binding = SPARSE_IRRADIANCE) readonly buffer Irradiance { vec4 irradiance[]; };
layout(std430, binding = SPARSE_RADIANCE) buffer Radiance { vec4 radiance[]; };
layout(std430, binding = SPARSE_CHANGE) writeonly buffer Change { vec4 change[]; };

const float kPi = 3.14159265358979;

shared vec4 changes[kLanes];

void main() {
    const uint lane = gl_LocalInvocationIndex, r = itemIndex();
    changes[lane] = vec4(0);
    if (r < range.end) {
        const vec3 L = albedo[r].rgb / kPi * (direct[r].rgb + irradiance[r].rgb) + emission[r].rgb;
        const vec3 d = abs(L - radiance[r].rgb);
        const float changed = d.r + d.g + d.b, all = L.r + L.g + L.b;
        // relativeChange() of engine/lighting/convergence.h
        const float relative = changed > 0.0 ? min(changed / max(all, 1.1755e-38), 1.0) : 0.0;
        changes[lane] = vec4(vec3(changed, all, relative) * receivers[r].share, max(L.r, max(L.g, L.b)));
        radiance[r] = vec4(L, 0);
    }
    barrier();
    if (lane == 0 && r < range.end) { // in a fixed order, so that the same light gives the same bits
        vec3 sum = vec3(0);
        float brightest = 0.0;
        for (uint k = 0; k < kLanes; ++k) {
            sum += changes[k].xyz;
            brightest = max(brightest, changes[k].w);
        }
        change[groupIndex()] = vec4(sum, brightest);
    }
}
