// SPDX-License-Identifier: MIT
// Writes the light of all rounds into the grid that the viewport samples, packed as engine/field/field_packing.h says.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/field_value.glsl"
#include "shaders/shared/lpv_cell.glsl"

layout(std430, binding = LPV_SUM) readonly buffer Sum { vec4 sum[]; };
layout(std430, binding = LPV_BRIGHTEST) readonly buffer Brightest { uint brightest; };
layout(std430, binding = LPV_GRID) writeonly buffer Grid { uvec2 grid[]; };

/// fieldScale() of engine/field/field_packing.h: a power of two, made of its exponent's bits.
float fieldScale() {
    const int exponent = int(brightest >> 23) - 127;
    if (brightest == 0u || exponent == 128)
        return 1.0;
    return uintBitsToFloat(uint(clamp(12 - exponent, -120, 120) + 127) << 23);
}

uint packed(float a, float b) {
    return packHalf2x16(vec2(fieldValue(a), fieldValue(b)));
}

void main() {
    const uvec3 at = gl_GlobalInvocationID, size = lattice.size;
    if (!isInside(at))
        return;
    const uint cell = volumeIndex(size, at), cells = volumeCells(lattice.size);
    const vec4 factors = vec4(vec3(lattice.slope), lattice.mean);
    const float scale = fieldScale(); // a product with the factors might leave the range of floats
    const vec4 r = sum[cell] * factors * scale, g = sum[cells + cell] * factors * scale,
               b = sum[2u * cells + cell] * factors * scale;
    // Red, green and blue of the harmonics l = 0, then y, z and x.
    const uint texel = (at.z * size.y + at.y) * size.x + at.x, texels = size.x * size.y * size.z;
    grid[texel] = uvec2(packed(r.w, g.w), packed(b.w, r.y));
    grid[texels + texel] = uvec2(packed(g.y, b.y), packed(r.z, g.z));
    grid[2u * texels + texel] = uvec2(packed(b.z, r.x), packed(g.x, b.x));
}
