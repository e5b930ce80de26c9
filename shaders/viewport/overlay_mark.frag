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
    // A darker rim distinguishes neighbours of the same colour. Marks that are too small for it have none.
    const float rim = smoothstep(0.8 - pixel, 0.8, r) * clamp(1.5 - 6.0 * pixel, 0.0, 1.0);
    vec3 c = markColor.rgb * (1.0 - 0.4 * rim);
    if (markShape == MARK_RING)
        c = r > 0.82 || r < 0.42 ? r < 0.34 ? markColor.rgb : vec3(0) : vec3(1);
    outColor = vec4(c, 1);
}
