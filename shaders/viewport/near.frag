// SPDX-License-Identifier: MIT
// Traces short rays to surfaces nearer than half a texel of the lightmap, and replaces the field's radiance from their
// direction by the radiance that they reflect: nearCorrection() of engine/picture/near_light.h.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/gpu_frame.h"
#include "shaders/shared/gpu_light.h"
#include "shaders/shared/gpu_material.h"
#include "shaders/shared/gpu_near.h"
#define SH_BANDS_CONSTANT 2
#include "shaders/shared/sh_bands.glsl"
#include "shaders/shared/specular.glsl"
#include "shaders/shared/sh_field.glsl"
#include "shaders/shared/rectangle_light.glsl"
#include "shaders/shared/surface_pack.glsl"

layout(constant_id = 0) const uint kView = VIEW_LIT;
layout(constant_id = 3) const int kChroma = 3; // bands of the field that are in colour; kBands: 2 or 3

layout(push_constant) uniform Push { GpuNear near; };

layout(set = 0, binding = FRAME_BLOCK) uniform FrameBlock { GpuFrame frame; };
layout(set = 0, binding = FRAME_LIGHTS, std430) readonly buffer Lights { GpuLight lights[]; };
layout(set = 0, binding = FRAME_LIGHTS, std430) readonly buffer Profiles { float profiles[]; }; // after the lights
layout(set = 0, binding = FRAME_SHADOW_VIEWS, std430) readonly buffer ShadowViews { GpuShadowView shadowViews[]; };
layout(set = 0, binding = FRAME_SHADOW_ATLAS) uniform sampler2DArray shadowAtlas;
layout(set = 2, binding = 0) uniform sampler2DArray lightmap;

layout(location = 0) out vec4 outColor;

#include "shaders/shared/seen_surface.glsl"
#include "shaders/shared/lookup_snaps.glsl"
#include "shaders/shared/field_layers.glsl"
#include "shaders/shared/shadowed_light.glsl"
#include "shaders/shared/rectangle_shadow.glsl"
#include "shaders/shared/near_trace.glsl"

/// Coefficients of the field at lightmap coordinates, in its unit.
void readCoefficients(vec2 uv, out vec3 c[kCoefficients]) {
    [[unroll]] for (int i = 0; i < kCoefficients; ++i)
        c[i] = vec3(0);
    [[unroll]] for (int layer = 0; layer < kLayers; ++layer) {
        const vec4 values = textureLod(lightmap, vec3(uv, layer), 0.0);
        [[unroll]] for (int q = 0; q < 4; ++q) {
            const int v = 4 * layer + q;
            if (v < 3 * kColoured)
                c[v / 3][v % 3] = values[q];
            else if (v < kValues)
                c[v - 2 * kColoured] = vec3(values[q]);
        }
    }
}

/// The same of the light above a surface with unit normal n: cutBelow() of engine/math/horizon.h.
void readAbove(vec3 n, vec2 uv, out vec3 c[kCoefficients]) {
    readCoefficients(uv, c);
    const vec4 ofBelow = belowSurface(n), from = horizonRadiance(n);
    vec3 below = vec3(0);
    [[unroll]] for (int i = 0; i < 4; ++i)
        below -= c[i] * (from[i] * frame.cutBelow / HORIZON_GAIN);
    [[unroll]] for (int i = 0; i < 4; ++i)
        c[i] += ofBelow[i] * below;
}

vec3 weightedSum(vec3 c[kCoefficients], float w[kCoefficients]) {
    vec3 sum = vec3(0);
    [[unroll]] for (int i = 0; i < kCoefficients; ++i)
        sum += w[i] * c[i];
    return max(sum, 0.0) * frame.fieldUnit;
}

/// hemisphereRadianceWeights() of engine/math/hemisphere_radiance.h.
void hemisphereRadianceWeights(vec3 n, vec3 d, out float w[kCoefficients]) {
    shBasis(d, w);
    const float z = dot(d, n);
    const vec3 tangent = 3.0 / (2.0 * kPi) * (d - z * n);
    float onM0 = (2.0 - 3.0 * z) / kPi;
    vec3 onM1 = (6.0 * z - 3.0) / kPi * n + tangent;
    if (kBands == 3) {
        const float zonal = z * z - 1.0 / 3.0;
        onM0 += 15.0 / 32.0 * 3.0 / kPi * zonal;
        onM1 -= 15.0 / 32.0 * (6.0 / kPi * zonal * n + 2.0 * z * tangent);
    }
    const float k1 = sqrt(4.0 * kPi / 3.0);
    const vec4 lower = vec4(2.0 * sqrt(kPi) * onM0, k1 * onM1.yzx);
    [[unroll]] for (int i = 0; i < 4; ++i)
        w[i] = lower[i];
}

