// SPDX-License-Identifier: MIT
// Adds to what a transmissive surface mirrors and scatters the picture behind it: straight on, as passRay() of
// engine/shading/passed_ray.cpp for a smooth thin sheet. Bodies are taken for such sheets.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/gpu_frame.h"
#include "shaders/shared/surface_pack.glsl"
#include "shaders/shared/fresnel.glsl"

layout(set = 0, binding = FRAME_BLOCK) uniform FrameBlock { GpuFrame frame; };
layout(set = 1, binding = 0) uniform sampler2D behind;

layout(location = 0) out vec4 outColor;

#include "shaders/shared/seen_surface.glsl"

void main() {
    const ivec2 pixel = ivec2(gl_FragCoord.xy);
    const float depth = texelFetch(depthImage, pixel, 0).r;
    const PackedSurface s = seenSurface(depth);
    if (depth <= 0.0 || s.transmission <= 0.0)
        discard;
    const float root = sqrt(s.dielectricF0), ior = (1.0 + root) / (1.0 - root);
    const vec3 tint = s.baseColor * (1.0 - s.metallic) * s.transmission;
    const float reflected = fresnelDielectric(abs(dot(s.detailNormal, s.toEye)), ior);
    outColor = vec4(tint * (1.0 - reflected) * texelFetch(behind, pixel, 0).rgb, 0);
}
