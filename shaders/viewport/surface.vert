// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/gpu_frame.h"
#include "shaders/shared/gpu_material.h"

layout(constant_id = 1) const uint kFeatures = 0;

layout(push_constant) uniform Draw { GpuDraw draw; };

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 tangent;
layout(location = 3) in vec2 uv0;
layout(location = 4) in vec2 uv1;
layout(location = 5) in vec4 color;
layout(location = 6) in vec2 lightmapUv;

layout(location = 0) out vec3 fragPosition;
layout(location = 1) out vec3 fragNormal;
layout(location = 2) out vec4 fragTangent;
layout(location = 3) out vec4 fragUv;
layout(location = 4) out vec4 fragColor;
layout(location = 5) out vec2 fragLightmapUv;

invariant gl_Position;

void main() {
    gl_Position = draw.toClip * vec4(position, 1);
    const vec4 p = vec4(position, 1);
    fragPosition = vec3(dot(draw.toWorld[0], p), dot(draw.toWorld[1], p), dot(draw.toWorld[2], p));
    // Rows of the cofactor matrix; it keeps normals outward when multiplied by the determinant's sign.
    const vec3 a = draw.toWorld[0].xyz, b = draw.toWorld[1].xyz, c = draw.toWorld[2].xyz;
    const float side = (draw.flags & DRAW_MIRRORED) != 0 ? -1.0 : 1.0;
    fragNormal = side * vec3(dot(cross(b, c), normal), dot(cross(c, a), normal),
                             dot(cross(a, b), normal));
    fragTangent = vec4(dot(a, tangent.xyz), dot(b, tangent.xyz), dot(c, tangent.xyz),
                       side * tangent.w);
    fragUv = vec4(uv0, uv1);
    fragColor = color;
    fragLightmapUv = (kFeatures & FEATURE_LIGHTMAP) != 0 ? lightmapUv : vec2(0);
}
