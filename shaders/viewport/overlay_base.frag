// SPDX-License-Identifier: MIT
// Adds grey to the faded picture, lighter where a surface faces the viewer, so that shapes are visible in the dark too.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/gpu_overlay.h"

layout(push_constant) uniform Draw { GpuOverlaySurface draw; };

layout(location = 0) in vec3 fragPosition;
layout(location = 1) in vec2 fragLightmapUv; // not used; overlay_surface.vert writes it

layout(location = 0) out vec4 outColor;

void main() {
    const vec3 g = cross(dFdx(fragPosition), dFdy(fragPosition));
    const float facing =
        abs(dot(g, normalize(draw.eye - fragPosition))) / max(length(g), 1e-30);
    outColor = vec4(vec3(0.08 + 0.2 * facing), 0);
}
