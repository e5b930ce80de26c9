// SPDX-License-Identifier: MIT
// Writes what surfaces emit and the bounced light that they reflect, for one limn::View. There is one pass for each
// number of bands that surfaces in the picture read.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/gpu_frame.h"
#include "shaders/shared/gpu_material.h"
#define SH_BANDS_CONSTANT 2
#include "shaders/shared/sh_bands.glsl"
#include "shaders/shared/specular.glsl"
#include "shaders/shared/sh_field.glsl"
#include "shaders/shared/surface_pack.glsl"

layout(constant_id = 0) const uint kView = VIEW_LIT;
layout(constant_id = 1) const uint kFeatures = 0; // FEATURE_LIGHTMAP, FEATURE_GRID, FEATURE_REFLECTED_APART: what any surface reads
layout(constant_id = 4) const int kChroma = 3; // bands of the field that are in colour
layout(constant_id = 3) const bool kFirst = true; // first of the passes: it also writes pixels of other bands and the background
layout(constant_id = 5) const bool kDiffuse = true; // shows diffuse light, not only what is glossy

layout(set = 0, binding = FRAME_BLOCK) uniform FrameBlock { GpuFrame frame; };
layout(set = 1, binding = FIELD_LIGHTMAP) uniform sampler2DArray lightmap;
layout(set = 1, binding = FIELD_GRID, std430) readonly buffer Grid { uvec2 grid[]; };
layout(set = 1, binding = FIELD_GRID_WEIGHTS, std430) readonly buffer GridDepth { uint gridDepth[]; };
layout(set = 0, binding = FRAME_EMITTED) uniform sampler2D emittedImage;
layout(set = 0, binding = FRAME_REFLECTIONS) uniform sampler2DArray reflectionTable;

layout(location = 0) out vec4 outColor;

#include "shaders/shared/grid_depth.glsl"
#include "shaders/shared/grid_moments.glsl"
#include "shaders/shared/seen_surface.glsl"
#include "shaders/shared/field_layers.glsl"

/// Two sums over the harmonics of the bounced light that reaches the surface. They are unrolled, because on a software
/// rasteriser a loop over 64 lookups takes half as long again.
struct FieldSums {
    vec3 irradiance, lobe;
};

void addValues(inout FieldSums sums, int layer, vec4 values, float irradiance[kCoefficients], float lobe[kCoefficients]) {
    [[unroll]] for (int q = 0; q < 4; ++q) {
        const int v = 4 * layer + q;
        if (v < 3 * kColoured) {
            sums.irradiance[v % 3] += irradiance[v / 3] * values[q];
            sums.lobe[v % 3] += lobe[v / 3] * values[q];
        } else if (v < kValues) {
            sums.irradiance += irradiance[v - 2 * kColoured] * values[q];
            sums.lobe += lobe[v - 2 * kColoured] * values[q];
        }
    }
}

FieldSums readLightmap(vec2 uv, float irradiance[kCoefficients], float lobe[kCoefficients]) {
    FieldSums sums = FieldSums(vec3(0), vec3(0));
    [[unroll]] for (int k = 0; k < kLayers; ++k)
        addValues(sums, k, textureLod(lightmap, vec3(uv, k), 0.0), irradiance, lobe);
    return sums;
}

FieldSums readGrid(vec3 position, vec3 normal, float irradiance[kCoefficients], float lobe[kCoefficients]) {
    FieldSums sums = FieldSums(vec3(0), vec3(0));
    const ivec3 last = ivec3(frame.gridSize) - 1;
    const vec3 x = clamp((position - frame.gridLower) * frame.gridScale - 0.5, vec3(0), vec3(last));
    const ivec3 lower = min(ivec3(x), last);
    const vec3 f = x - vec3(lower);
    const vec3 cellSize = 1.0 / frame.gridScale; // from here on as sampleIrradiance() on the CPU
    const vec3 clear = position + normal * (GRID_DEPTH_BIAS * min(cellSize.x, min(cellSize.y, cellSize.z)));
    float sum = 0.0;
    for (int k = 0; k < 8; ++k) {
        const ivec3 high = ivec3(k & 1, (k >> 1) & 1, k >> 2);
        const ivec3 cell = min(lower + high, last);
        const vec3 w = mix(1.0 - f, f, vec3(high));
        const uint index =
            (uint(cell.z) * frame.gridSize.y + uint(cell.y)) * frame.gridSize.x + uint(cell.x);
        float weight = w.x * w.y * w.z;
        const vec3 centre = frame.gridLower + (vec3(cell) + 0.5) * cellSize;
        if (frame.gridWeights == GRID_DEPTHS)
            weight *= GRID_UNSEEN + seenFromCell(index, clear - centre, frame.gridReach);
        else if (frame.gridWeights != GRID_PLAIN) {
            const bool smoothWeights = frame.gridWeights == GRID_SMOOTH_MOMENTS;
            weight *= momentsWeight(index, (smoothWeights ? clear : position) - centre, normal, smoothWeights);
        }
        sum += weight;
        [[unroll]] for (int layer = 0; layer < kLayers; ++layer) {
            const uvec2 halfs = grid[uint(layer) * frame.gridCells + index];
            addValues(sums, layer, weight * vec4(unpackHalf2x16(halfs.x), unpackHalf2x16(halfs.y)), irradiance, lobe);
        }
    }
    return FieldSums(sums.irradiance / max(sum, 1e-30), sums.lobe / max(sum, 1e-30));
}

