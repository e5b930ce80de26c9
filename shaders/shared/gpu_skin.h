// SPDX-License-Identifier: MIT
// Light caches on objects and their proxy lights. Read by C++ and GLSL. Each row is 16 bytes, so
// std430 and the C++ layout agree.
#ifndef SHADERS_SHARED_GPU_SKIN_H
#define SHADERS_SHARED_GPU_SKIN_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
namespace limn::shared {
using glm::ivec3;
using glm::uvec4;
using glm::vec3;
using glm::vec4;
using uint = std::uint32_t;
#endif

// Bindings of set 1 of skin_light.frag
#define SKIN_CACHES 0u
#define SKIN_LISTS 1u
#define SKIN_CUBES 2u
#define SKIN_PROXIES 3u
#define SKIN_INSTANCES 4u
#define SKIN_BINDINGS 5u

#define SKIN_NO_CACHE 0xffffffffu // fills lists of meshes with fewer than 16 caches
#define SKIN_LIST_BITS 5u         // of GpuSkinCube::lists; the lower ones hold the number of lists

// clang-format off
struct GpuSkinCache {
    vec3 position; float pad0; // m, world
    vec3 normal; float pad1;   // unit, world
};

/// Caches of a mesh near surfaces of one cube and one bin of normals.
struct GpuSkinList {
    vec3 normal; float pad;   // mean of the bin, unit, in object space
    uvec4 cache[4];           // numbers within the mesh
};

/// The cubes of a mesh follow each other in the order of z, y, x.
struct GpuSkinCube {
    ivec3 cube; uint lists; // number of its first list in the upper bits, how many it has in the lower ones
};

struct GpuSkinProxies {
    vec3 diffusePlace; float diffuseDistance; // m; from the cache
    vec3 diffuseFlux;  float pad0; // W
    vec3 glossyPlace;  float glossyDistance;
    vec3 glossyFlux;   float pad1;
};

struct GpuSkinInstance {
    vec4 toObject[3];             // rows of world to object
    vec3 normalRow0; uint cache;  // rows of the matrix of normals, not normalised; number of its first cache
    vec3 normalRow1; uint cube;   // of its mesh's first cube
    vec3 normalRow2; uint cubes;  // number of those
    float edge; uint pad0, pad1, pad2; // of a cube, in object space
};
// clang-format on

#ifdef __cplusplus
static_assert(sizeof(GpuSkinCache) == 32);
static_assert(sizeof(GpuSkinList) == 80);
static_assert(sizeof(GpuSkinCube) == 16);
static_assert(sizeof(GpuSkinProxies) == 64);
static_assert(sizeof(GpuSkinInstance) == 112);
} // namespace limn::shared
#endif

#endif
