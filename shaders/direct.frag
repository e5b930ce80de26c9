// SPDX-License-Identifier: MIT
// Adds what all lights send to the surface seen in each pixel: once per pixel, however small the triangles are.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/gpu_frame.h"
#include "shaders/shared/gpu_light.h"
#include "shaders/shared/gpu_material.h"
#include "shaders/shared/sh_irradiance.glsl"
#include "shaders/shared/surface_pack.glsl"

layout(constant_id = 0) const uint kView = VIEW_LIT;

layout(set = 0, binding = 0) uniform FrameBlock { GpuFrame frame; };
layout(set = 0, binding = 1, std430) readonly buffer Lights { GpuLight lights[]; };
layout(set = 0, binding = 2, std430) readonly buffer ShadowViews { GpuShadowView shadowViews[]; };
layout(set = 0, binding = 3) uniform sampler2DArray shadowAtlas;
layout(set = 0, binding = 6) uniform usampler2D surfaceImage;
layout(set = 0, binding = 7) uniform sampler2D depthImage;

layout(location = 0) out vec4 outColor;

// Of the light's six views the one that looks from it to the point.
uint cubeFace(vec3 fromLight) {
    const vec3 a = abs(fromLight);
    if (a.x >= a.y && a.x >= a.z)
        return fromLight.x > 0.0 ? 0u : 1u;
    if (a.y >= a.z)
        return fromLight.y > 0.0 ? 2u : 3u;
    return fromLight.z > 0.0 ? 4u : 5u;
}

// Share of texel `offset` (from the 2 x 2 texels round the point) in a tent 3 texels wide, `f` within them.
vec4 tentWeight(vec4 offset, float f) {
    return 0.5 * (max(1.0 - abs(f - 0.5 - offset), 0.0) + max(1.0 - abs(f + 0.5 - offset), 0.0));
}

// How atlas depth changes with atlas u and v on the surface's plane. `width`: a texel there.
vec2 planeGradient(GpuShadowView view, PackedSurface s, vec4 q, float width) {
    const vec3 n = s.geometricNormal;
    const vec3 t = width * normalize(cross(n, abs(n.y) < 0.9 ? vec3(0, 1, 0) : vec3(1, 0, 0)));
    const vec4 qt = q + view.toAtlas * vec4(t, 0), qb = q + view.toAtlas * vec4(cross(n, t), 0);
    const vec3 dt = qt.xyz / qt.w - q.xyz / q.w, db = qb.xyz / qb.w - q.xyz / q.w;
    const float det = dt.x * db.y - dt.y * db.x;
    if (abs(det) < 1e-14)
        return vec2(0);
    return vec2(dt.z * db.y - db.z * dt.y, dt.x * db.z - db.x * dt.z) / det;
}

// 1: the light arrives; 0: it does not. Each texel is compared with the depth of the surface's plane at its own
// middle, so that flat surfaces need no bias, however steep. A loop, because software rasterisers skip nothing else.
float visibility(GpuLight light, PackedSurface s, vec3 toLight, bool lit) {
    float sum = 1.0;
    const int count = light.shadowViews != SHADOW_NONE && lit ? 1 : 0;
    for (int once = 0; once < count; ++once) {
        const uint face = light.shadowViews == SHADOW_CUBE ? cubeFace(-toLight) : 0u;
        const GpuShadowView view = shadowViews[light.firstView + face];
        const float depth =
            view.perspective > 0.5 ? dot(view.axis.xyz, s.position) - view.axis.w : 1.0;
        const float width = view.texelSize * depth;
        const vec3 p = s.position + width * (frame.normalBias * s.geometricNormal +
                                             frame.lightBias * toLight);
        const vec4 q = view.toAtlas * vec4(p, 1);
        const vec3 centre = q.xyz / q.w;
        const vec2 gradient = planeGradient(view, s, q, width);
        const vec2 size = vec2(textureSize(shadowAtlas, 0).xy);
        const vec2 x = centre.xy * size - 0.5, base = floor(x), f = x - base;
        sum = 0.0;
        for (int k = 0; k < 4; ++k) {
            const vec2 corner = vec2((k & 1) * 2 - 1, (k >> 1) * 2 - 1);
            const vec4 stored = textureGather(
                shadowAtlas, vec3((base + corner + 1.0) / size, float(view.layer)));
            const vec4 i = corner.x + vec4(0, 1, 1, 0), j = corner.y + vec4(1, 1, 0, 0);
            const vec4 plane = centre.z + gradient.x * ((base.x + i + 0.5) / size.x - centre.x) +
                               gradient.y * ((base.y + j + 0.5) / size.y - centre.y);
            sum += dot(vec4(greaterThanEqual(plane, stored)),
                       tentWeight(i, f.x) * tentWeight(j, f.y));
        }
    }
    return sum;
}

