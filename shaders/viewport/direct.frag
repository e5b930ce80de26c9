// SPDX-License-Identifier: MIT
// Adds the direct light of all lights to the surface seen in each pixel: once per pixel, however small the triangles
// are.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/gpu_frame.h"
#include "shaders/shared/gpu_light.h"
#include "shaders/shared/gpu_material.h"
#include "shaders/shared/specular.glsl"
#include "shaders/shared/rectangle_light.glsl"
#include "shaders/shared/surface_pack.glsl"

layout(constant_id = 0) const uint kView = VIEW_LIT;

layout(set = 0, binding = FRAME_BLOCK) uniform FrameBlock { GpuFrame frame; };
layout(set = 0, binding = FRAME_LIGHTS, std430) readonly buffer Lights { GpuLight lights[]; };
layout(set = 0, binding = FRAME_LIGHTS, std430) readonly buffer Profiles { float profiles[]; }; // after the lights
layout(set = 0, binding = FRAME_SHADOW_VIEWS, std430) readonly buffer ShadowViews { GpuShadowView shadowViews[]; };
layout(set = 0, binding = FRAME_SHADOW_ATLAS) uniform sampler2DArray shadowAtlas;

layout(location = 0) out vec4 outColor;

#include "shaders/shared/seen_surface.glsl"
#include "shaders/shared/shadowed_light.glsl"
#include "shaders/shared/rectangle_shadow.glsl"

// Cook-Torrance with GGX, without the cosine. Walter et al. Microfacet Models for Refraction through Rough
// Surfaces. 2007; the visibility term is Hammon's approximation of the height-correlated Smith term.
vec3 specularBrdf(PackedSurface s, vec3 n, vec3 toLight, vec3 F0) {
    const vec3 h = normalize(s.toEye + toLight);
    const float NoL = max(dot(n, toLight), 0.0), NoV = max(dot(n, s.toEye), 1e-4);
    const float NoH = clamp(dot(n, h), 0.0, 1.0), VoH = clamp(dot(s.toEye, h), 0.0, 1.0);
    const float alpha = max(s.roughness * s.roughness, 2e-3);
    const float a2 = alpha * alpha;
    const float k = NoH * NoH * (a2 - 1.0) + 1.0;
    const float D = a2 / (kPi * k * k);
    const float V = 0.5 / mix(2.0 * NoL * NoV, NoL + NoV, alpha);
    const vec3 F = F0 + (1.0 - F0) * pow(1.0 - VoH, 5.0);
    return D * V * F;
}

// The lobe is widened by the rectangle's extent and keeps its energy. Karis. Real Shading in Unreal Engine 4. 2013
vec3 rectangleSpecularBrdf(Rectangle r, PackedSurface s, vec3 F0) {
    const vec3 way =
        representativePoint(r, s.position, reflect(-s.toEye, s.detailNormal)) - s.position;
    const float alpha = max(s.roughness * s.roughness, 2e-3);
    const float extent = (length(r.halfWidth) + length(r.halfHeight)) / (4.0 * length(way));
    const float widened = alpha / min(alpha + extent, 1.0);
    return specularBrdf(s, s.detailNormal, normalize(way), F0) * min(widened * widened, 1.0);
}

// Noise in [0, 1) that is evenly distributed among neighbouring pixels. Jimenez. Next Generation Post Processing in
// Call of Duty: Advanced Warfare. 2014
float pixelNoise() {
    return fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715))));
}

void addRectangle(GpuLight light, PackedSurface s, vec3 F0, inout vec3 E, inout vec3 specular) {
    const Rectangle r = rectangleOf(light);
    vec3 irradiance = light.strength * rectangleIrradiance(r, s.position, s.detailNormal);
    const bool lit = irradiance.x + irradiance.y + irradiance.z > 0.0;
    irradiance *= rectangleVisibility(light, r, s, pixelNoise(), lit);
    E += irradiance;
    if (kView == VIEW_LIT && lit)
        specular += irradiance * rectangleSpecularBrdf(r, s, F0);
}

// Adds the direct light of all lights: irradiance, and in VIEW_LIT specular radiance.
void addDirect(PackedSurface s, vec3 F0, bool any, inout vec3 E, inout vec3 specular) {
    const uint count = any ? frame.lightCount : 0;
    const vec2 bias = vec2(frame.normalBias, frame.lightBias);
    for (uint i = 0; i < count; ++i) {
        const GpuLight light = lights[i];
        if (light.kind == LIGHT_RECTANGLE) {
            addRectangle(light, s, F0, E, specular);
            continue;
        }
        vec3 toLight;
        vec3 irradiance = lightIrradiance(light, s.position, toLight);
        const float NoL = max(dot(s.detailNormal, toLight), 0.0);
        const bool lit = NoL > 0.0 && dot(s.geometricNormal, toLight) > 0.0 &&
                         irradiance.x + irradiance.y + irradiance.z > 0.0;
        irradiance *= lit ? NoL * visibility(light, s.position, s.geometricNormal, toLight, bias, lit) : 0.0;
        E += irradiance;
        if (kView == VIEW_LIT && lit)
            specular += irradiance * specularBrdf(s, s.detailNormal, toLight, F0);
    }
}

void main() {
    const float depth = texelFetch(depthImage, ivec2(gl_FragCoord.xy), 0).r;
    const PackedSurface s = seenSurface(depth);
    vec3 E = vec3(0), specular = vec3(0);
    addDirect(s, s.F0, depth > 0.0, E, specular);
    outColor = vec4(s.albedo * E / kPi + specular, 0);
}