/// How far above a surface rays start, so that they do not meet it: what is read in a pixel belongs to a point beside
/// it, and is rounded, too.
float clearance(vec3 position, float reach) {
    const float far = distance(frame.eye, position);
    return max(1e-3 * reach, 4e-6 * (length(position) + far) + frame.positionError * far);
}

// PCG: O'Neill. PCG: A Family of Simple Fast Space-Efficient Statistically Good Algorithms for Random Number
// Generation. 2014
uint mixBits(uint x) {
    const uint state = x * 747796405u + 2891336453u;
    const uint word = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (word >> 22u) ^ word;
}

float unitFloat(uint x) {
    return float(x >> 8) * (1.0 / 16777216.0);
}

/// Point `number` of the pixel's sequence in [0, 1)^3. Roberts. The Unreasonable Effectiveness of Quasirandom
/// Sequences. 2018; each pixel shifts it.
vec3 pixelPoint(uvec2 pixel, uint number) {
    const uint a = mixBits(pixel.x + mixBits(pixel.y)), b = mixBits(a), c = mixBits(b);
    return vec3(unitFloat(a + number * 3518319155u), unitFloat(b + number * 2882110345u),
                unitFloat(c + number * 2360945575u));
}

/// sampleCosineHemisphere() of engine/shading/sampler.h.
vec3 cosineDirection(vec3 n, vec2 u) {
    const float side = n.z >= 0.0 ? 1.0 : -1.0;
    const float a = -1.0 / (side + n.z), b = n.x * n.y * a;
    const vec3 t = vec3(1.0 + side * n.x * n.x * a, side * b, -side * n.x);
    const vec3 s = vec3(b, side + n.y * n.y * a, -n.y);
    const float phi = 2.0 * kPi * u.y;
    return sqrt(u.x) * (cos(phi) * t + sin(phi) * s) + sqrt(1.0 - u.x) * n;
}

/// Unshadowed irradiance from light i.
vec3 openIrradiance(uint i, PackedSurface s, out vec3 toLight) {
    toLight = vec3(0);
    if (lights[i].kind == LIGHT_RECTANGLE)
        return lights[i].strength * rectangleIrradiance(rectangleOf(lights[i]), s.position, s.detailNormal);
    const vec3 E = lightIrradiance(lights[i], s.position, toLight);
    return dot(s.geometricNormal, toLight) > 0.0 ? E * max(dot(s.detailNormal, toLight), 0.0) : vec3(0);
}

/// Whether something lies within `reach` on the way to a light. Shadow maps do not resolve that: where the edge of a
/// roof lies within a texel of theirs, the sun would shine on the wall below it.
bool blockedNearby(PackedSurface s, GpuLight light, vec3 toLight, float reach) {
    const float most = light.kind == LIGHT_DIRECTIONAL ? reach : min(reach, distance(light.position, s.position));
    const vec3 origin = s.position + clearance(s.position, reach) * s.geometricNormal;
    return traceNear(origin, toLight, most).t < most;
}

/// Direct light of one light, picked by `u` in proportion to what it would send without shadows, for all: an unbiased
/// estimate of their sum. What is within `reach` casts its shadow by a ray, except on the way to rectangles.
vec3 pickedLight(PackedSurface s, float u, float reach) {
    float all = 0.0;
    vec3 picked = vec3(0), way = vec3(0);
    uint light = 0u;
    for (uint i = 0; i < frame.lightCount; ++i) {
        vec3 toLight;
        const vec3 E = openIrradiance(i, s, toLight);
        const float size = E.x + E.y + E.z;
        if (!(size > 0.0))
            continue;
        all += size;
        const float share = size / all;
        const bool taken = u < share;
        u = taken ? u / share : (u - share) / (1.0 - share); // what is left of u is as random
        if (taken) {
            picked = E / size;
            way = toLight;
            light = i;
        }
    }
    if (!(all > 0.0))
        return vec3(0);
    const GpuLight by = lights[light];
    float seen = by.kind == LIGHT_RECTANGLE
                     ? rectangleVisibility(by, rectangleOf(by), s, u, true)
                     : visibility(by, s.position, s.geometricNormal, way,
                                  vec2(frame.normalBias, frame.lightBias), true);
    const bool traced = by.kind != LIGHT_RECTANGLE && seen > 0.0;
    for (int once = 0; once < int(traced); ++once)
        seen = blockedNearby(s, by, way, reach) ? 0.0 : seen;
    return picked * all * seen;
}

