// SPDX-License-Identifier: MIT
// Computes the radiosity of inner nodes from that of their children, on the levels [range.begin, range.end) of the
// tree: one level by many workgroups, or many levels by one workgroup.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/relight.glsl"

layout(std430, binding = RELIGHT_RADIOSITY) coherent buffer Radiosity { vec4 radiosity[]; };
layout(std430, binding = RELIGHT_INNER_NODES) readonly buffer InnerNodes { GpuInnerNode nodes[]; };
layout(std430, binding = RELIGHT_LEVELS) readonly buffer Levels { uint levelBegin[]; };

void main() {
    const uint first = groupIndex() * kLanes + gl_LocalInvocationIndex;
    const uint step = gl_NumWorkGroups.x * gl_NumWorkGroups.y * kLanes;
    for (uint level = range.begin; level < range.end; ++level) {
        for (uint k = levelBegin[level] + first; k < levelBegin[level + 1]; k += step) {
            const GpuInnerNode n = nodes[k];
            const vec3 l = radiosity[n.left].rgb, r = radiosity[n.right].rgb;
            // Not r + (l - r) w: a lamp in r of weight 0 would leave its rounding error in a dark l.
            radiosity[n.node] = vec4(l * n.leftWeight + r * (1.0 - n.leftWeight), 0);
        }
        memoryBarrierBuffer();
        barrier();
    }
}
