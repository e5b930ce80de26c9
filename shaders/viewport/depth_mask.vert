// SPDX-License-Identifier: MIT
// depth.vert for alpha-masked materials.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/gpu_frame.h"

layout(push_constant) uniform Draw { GpuDraw draw; };

layout(location = 0) in vec3 position;
layout(location = 3) in vec2 uv0;
layout(location = 4) in vec2 uv1;
layout(location = 5) in vec4 color;

layout(location = 0) out vec4 fragUv;
layout(location = 1) out float fragAlpha;

invariant gl_Position;

void main() {
    gl_Position = draw.toClip * vec4(position, 1);
    fragUv = vec4(uv0, uv1);
    fragAlpha = color.a;
}
