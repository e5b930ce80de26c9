// SPDX-License-Identifier: MIT
// Draws a square for each limn::OverlayMark in the mark's plane; overlay_mark.frag cuts the shape out of it.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/gpu_overlay.h"

layout(push_constant) uniform Push { GpuOverlayMarks push; };

layout(location = 0) in vec3 position;
layout(location = 1) in float radius;
layout(location = 2) in vec3 normal;
layout(location = 3) in vec4 color;
layout(location = 4) in uint shape;

layout(location = 0) out vec2 local; // [-1, 1]^2
layout(location = 1) flat out vec4 markColor;
layout(location = 2) flat out uint markShape;

// How far a mark lies in front of its surface: a fraction of its radius, for curved surfaces, and of its depth, for
// rounding.
const float kLift = 0.03, kNearer = 1.002;

float minPixels() {
    return shape == MARK_RING ? 9.0 : shape == MARK_SQUARE ? 1.5 : 0.0;
}

void main() {
    const vec3 toEye = push.eye - position;
    const float distance = length(toEye);
    const bool free = dot(normal, normal) == 0.0;
    const float facing = free ? 1.0 : dot(normal, toEye);
    const vec3 n = free ? toEye / max(distance, 1e-20) : facing < 0.0 ? -normal : normal;
    const vec3 t = normalize(cross(n, abs(n.y) < 0.9 ? vec3(0, 1, 0) : vec3(1, 0, 0)));
    local = vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1) * 2.0 - 1.0;
    markColor = color;
    markShape = shape;
    const float r = max(radius, minPixels() * push.pixelSize * distance);
    const vec3 p = position + r * (kLift * n + local.x * t + local.y * cross(n, t));
    gl_Position = push.toClip * vec4(p, 1);
    gl_Position.z *= kNearer; // depth is near / distance
    if (facing <= 0.0)
        gl_Position = vec4(2, 2, 2, 1); // all four corners outside the clip volume
}
