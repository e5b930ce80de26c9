// SPDX-License-Identifier: MIT
// A camera's picture, as the viewport drew it, and the grids of caches about its eye.
#include "shaders/shared/gpu_volumes.h"
#include "shaders/shared/surface_pack.glsl"

layout(push_constant) uniform Push { GpuVolumeDemand picture; };
layout(binding = VOLUME_DEMAND_SURFACE) uniform usampler2D surfaceMap;
layout(binding = VOLUME_DEMAND_DEPTH) uniform sampler2D depthMap;
layout(std430, binding = VOLUME_DEMAND_GRIDS) readonly buffer Grids { GpuCacheGrids volume; };

#include "shaders/shared/volume_grids.glsl"

/// A pixel's surface. False where there is none.
bool surfaceAt(uvec2 pixel, out vec3 p, out vec3 normal) {
    const float depth = texelFetch(depthMap, ivec2(pixel), 0).r;
    const vec2 ndc = 2.0 * (vec2(pixel) + 0.5) / vec2(picture.width, picture.height) - 1.0;
    const vec3 ray = picture.rayCentre + ndc.x * picture.rayRight - ndc.y * picture.rayUp;
    p = picture.eye + ray * (picture.depthScale / (depth - picture.depthOffset));
    normal = octDecode(unpackSnorm2x16(texelFetch(surfaceMap, ivec2(pixel), 0).w));
    if (dot(normal, ray) > 0.0) // maps are drawn without an eye to turn normals to
        normal = -normal;
    return depth > 0.0;
}
