// SPDX-License-Identifier: MIT
// Sends the texels of one view of a reflective shadow map into the cells half a cell off their surfaces, each as a
// clamped cosine of the flux that it reflects. Sums are integers, so that they do not depend on the order of
// invocations. As castTexel() of engine/rsm/reflective_shadow_map.cpp and injectLight() of
// engine/techniques/lpv/injected_lights.cpp.
// Dachsbacher, Stamminger. Reflective Shadow Maps. 2005
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/lpv_map.glsl"
#include "shaders/shared/surface_pack.glsl"

layout(local_size_x = LPV_MAP_LANES, local_size_y = LPV_MAP_LANES) in;

layout(binding = LPV_MAP_ALBEDO) uniform sampler2D albedoMap;
layout(binding = LPV_MAP_SURFACE) uniform usampler2D surfaceMap;
layout(binding = LPV_MAP_DEPTH) uniform sampler2D depthMap;
layout(std430, binding = LPV_MAP_SUMS) buffer Sums { int sums[]; };

const float kInversePi = 0.31830989;

/// Share of the light that leaves in a direction.
float emittedShare(vec3 direction) {
    const float cosine = dot(direction, map.direction);
    if (map.kind == LPV_LIGHT_RECTANGLE)
        return max(cosine, 0.0);
    return map.kind != LPV_LIGHT_SPOT || cosine > map.cosOuter ? 1.0 : 0.0;
}

/// Window of range and cone of a point or spot light, as sampleLight() of engine/scene/light/light.cpp has it; 1 for
/// others.
float windowAt(vec3 direction, float distance) {
    if (map.kind != LPV_LIGHT_POINT && map.kind != LPV_LIGHT_SPOT)
        return 1.0;
    float window = 1.0;
    if (map.range > 0.0) {
        const float q = distance / map.range;
        window = clamp(1.0 - q * q * q * q, 0.0, 1.0);
    }
    if (map.kind == LPV_LIGHT_SPOT) {
        const float t = clamp((dot(direction, map.direction) - map.cosOuter) * map.spotScale, 0.0, 1.0);
        window *= t * t;
    }
    return window;
}

void send(vec3 position, vec3 normal, vec3 weight) {
    const vec3 off = position + normal * (map.cell * 0.5);
    const uvec3 at = uvec3(clamp((off - map.lower) / map.cell, vec3(0.0), vec3(map.size) - 0.5));
    const uint cell = (at.z * map.size.y + at.y) * map.size.x + at.x;
    const vec4 lobe = vec4(normal * LPV_COSINE_SLOPE, LPV_COSINE_MEAN) * map.scale;
    for (uint c = 0u; c < 3u; ++c) {
        const ivec4 share = ivec4(round(lobe * weight[c]));
        for (uint i = 0u; i < 4u; ++i)
            atomicAdd(sums[12u * cell + 4u * c + i], share[i]);
    }
}

void main() {
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, ivec2(map.mapSize))))
        return;
    const float depth = texelFetch(depthMap, texel, 0).r;
    const vec3 albedo = texelFetch(albedoMap, texel, 0).rgb;
    if (!(depth > 0.0) || albedo == vec3(0.0))
        return;
    const vec2 at = (vec2(texel) + 0.5) * (2.0 / float(map.mapSize)) - 1.0;
    const vec3 across = at.x * map.right - at.y * map.up; // the first row is the upper one
    vec3 position, direction = map.forward;
    float spread = map.texelArea, distance = map.depthUnit * (1.0 - depth);
    if (map.parallel == 1u) {
        position = map.origin + across + map.forward * distance;
    } else {
        const vec3 way = map.forward + across;
        const float length1 = length(way), along = map.depthUnit / depth;
        position = map.origin + way * along;
        direction = way / length1;
        distance = length1 * along;
        spread /= length1 * length1 * length1;
    }
    const float share = map.parallel == 1u ? 1.0 : emittedShare(direction);
    const float incident = map.power * spread * share * windowAt(direction, distance);
    if (!(incident > 0.0))
        return;
    vec3 normal = octDecode(unpackSnorm2x16(texelFetch(surfaceMap, texel, 0).w));
    if (dot(normal, direction) > 0.0)
        normal = -normal;
    send(position, normal, albedo * (incident * kInversePi));
}
