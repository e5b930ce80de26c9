// SPDX-License-Identifier: MIT
// Geometry without shading: shadow maps and the depth pre-pass of opaque materials.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/gpu_frame.h"

layout(push_constant) uniform Draw { GpuDraw draw; };

layout(location = 0) in vec3 position;

invariant gl_Position;

void main() {
    gl_Position = draw.toClip * vec4(position, 1);
}
