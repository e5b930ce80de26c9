// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstring>

namespace limn::runtime {

/// Four floats in a register: red, green, blue and luma, or a box's corner. GCC's and Clang's
/// vectors, which become SSE, NEON or wasm's SIMD.
typedef float F4 __attribute__((vector_size(16)));

inline F4 load4(const float* p) {
    F4 v;
    std::memcpy(&v, p, sizeof v);
    return v;
}
inline F4 load3(const float* p) {
    return F4{p[0], p[1], p[2], 0};
}
inline F4 splat(float v) {
    return F4{v, v, v, v};
}

/// A point or direction in double precision, for the geometry of lights.
struct Vec3 {
    double x = 0, y = 0, z = 0;
};
inline Vec3 vec3(const float* p) {
    return {double(p[0]), double(p[1]), double(p[2])};
}
inline Vec3 operator+(Vec3 a, Vec3 b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec3 operator-(Vec3 a, Vec3 b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec3 operator-(Vec3 a) {
    return {-a.x, -a.y, -a.z};
}
inline Vec3 operator*(Vec3 a, double s) {
    return {a.x * s, a.y * s, a.z * s};
}
inline double dot(Vec3 a, Vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec3 cross(Vec3 a, Vec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vec3 a) {
    return std::sqrt(dot(a, a));
}

} // namespace limn::runtime
