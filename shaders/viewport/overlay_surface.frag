// SPDX-License-Identifier: MIT
// Draws the colour of the lightmap texel in which a surface point lies, with a checker of texels, lit from the viewer.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/gpu_overlay.h"

layout(push_constant) uniform Draw { GpuOverlaySurface draw; };

layout(set = 0, binding = 0, std430) readonly buffer Texels {
    uint width, height;
    uint texel[]; // bytes R, G, B, A, sRGB-encoded; A = 0: not painted; followed by OverlayData::finer, if any
};
// Of engine/lightmap/layout/lightmap_layout.h.
const float kFineCells = 4.0;
const int kFineLevels = 5;

layout(location = 0) in vec3 fragPosition;
layout(location = 1) in vec2 fragLightmapUv;

layout(location = 0) out vec4 outColor;

void main() {
    const bool back = gl_FrontFacing == (draw.sideOffset < 0.0);
    vec2 x = (fragLightmapUv + vec2(0, back ? abs(draw.sideOffset) : 0.0)) * vec2(width, height);
    // Not derived from x, because helper invocations need not read buffers.
    vec2 texelsPerPixel = fwidth(fragLightmapUv) * vec2(width, height);
    const vec3 g = cross(dFdx(fragPosition), dFdy(fragPosition));
    const uvec2 last = uvec2(width, height) - 1u;
    for (int level = 0; level < kFineLevels && texel.length() > width * height; ++level) {
        const uvec2 base = min(uvec2(max(x - 0.5, 0.0)), last);
        const uint block = texel[width * height + base.y * width + base.x];
        if (block == ~0u)
            break;
        x = vec2(block % width, block / width) + (x - 0.5 - vec2(base)) * kFineCells + 0.5;
        texelsPerPixel *= kFineCells;
    }
    const uvec2 i = min(uvec2(max(x, 0.0)), last);
    const vec4 c = unpackUnorm4x8(texel[i.y * width + i.x]);
    if (c.a == 0.0)
        discard;
    const vec3 toEye = normalize(draw.eye - fragPosition);
    const float facing = abs(dot(g, toEye)) / max(length(g), 1e-30);
    // Texels smaller than two pixels have no checker: it would only be noise.
    const float checker = clamp(1.0 - 2.0 * max(texelsPerPixel.x, texelsPerPixel.y), 0.0, 1.0);
    const float dark = float((i.x ^ i.y) & 1u) * checker;
    outColor = vec4(c.rgb * (0.6 + 0.4 * facing) * (1.0 - 0.3 * dark), 1);
}