/// Irradiance, and mean radiance in the lobe that the surface reflects, both at least 0.
FieldSums readField(PackedSurface s, vec3 axis, float factors[8], bool fromGrid) {
    FieldSums sums = FieldSums(vec3(0), vec3(0));
    float irradiance[kCoefficients], lobe[kCoefficients];
    irradianceWeights(s.detailNormal, irradiance);
    lobeWeights(axis, factors, lobe); // read in VIEW_LIT only
    const bool lightmapRead = (kFeatures & FEATURE_LIGHTMAP) != 0 && !fromGrid,
               gridRead = (kFeatures & FEATURE_GRID) != 0 && fromGrid;
    // Loops instead of branches, because software rasterisers evaluate branches that no pixel of a block takes.
    for (int once = 0; once < int(gridRead); ++once)
        sums = readGrid(s.position, s.detailNormal, irradiance, lobe);
    for (int once = 0; once < int(lightmapRead && frame.cutBelow > 0.0); ++once) {
        weighCut(s.geometricNormal, irradiance);
        weighCut(s.geometricNormal, lobe);
    }
    for (int once = 0; once < int(lightmapRead); ++once)
        sums = readLightmap(s.lightmapUv, irradiance, lobe);
    return FieldSums(kDiffuse ? max(sums.irradiance, 0.0) * frame.fieldUnit : vec3(0), max(sums.lobe, 0.0) * frame.fieldUnit);
}

/// `apart`: a technique's own pass adds what the surface reflects glossily.
vec3 bouncedLight(PackedSurface s, bool fromGrid, bool apart) {
    const float NoV = clamp(dot(s.detailNormal, s.toEye), 0.0, 1.0);
    ReflectionLobe reflection = reflectionLobe(reflectionTable, s.roughness, NoV, kBands);
    windowFactors(reflection.factors);
    const vec3 axis = normalize(reflection.towards.x * s.detailNormal +
                                reflection.towards.y * reflect(-s.toEye, s.detailNormal));
    const FieldSums field = readField(s, axis, reflection.factors, fromGrid);
    if (kView == VIEW_IRRADIANCE)
        return field.irradiance;
    const vec3 diffuse = s.albedo * field.irradiance / kPi;
    if (kView != VIEW_LIT)
        return diffuse;
    if ((kFeatures & FEATURE_REFLECTED_APART) != 0 && apart)
        return diffuse;
    const float seen = fromGrid ? 1.0 : hemisphereSeen(reflection.factors, dot(axis, s.geometricNormal));
    return diffuse + (s.F0 * reflection.share.x + reflection.share.y) * (field.lobe / seen);
}

void main() {
    const vec4 emitted = texelFetch(emittedImage, ivec2(gl_FragCoord.xy), 0);
    const float read = abs(emitted.a); // as surface.frag says
    const bool own = floor(read) == float(kBands);
    if (!kFirst && !own)
        discard;
    const float depth = texelFetch(depthImage, ivec2(gl_FragCoord.xy), 0).r;
    vec3 radiance = depth > 0.0 ? emitted.rgb : frame.background;
    for (int once = 0; once < int(own); ++once)
        radiance += bouncedLight(seenSurface(depth), emitted.a < 0.0, fract(read) > 0.0);
    outColor = vec4(radiance, 1);
}
