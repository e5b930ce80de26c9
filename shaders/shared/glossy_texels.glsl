// SPDX-License-Identifier: MIT
// The maps for reflections in a buffer. Needs `glossy`, three floats for each texel.

vec3 read(uint texel) {
    return vec3(glossy[3u * texel], glossy[3u * texel + 1u], glossy[3u * texel + 2u]);
}

void write(uint texel, vec3 value) {
    glossy[3u * texel] = value.r;
    glossy[3u * texel + 1u] = value.g;
    glossy[3u * texel + 2u] = value.b;
}

/// The first of the four texels below texel `t` of a level with that many along its side.
uint childOf(uint t, uint side) {
    return 4u * (t / side) * side + 2u * (t % side);
}
