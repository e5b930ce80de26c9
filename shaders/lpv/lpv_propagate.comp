// SPDX-License-Identifier: MIT
// A round of propagation: each cell receives from its six neighbours through its five far faces, and sends that on as
// lobes about the faces' normals. As propagateOnce() of engine/techniques/lpv/propagation.h.
// Kaplanyan, Dachsbacher. Cascaded Light Propagation Volumes for Real-Time Indirect Illumination. 2010
#version 460
#extension GL_GOOGLE_include_directive : require
#include "shaders/shared/lpv_cell.glsl"

layout(std430, binding = LPV_BLOCKERS) readonly buffer Blockers { vec4 blockers[]; };
layout(std430, binding = LPV_FROM) readonly buffer From { vec4 from[]; };
layout(std430, binding = LPV_TO) writeonly buffer To { vec4 to[]; };
layout(std430, binding = LPV_SUM) buffer Sum { vec4 sum[]; };

const float kY0 = 0.28209479, kY1 = 0.48860251;        // Y_00; Y_1m of a coordinate of 1
const float kAhead = 0.89442719, kAcross = 0.44721360; // 2 and 1 over sqrt(5)
const float kInversePi = 0.31830989;

/// A function of two bands in the directions to the five far faces: ahead, then up and down the second axis, then the
/// third.
struct Faces {
    float ahead;
    vec4 sides;
};

/// `way` is 1 or -1, for steps up or down the axis.
Faces towardsFaces(vec4 lobe, int axis, float way) {
    const int second = (axis + 1) % 3, third = (axis + 2) % 3;
    const float mean = lobe.w * kY0, along = lobe[axis] * (way * kY1);
    const float b = lobe[second] * (kAcross * kY1), c = lobe[third] * (kAcross * kY1);
    return Faces(mean + along, vec4(mean + along * kAhead) + vec4(b, -b, c, -c));
}

// A comparison, because max() of a NaN is undefined.
float notBelow0(float v) {
    return v > 0.0 ? v : 0.0;
}
vec4 notBelow0(vec4 v) {
    return vec4(notBelow0(v.x), notBelow0(v.y), notBelow0(v.z), notBelow0(v.w));
}

/// Share of the light that passes on its way to the five faces. A blocker is a function of where light comes from.
Faces passing(uint face, int axis, float way) {
    const vec4 blocker = blockers[axis * volumeCells(lattice.size) + face];
    const Faces blocked = towardsFaces(vec4(-blocker.xyz, blocker.w), axis, way);
    return Faces(notBelow0(1.0 - notBelow0(blocked.ahead)), notBelow0(vec4(1.0) - notBelow0(blocked.sides)));
}

void receive(uint cell, int axis, float way, inout vec4 received[3]) {
    const int second = (axis + 1) % 3, third = (axis + 2) % 3;
    const uint stride = volumeStrides(lattice.size)[axis];
    const uint neighbour = way > 0.0 ? cell - stride : cell + stride;
    Faces share = Faces(1.0, vec4(1.0));
    if (lattice.first == 0u)
        share = passing(way > 0.0 ? cell : cell + stride, axis, way);
    share.ahead *= LPV_FRONT_SOLID_ANGLE * kInversePi;
    share.sides *= LPV_SIDE_SOLID_ANGLE * kInversePi;
    for (int c = 0; c < 3; ++c) {
        const Faces light = towardsFaces(from[c * volumeCells(lattice.size) + neighbour], axis, way);
        const float ahead = notBelow0(light.ahead) * share.ahead;
        const vec4 sides = notBelow0(light.sides) * share.sides;
        received[c].w += (ahead + ((sides.x + sides.y) + (sides.z + sides.w))) * LPV_COSINE_MEAN;
        received[c][axis] += ahead * (way * LPV_COSINE_SLOPE);
        received[c][second] += (sides.x - sides.y) * LPV_COSINE_SLOPE;
        received[c][third] += (sides.z - sides.w) * LPV_COSINE_SLOPE;
    }
}

void main() {
    if (!isInside(gl_GlobalInvocationID))
        return;
    const uint cell = volumeIndex(lattice.size, gl_GlobalInvocationID), cells = volumeCells(lattice.size);
    vec4 received[3] = {vec4(0.0), vec4(0.0), vec4(0.0)};
    receive(cell, 0, 1.0, received);
    receive(cell, 0, -1.0, received);
    receive(cell, 1, 1.0, received);
    receive(cell, 1, -1.0, received);
    receive(cell, 2, 1.0, received);
    receive(cell, 2, -1.0, received);
    for (uint c = 0u; c < 3u; ++c) {
        const uint k = c * cells + cell;
        to[k] = received[c];
        sum[k] = (lattice.first == 1u ? from[k] : sum[k]) + received[c];
    }
}
