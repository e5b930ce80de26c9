// SPDX-License-Identifier: MIT
// Irradiance of every surfel from all lights, with the shadow maps that the viewport draws.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/gpu_light.h"
#include "shaders/shared/relight.glsl"

const float kPi = 3.14159265358979;
#include "shaders/shared/rectangle_light.glsl"
#include "shaders/shared/surface_pack.glsl"

layout(std430, binding = RELIGHT_SURFELS) readonly buffer Surfels { GpuSurfel surfels[]; };
layout(std430, binding = RELIGHT_DIRECT) writeonly buffer Direct { vec4 direct[]; };
layout(set = 1, binding = 0, std430) readonly buffer Lights { GpuLight lights[]; };
layout(set = 1, binding = 1, std430) readonly buffer ShadowViews { GpuShadowView shadowViews[]; };
layout(set = 1, binding = 2) uniform sampler2DArray shadowAtlas;

#include "shaders/shared/shadowed_light.glsl"
#include "shaders/shared/rectangle_shadow.glsl"

// Surfel `i` is on a surface without detail.
vec3 rectangleIrradianceOf(GpuLight light, GpuSurfel s, uint i) {
    PackedSurface at;
    at.position = s.position;
    at.geometricNormal = at.detailNormal = s.normal;
    const Rectangle r = rectangleOf(light);
    const float E = rectangleIrradiance(r, s.position, s.normal);
    const float noise = fract(float(i & 0xffffu) * 0.61803399); // even among neighbours
    return light.strength * (E > 0.0 ? E * rectangleVisibility(light, r, at, noise, true) : 0.0);
}

void main() {
    const uint i = itemIndex();
    if (i >= range.end)
        return;
    const GpuSurfel s = surfels[i];
    vec3 E = vec3(0);
    for (uint k = 0; k < range.lights; ++k) {
        const GpuLight light = lights[k];
        if (light.kind == LIGHT_RECTANGLE) {
            E += rectangleIrradianceOf(light, s, i);
            continue;
        }
        vec3 toLight;
        const vec3 irradiance = lightIrradiance(light, s.position, toLight);
        const float NoL = max(dot(s.normal, toLight), 0.0);
        const bool lit = NoL > 0.0 && irradiance.x + irradiance.y + irradiance.z > 0.0;
        if (lit)
            E += irradiance * NoL *
                 visibility(light, s.position, s.normal, toLight, vec2(range.normalBias, range.lightBias), lit);
    }
    direct[i] = vec4(E, 0);
}
