// SPDX-License-Identifier: MIT
// Draws the sky where there is no surface: limn::skyRadiance() of the pixel's direction.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/gpu_frame.h"
#include "shaders/shared/gpu_sky.h"

layout(push_constant) uniform Push { GpuSky sky; };
layout(set = 0, binding = FRAME_BLOCK) uniform FrameBlock { GpuFrame frame; };
layout(set = 0, binding = FRAME_DEPTH) uniform sampler2D depthImage;
layout(set = 1, binding = 0) uniform sampler2D panorama;

layout(location = 0) out vec4 outColor;

const float kPi = 3.14159265358979;

vec3 panoramaRadiance(vec3 d) {
    const ivec2 size = textureSize(panorama, 0);
    // At the poles every column is the same place; atan(0, 0) would be undefined.
    const float turns = d.x == 0.0 && d.z == 0.0 ? 0.0 : atan(d.z, d.x) / (2.0 * kPi);
    const vec2 uv = vec2(fract(turns + sky.turn + 0.75), acos(clamp(d.y, -1.0, 1.0)) / kPi);
    return sky.strength *
           texelFetch(panorama, min(ivec2(uv * vec2(size)), size - 1), 0).rgb;
}

void main() {
    if (texelFetch(depthImage, ivec2(gl_FragCoord.xy), 0).r != 0.0) // 0: infinitely far
        discard;
    const vec2 ndc = 2.0 * gl_FragCoord.xy * frame.pixelSize - 1.0;
    const vec3 d = normalize(frame.rayCentre + ndc.x * frame.rayRight - ndc.y * frame.rayUp);
    outColor = vec4(sky.image != 0u ? panoramaRadiance(d)
                                    : mix(sky.horizon, d.y > 0.0 ? sky.zenith : sky.ground, abs(d.y)),
                    1);
}
