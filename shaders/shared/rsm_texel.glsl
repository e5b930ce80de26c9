// SPDX-License-Identifier: MIT
// Reads a texel of a reflective shadow map that the viewport drew, as castTexel() of engine/rsm/reflective_shadow_map.cpp
// casts it.
// Dachsbacher, Stamminger. Reflective Shadow Maps. 2005
#include "shaders/shared/gpu_rsm.h"
#include "shaders/shared/surface_pack.glsl"

layout(binding = RSM_ALBEDO) uniform sampler2D albedoMap;
layout(binding = RSM_SURFACE) uniform usampler2D surfaceMap;
layout(binding = RSM_DEPTH) uniform sampler2D depthMap;

/// As limn::RsmTexel.
struct RsmTexel {
    vec3 position, normal, albedo;
    float incident; // of a light of colour 1 and strength 1
    float distance; // m, from the view's origin; of parallel rays, along them
    float area;     // m^2, across the beam
};

/// Share of the light that leaves in a direction.
float emittedShare(GpuRsmView view, vec3 direction) {
    const float cosine = dot(direction, view.direction);
    if (view.kind == RSM_LIGHT_RECTANGLE)
        return max(cosine, 0.0);
    return view.kind != RSM_LIGHT_SPOT || cosine > view.cosOuter ? 1.0 : 0.0;
}

/// Window of range and cone of a point or spot light, as sampleLight() of engine/scene/light/light.cpp has it; 1 for
/// others.
float windowAt(GpuRsmView view, vec3 direction, float distance) {
    if (view.kind != RSM_LIGHT_POINT && view.kind != RSM_LIGHT_SPOT)
        return 1.0;
    float window = 1.0;
    if (view.range > 0.0) {
        const float q = distance / view.range;
        window = clamp(1.0 - q * q * q * q, 0.0, 1.0);
    }
    if (view.kind == RSM_LIGHT_SPOT) {
        const float t = clamp((dot(direction, view.direction) - view.cosOuter) * view.spotScale, 0.0, 1.0);
        window *= t * t;
    }
    return window;
}

/// What lies in the texel, and the direction from the light; false where nothing is lit.
bool readRsmPlace(GpuRsmView view, ivec2 texel, out RsmTexel seen, out vec3 direction) {
    const float depth = texelFetch(depthMap, texel, 0).r;
    seen.albedo = texelFetch(albedoMap, texel, 0).rgb;
    direction = view.forward;
    if (!(depth > 0.0))
        return false;
    const vec2 ndc = (vec2(texel) + 0.5) * (2.0 / float(view.mapSize)) - 1.0;
    const vec3 across = ndc.x * view.right - ndc.y * view.up; // the first row is the upper one
    float spread = view.texelArea, distance = view.depthUnit * (1.0 - depth);
    if (view.parallel == 1u) {
        seen.position = view.origin + across + view.forward * distance;
    } else {
        const vec3 way = view.forward + across;
        const float length1 = length(way), along = view.depthUnit / depth;
        seen.position = view.origin + way * along;
        direction = way / length1;
        distance = length1 * along;
        spread /= length1 * length1 * length1;
    }
    const float share = view.parallel == 1u ? 1.0 : emittedShare(view, direction);
    seen.distance = distance;
    seen.area = view.parallel == 1u ? spread : spread * distance * distance;
    seen.incident = view.power * spread * share * windowAt(view, direction, distance);
    if (!(seen.incident > 0.0))
        return false;
    seen.normal = octDecode(unpackSnorm2x16(texelFetch(surfaceMap, texel, 0).w));
    if (dot(seen.normal, direction) > 0.0)
        seen.normal = -seen.normal;
    return true;
}

/// The same; false also where the texel reflects nothing diffusely.
bool readRsmTexel(GpuRsmView view, ivec2 texel, out RsmTexel seen) {
    vec3 direction;
    return readRsmPlace(view, texel, seen, direction) && seen.albedo != vec3(0.0);
}
