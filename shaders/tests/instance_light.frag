// SPDX-License-Identifier: MIT
// A light pass for tests: the irradiance of each instance, and glossy radiance a tenth of it, stand in a buffer.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/light_pass.glsl"

layout(constant_id = 2) const uint kFactor = 1;

layout(set = 1, binding = 0, std430) readonly buffer Light { vec4 light[]; };

void main() {
    PackedSurface s;
    outColor = vec4(0);
    if (litSurface(s))
        writeLight(s, light[instanceOf(s)].rgb * float(kFactor), light[instanceOf(s)].rgb * 0.1);
}
