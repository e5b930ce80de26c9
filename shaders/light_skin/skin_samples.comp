// SPDX-License-Identifier: MIT
// Finds what a picture shows at the first points of a Halton sequence, or whether it shows light caches, as
// samplesOfView() and seenCaches() of engine/techniques/light_skin/view_samples.cpp.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/compute_groups.glsl"
#include "shaders/shared/gpu_skin_steps.h"
#include "shaders/shared/surface_pack.glsl"
#include "shaders/shared/halton.glsl"

layout(constant_id = 1) const bool kCaches = false;

layout(push_constant) uniform Push { GpuSkinView view; };
layout(binding = RSM_SURFACE) uniform usampler2D surfaceMap;
layout(binding = RSM_DEPTH) uniform sampler2D depthMap;
layout(std430, binding = SKIN_STEP_SAMPLES) buffer Samples { GpuViewSample samples[]; };

void main() {
    const uint i = groupIndex() * kLanes + gl_LocalInvocationID.x;
    if (i >= view.samples)
        return;
    ivec2 pixel = ivec2(min(haltonPoint(i) * vec2(view.size), vec2(view.size) - 1.0));
    if (kCaches)
        pixel = ivec2(samples[i].pixel & 0xffffu, samples[i].pixel >> 16);
    const float depth = texelFetch(depthMap, pixel, 0).r;
    const uvec4 surface = texelFetch(surfaceMap, pixel, 0);
    const vec3 normal = octDecode(unpackSnorm2x16(surface.w)), detail = octDecode(unpackSnorm2x16(surface.z));
    const vec2 ndc = 2.0 * (vec2(pixel) + 0.5) / vec2(view.size) - 1.0;
    const vec4 p = view.fromClip * vec4(ndc.x, -ndc.y, depth, 1.0);
    const bool found = depth > 0.0 && dot(normal, detail) > -0.99; // as surface.frag marks backs
    const vec3 position = found ? p.xyz / p.w : vec3(0);
    if (kCaches) {
        const vec3 way = position - samples[i].position;
        const bool seen = found && length(way) <= view.near && abs(dot(way, normal)) <= SKIN_SEEN_SHARE * view.near;
        samples[i].found = seen ? 1.0 : 0.0;
        return;
    }
    const bool away = dot(normal, position - view.eye) > 0.0; // maps know no eye
    samples[i] = GpuViewSample(position, found ? 1.0 : 0.0, away ? -normal : normal, 0u);
}
