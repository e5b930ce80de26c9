// SPDX-License-Identifier: MIT
// All probes' harmonics as the steps that gather them read them: from shared memory where they fit into it. Needs
// sparse.glsl.

layout(constant_id = 3) const uint kCached = 1; // values of all rows in shared memory; 1: they do not fit

layout(std430, binding = SPARSE_PROBES) readonly buffer Probes { vec4 probes[]; };

shared float cached[3 * kCached];

/// Fills the shared memory. Every lane calls it before any reads.
void cacheProbes() {
    if (kCached == 1)
        return;
    for (uint k = gl_LocalInvocationIndex; k < kCached; k += kLanes) {
        const vec3 p = probes[k].rgb;
        cached[3 * k] = p.r;
        cached[3 * k + 1] = p.g;
        cached[3 * k + 2] = p.b;
    }
    barrier();
}

/// Value `k` of all rows.
vec3 harmonic(uint k) {
    if (kCached == 1)
        return probes[k].rgb;
    return vec3(cached[3 * k], cached[3 * k + 1], cached[3 * k + 2]);
}