/// The surface that a ray hit, on the side from which the ray came.
PackedSurface metSurface(NearHit hit, vec3 position) {
    const GpuNearTriangle t = nearTriangles[hit.triangle];
    const float side = hit.front ? 1.0 : -1.0;
    const vec3 weights = vec3(1.0 - hit.at.x - hit.at.y, hit.at);
    PackedSurface s;
    s.position = position;
    s.geometricNormal = side * normalize(cross(t.edge1, t.edge2));
    const vec3 n = side * (weights.x * octDecode(unpackSnorm2x16(t.normal0)) +
                           weights.y * octDecode(unpackSnorm2x16(t.normal1)) +
                           weights.z * octDecode(unpackSnorm2x16(t.normal2)));
    s.detailNormal = dot(n, s.geometricNormal) > 0.0 ? normalize(n) : s.geometricNormal;
    const vec3 root = unpackUnorm4x8(t.albedo).rgb;
    s.albedo = root * root;
    float width;
    s.lightmapUv = snapLookup(weights.x * t.uv0 + weights.y * t.uv1 + weights.z * t.uv2 +
                              vec2(0, hit.front ? 0.0 : t.backOffset), width);
    return s;
}

/// Radiance of that surface towards the ray's origin.
vec3 metRadiance(NearHit hit, vec3 position, float u, float reach) {
    const PackedSurface s = metSurface(hit, position);
    vec3 c[kCoefficients];
    readAbove(s.geometricNormal, s.lightmapUv, c);
    float w[kCoefficients];
    irradianceWeights(s.detailNormal, w);
    return s.albedo / kPi * (weightedSum(c, w) + pickedLight(s, u, reach));
}

/// One estimate of the irradiance to add. Loops replace branches, because software rasterisers skip nothing else.
vec3 nearCorrection(PackedSurface s, vec3 c[kCoefficients], vec3 origin, vec3 u) {
    const vec3 direction = cosineDirection(s.detailNormal, u.xy);
    const bool above = dot(direction, s.geometricNormal) > 0.0;
    const NearHit hit = traceNear(origin, direction, above ? s.nearReach : 0.0);
    const bool met = above && hit.t < s.nearReach;
    vec3 radiance = vec3(0);
    for (int once = 0; once < int(met); ++once) {
        const uint flags = nearTriangles[hit.triangle].albedo >> 24;
        const bool replaces = (flags & NEAR_EMISSIVE) == 0u;
        float w[kCoefficients];
        hemisphereRadianceWeights(s.detailNormal, direction, w);
        radiance = replaces ? -weightedSum(c, w) : vec3(0);
        const bool bright = replaces && (hit.front || (flags & NEAR_DOUBLE_SIDED) != 0u);
        for (int only = 0; only < int(bright); ++only)
            radiance += metRadiance(hit, origin + hit.t * direction, u.z, s.nearReach);
    }
    return kPi * min(2.0 - 2.0 * hit.t / s.nearReach, 1.0) * radiance; // nearWeight()
}

void main() {
    const float depth = texelFetch(depthImage, ivec2(gl_FragCoord.xy), 0).r;
    const PackedSurface s = seenSurface(depth);
    const uint rays = depth > 0.0 && s.nearReach > 0.0 ? near.rays : 0u;
    vec3 sum = vec3(0), c[kCoefficients];
    readAbove(s.geometricNormal, s.lightmapUv, c);
    const vec3 origin = s.position + clearance(s.position, s.nearReach) * s.geometricNormal;
    for (uint k = 0; k < rays; ++k)
        sum += nearCorrection(s, c, origin, pixelPoint(uvec2(gl_FragCoord.xy), near.first + k));
    const vec3 E = sum / float(max(rays, 1u));
    outColor = vec4(kView == VIEW_IRRADIANCE ? E : s.albedo / kPi * E, 0);
}
