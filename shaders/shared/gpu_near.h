// SPDX-License-Identifier: MIT
// Read by C++ and GLSL. Each row is 16 bytes, so std430 and the C++ layout agree.
#ifndef SHADERS_SHARED_GPU_NEAR_H
#define SHADERS_SHARED_GPU_NEAR_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
namespace limn::shared {
using glm::vec2;
using glm::vec3;
using uint = std::uint32_t;
#endif

// clang-format off
/// Node of a bounding volume hierarchy in depth-first order. A ray that misses its box goes on at node `next`, which
/// comes after the whole subtree; a ray that meets it, at the following node.
struct GpuNearNode {
    vec3 lower; uint next;      // m
    vec3 upper; uint triangles; // m; of a leaf: number of its first triangle * 8 + number of triangles, else 0
};

/// A static triangle with a lightmap, in world space; its front is counter-clockwise. Vertex normals are octahedral maps
/// in 2 x 16-bit snorm.
struct GpuNearTriangle {
    vec3 origin; uint normal0; // first vertex; normal of that vertex
    vec3 edge1;  uint normal1; // from the first vertex to the second
    vec3 edge2;  uint normal2;
    vec2 uv0; vec2 uv1;        // of the lightmap
    vec2 uv2; uint albedo; float backOffset; // square roots in bytes, then NEAR_*; as GpuDraw
};

/// Push constants of near.frag.
struct GpuNear {
    uint rays;  // number of rays of each pixel
    uint first; // index of the first of them in the pixel's sequence
};
// clang-format on

#define NEAR_DOUBLE_SIDED 1u
#define NEAR_EMISSIVE 2u

#ifdef __cplusplus
static_assert(sizeof(GpuNearNode) == 32);
static_assert(sizeof(GpuNearTriangle) == 80);
} // namespace limn::shared
#endif

#endif
