// SPDX-License-Identifier: MIT
// The first bounce of the photons of one view of a light: each texel of its reflective shadow map is one.
// McGuire, Luebke. Hardware-Accelerated Global Illumination by Image Space Photon Mapping. 2009
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/gpu_photon_bounce.h"
#include "shaders/shared/rsm_texel.glsl"
#include "shaders/shared/sampler.glsl"

const float kPi = 3.14159265358979;
#include "shaders/shared/fresnel.glsl"
#include "shaders/shared/scatter.glsl"

layout(local_size_x = PHOTON_MAP_LANES, local_size_y = PHOTON_MAP_LANES) in;

layout(push_constant) uniform Constants { GpuPhotonMap map; };
layout(binding = PHOTON_MAP_RECEIVER) uniform sampler2D receiverMap;
layout(std430, binding = PHOTON_MAP_GLASS) readonly buffer Glasses { vec4 glasses[]; };
layout(std430, binding = PHOTON_MAP_BOUNCES) writeonly buffer Bounces { GpuBounce bounces[]; };

void main() {
    const ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(texel, ivec2(map.view.mapSize))))
        return;
    // The place of the ray that the CPU casts through this texel: its rows grow along `up`.
    const uint size = map.view.mapSize;
    const uvec2 place = map.turned == 1u ? uvec2(size - 1u - texel.y, texel.x) : uvec2(texel.x, size - 1u - texel.y);
    const uint index = (map.viewIndex * size + place.y) * size + place.x;
    GpuBounce bounce = GpuBounce(vec3(0), 0u, vec3(0), 0u, vec3(0), 0.0, vec3(0), 0.0);
    RsmTexel seen;
    vec3 direction;
    if (readRsmPlace(map.view, texel, seen, direction)) {
        const vec4 receiver = texelFetch(receiverMap, texel, 0);
        const PackedSurface s = unpackSurface(texelFetch(surfaceMap, texel, 0), receiver);
        if (dot(s.detailNormal, s.geometricNormal) > -0.99) { // else the back of a one-sided surface
            const float side = dot(s.geometricNormal, direction) < 0.0 ? 1.0 : -1.0;
            PhotonSurface p;
            p.geometricNormal = side * s.geometricNormal;
            p.normal = side * s.detailNormal;
            p.diffuse = s.albedo;
            p.metal = s.baseColor;
            p.metallic = s.metallic;
            p.roughness = s.roughness;
            const uint instance = min(uint(s.lightmapUv.x), uint(glasses.length()) - 1u);
            const vec4 glass = glasses[instance];
            p.transmitted = (1.0 - s.metallic) * glass.x;
            p.tint = s.baseColor * p.transmitted;
            p.ior = glass.y;
            p.isThin = glass.z > 0.0;
            p.inside = false;
            const Way way = scatter(p, direction, vec3(seen.incident), index, PHOTON_START_PAIRS);
            bounce = GpuBounce(way.share, way.event, way.direction, instance, seen.position, seen.incident,
                               p.geometricNormal, 0.0);
        }
    }
    bounces[index] = bounce;
}
