// SPDX-License-Identifier: MIT
// Computes the irradiance of surface points from all lights, with the shadow maps that the viewport draws. The irradiance
// per unit of a light's colour and strength is kept if there is a place for it, and computed for fresh lights only.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/compute_groups.glsl"
#include "shaders/shared/gpu_light.h"
#include "shaders/shared/gpu_point_irradiance.h"

const float kPi = 3.14159265358979;
#include "shaders/shared/rectangle_light.glsl"
#include "shaders/shared/surface_pack.glsl"

layout(constant_id = 1) const uint kStride = 2; // words of 16 bytes of a point: its position, its unit normal, others; 1: both in one
layout(constant_id = 2) const uint kTogether = 1; // points whose mean is one irradiance

layout(binding = 0, std430) readonly buffer Lights { GpuLight lights[]; };
layout(binding = 0, std430) readonly buffer Profiles { float profiles[]; }; // after the lights
layout(binding = 1, std430) readonly buffer ShadowViews { GpuShadowView shadowViews[]; };
layout(binding = 2) uniform sampler2DArray shadowAtlas;
layout(binding = 3, std430) buffer Unit { float unit[]; }; // places[k] * irradiances + irradiance
layout(binding = 4, std430) readonly buffer Places { uint places[]; }; // then the fresh lights
layout(binding = 5, std430) readonly buffer Points { uvec4 points[]; };
layout(binding = 6, std430) buffer Direct { vec4 direct[]; };

layout(push_constant) uniform Push {
    GpuPointLighting range;
};

#include "shaders/shared/shadowed_light.glsl"
#include "shaders/shared/rectangle_shadow.glsl"

struct Point {
    vec3 position, normal;
};

// Irradiance of a rectangle at point `i`, whose surface has no normal map.
float rectangleIrradianceOf(GpuLight light, Point s, uint i) {
    PackedSurface at;
    at.position = s.position;
    at.geometricNormal = at.detailNormal = s.normal;
    const Rectangle r = rectangleOf(light);
    const float E = rectangleIrradiance(r, s.position, s.normal);
    const float noise = fract(float(i & 0xffffu) * 0.61803399); // evenly distributed among neighbours
    return E > 0.0 ? E * rectangleVisibility(light, r, at, noise, true) : 0.0;
}

// Irradiance of a light of strength 1 at a point.
float unitIrradianceAt(uint k, Point s, uint i) {
    GpuLight light = lights[k];
    light.strength = vec3(1);
    if (light.kind == LIGHT_RECTANGLE)
        return rectangleIrradianceOf(light, s, i);
    vec3 toLight;
    const float irradiance = lightIrradiance(light, s.position, toLight).x;
    const float NoL = max(dot(s.normal, toLight), 0.0);
    const bool lit = NoL > 0.0 && irradiance > 0.0;
    const vec2 bias = vec2(range.normalBias, range.lightBias);
    return lit ? irradiance * NoL * visibility(light, s.position, s.normal, toLight, bias, lit) : 0.0;
}

Point pointAt(uint j) {
    const uvec4 p = points[j * kStride];
    const vec3 normal = kStride == 1 ? octDecode(unpackSnorm2x16(p.w)) : uintBitsToFloat(points[j * kStride + 1].xyz);
    return Point(uintBitsToFloat(p.xyz), normal);
}

// Mean over the points of irradiance i.
float unitIrradiance(uint k, uint i) {
    float sum = 0.0;
    for (uint j = i * kTogether; j < (i + 1) * kTogether; ++j)
        sum += unitIrradianceAt(k, pointAt(j), j);
    return sum / float(kTogether);
}

void main() {
    const uint i = groupIndex() * kLanes + gl_LocalInvocationIndex;
    if (i >= range.count)
        return;
    // Lights without a place come first, so that the sum does not depend on when a light changed.
    vec3 E = range.workBegin > 0 ? direct[i].rgb : vec3(0);
    const uint fresh = range.freshLights, work = fresh + range.lights - range.keptLights;
    for (uint n = range.workBegin; n < range.workEnd; ++n) {
        const bool keep = n < fresh;
        const uint k = range.keptLights + n - (keep ? 0 : fresh);
        const uint light = keep ? places[k] : k;
        const float e = unitIrradiance(light, i);
        if (keep)
            unit[places[light] * range.count + i] = e;
        else
            E += min(lights[light].strength * e, LIGHT_MOST_IRRADIANCE);
    }
    const uint summed = range.workEnd == work ? range.keptLights : 0;
    for (uint k = 0; k < summed; ++k)
        E += min(lights[k].strength * unit[places[k] * range.count + i], LIGHT_MOST_IRRADIANCE);
    direct[i] = vec4(E, 0);
}
