// SPDX-License-Identifier: MIT
// Directions on the octahedron |x| + |y| + |z| = 1, and its lower half unfolded into a square.
#ifndef SHADERS_SHARED_OCTAHEDRON_GLSL
#define SHADERS_SHARED_OCTAHEDRON_GLSL

float unfolded(float v, float signOf) {
    return signOf < 0.0 ? -v : v;
}

float norm1(vec3 v) {
    return abs(v.x) + abs(v.y) + abs(v.z);
}

#endif