// sampleLight() of engine/scene/light.cpp.
vec3 lightIrradiance(GpuLight light, vec3 p, out vec3 toLight) {
    toLight = -light.direction;
    if (light.kind == LIGHT_DIRECTIONAL)
        return light.strength;
    const vec3 d = light.position - p;
    const float d2 = dot(d, d);
    if (!(d2 > 0.0)) {
        toLight = vec3(0);
        return vec3(0);
    }
    const float inverse = inversesqrt(d2);
    toLight = d * inverse;
    const float q = d2 * inverse * light.inverseRange;
    float window = clamp(1.0 - q * q * q * q, 0.0, 1.0);
    if (light.kind == LIGHT_SPOT) {
        const float t = clamp((dot(-toLight, light.direction) - light.cosOuter) * light.spotScale,
                              0.0, 1.0);
        window *= t * t;
    }
    return light.strength * min(window / d2, 1e30);
}

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

// Directional albedo of the specular lobe. Karis. Physically Based Shading on Mobile. 2014.
vec3 specularAlbedo(vec3 F0, float roughness, float NoV) {
    const vec4 r = roughness * vec4(-1, -0.0275, -0.572, 0.022) + vec4(1, 0.0425, 1.04, -0.04);
    const float a = min(r.x * r.x, exp2(-9.28 * NoV)) * r.x + r.y;
    return max(F0 * (-1.04 * a + r.z) + (1.04 * a + r.w), 0.0);
}

// Adds what all lights send: irradiance, and in VIEW_LIT specular radiance.
void addDirect(PackedSurface s, vec3 F0, bool any, inout vec3 E, inout vec3 specular) {
    const uint count = any ? frame.lightCount : 0;
    for (uint i = 0; i < count; ++i) {
        const GpuLight light = lights[i];
        vec3 toLight;
        vec3 irradiance = lightIrradiance(light, s.position, toLight);
        const float NoL = max(dot(s.detailNormal, toLight), 0.0);
        const bool lit = NoL > 0.0 && dot(s.geometricNormal, toLight) > 0.0 &&
                         irradiance.x + irradiance.y + irradiance.z > 0.0;
        irradiance *= lit ? NoL * visibility(light, s, toLight, lit) : 0.0;
        E += irradiance;
        if (kView == VIEW_LIT && lit)
            specular += irradiance * specularBrdf(s, s.detailNormal, toLight, F0);
    }
}

// Where the pixel's ray meets the surface.
vec3 positionAt(vec2 pixel, float depth) {
    const vec2 ndc = 2.0 * pixel * frame.pixelSize - 1.0;
    const vec3 ray = frame.rayCentre + ndc.x * frame.rayRight - ndc.y * frame.rayUp;
    return frame.eye + ray * (frame.depthScale / (depth + frame.depthOffset));
}

void main() {
    const ivec2 pixel = ivec2(gl_FragCoord.xy);
    const float depth = texelFetch(depthImage, pixel, 0).r;
    PackedSurface s = unpackSurface(texelFetch(surfaceImage, pixel, 0));
    s.position = positionAt(gl_FragCoord.xy, depth);
    s.toEye = normalize(frame.eye - s.position);
    const vec3 F0 = mix(vec3(0.04), s.baseColor, s.metallic);
    vec3 E = vec3(0), specular = vec3(0);
    addDirect(s, F0, depth > 0.0, E, specular);
    outColor = vec4(s.albedo * E / kPi + specular, 0);
}
