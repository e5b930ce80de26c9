// SPDX-License-Identifier: MIT
// Writes the irradiance of receivers into the lightmap as constant radiance, of which every normal reads the same
// irradiance. All layers but the first stay 0.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/field_value.glsl"
#include "shaders/shared/sparse.glsl"

layout(std430, binding = SPARSE_RECEIVERS) readonly buffer Receivers { GpuReceiver receivers[]; };
layout(std430, binding = SPARSE_IRRADIANCE) readonly buffer Irradiance { vec4 irradiance[]; };
layout(binding = SPARSE_LIGHTMAP, rgba16f) uniform writeonly image2DArray lightmap;

const float kRadiancePerIrradiance = 1.12837917; // of engine/techniques/sparse_probes/sparse_gather.h

void main() {
    const uint r = itemIndex();
    if (r >= range.end)
        return;
    const uint texel = receivers[r].texel, width = imageSize(lightmap).x;
    const vec3 c = irradiance[r].rgb * kRadiancePerIrradiance * range.fieldScale;
    imageStore(lightmap, ivec3(texel % width, texel / width, 0),
               vec4(fieldValue(c.r), fieldValue(c.g), fieldValue(c.b), 0));
}
