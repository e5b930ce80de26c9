// SPDX-License-Identifier: MIT
// Computes the same screen positions as surface.vert, bit for bit, so that surfaces are drawn over where depths are
// equal.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/gpu_overlay.h"

layout(push_constant) uniform Draw { GpuOverlaySurface draw; };

layout(location = 0) in vec3 position;
layout(location = 1) in vec2 lightmapUv;

layout(location = 0) out vec3 fragPosition;
layout(location = 1) out vec2 fragLightmapUv;

invariant gl_Position;

void main() {
    gl_Position = draw.toClip * vec4(position, 1);
    const vec4 p = vec4(position, 1);
    fragPosition = vec3(dot(draw.toWorld[0], p), dot(draw.toWorld[1], p), dot(draw.toWorld[2], p));
    fragLightmapUv = lightmapUv;
}
