// SPDX-License-Identifier: MIT
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/gpu_overlay.h"

layout(location = 0) in vec2 local;
layout(location = 1) flat in vec4 markColor;
layout(location = 2) flat in uint markShape;

layout(location = 0) out vec4 outColor;

void main() {
    const float r = markShape == MARK_SQUARE ? max(abs(local.x), abs(local.y)) : length(local);
    const float pixel = fwidth(r);
    if (r > 1.0)
        discard;
    // A dark rim of at least a pixel distinguishes marks from neighbours and from a surface of the same colour, such as
    // white marks on a white wall. Marks of less than a pixel and a half have none.
    const float inner = 1.0 - max(0.2, 1.2 * pixel);
    const float rim = smoothstep(inner - pixel, inner, r) * clamp(2.5 - 3.0 * pixel, 0.0, 1.0);
    vec3 c = markColor.rgb * (1.0 - 0.6 * rim);
    if (markShape == MARK_RING)
        c = r > 0.82 || r < 0.42 ? r < 0.34 ? markColor.rgb : vec3(0) : vec3(1);
    outColor = vec4(c, 1);
}
