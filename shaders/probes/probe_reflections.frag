// SPDX-License-Identifier: MIT
// Adds what glossy surfaces reflect of what probes see: rays are marched through the probes' maps.
// McGuire, Mara, Nowrouzezahrai, Luebke. Real-Time Global Illumination using Precomputed Light Field Probes. 2017
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/light_pass.glsl"
#include "shaders/shared/gpu_probes.h"

layout(constant_id = 2) const uint kMapSide = 1; // texels along the side of a probe's map

layout(set = 0, binding = FRAME_EMITTED) uniform sampler2D emittedImage;
layout(set = 0, binding = FRAME_REFLECTIONS) uniform sampler2DArray reflectionTable;
layout(set = 1, binding = MARCHED_PLANES, std430) readonly buffer MarchedPlanes { vec4 marchedPlanes[]; };
layout(set = 1, binding = MARCHED_NEAREST, std430) readonly buffer MarchedNearest { float marchedNearest[]; };
layout(set = 1, binding = MARCHED_RADIANCE, std430) readonly buffer MarchedRadiance { float marchedRadiance[]; };

#include "shaders/probes/march_ray.glsl"

vec3 reflected(PackedSurface s) {
    const float NoV = clamp(dot(s.detailNormal, s.toEye), 0.0, 1.0);
    const ReflectionLobe lobe = reflectionLobe(reflectionTable, s.roughness, NoV, 2);
    const vec3 axis =
        normalize(lobe.towards.x * s.detailNormal + lobe.towards.y * reflect(-s.toEye, s.detailNormal));
    const vec3 size = vec3(frame.gridSize) / frame.gridScale;
    // Half of the microfacets seen along the normal are tilted by less than atan(roughness^2).
    const vec3 radiance = marchedReflection(s.position + s.geometricNormal * (MARCH_OFFSET * norm1(size)), axis,
                                            2.0 * atan(s.roughness * s.roughness));
    return (s.F0 * lobe.share.x + lobe.share.y) * radiance;
}

void main() {
    const float depth = texelFetch(depthImage, ivec2(gl_FragCoord.xy), 0).r;
    const float read = abs(texelFetch(emittedImage, ivec2(gl_FragCoord.xy), 0).a); // as surface.frag says
    const bool apart = kView == VIEW_LIT && depth > 0.0 && fract(read) > 0.0;
    outColor = vec4(0);
    // A loop instead of a branch, because software rasterisers evaluate branches that no pixel of a block takes.
    for (int once = 0; once < int(apart); ++once)
        outColor = vec4(reflected(seenSurface(depth)), 0);
}
