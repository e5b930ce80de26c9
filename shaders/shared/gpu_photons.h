// SPDX-License-Identifier: MIT
// Read by C++ and GLSL. Each row is 16 bytes, so std430 and the C++ layout agree.
#ifndef SHADERS_SHARED_GPU_PHOTONS_H
#define SHADERS_SHARED_GPU_PHOTONS_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
namespace limn::shared {
using glm::uvec3;
using glm::vec3;
using glm::vec4;
using uint = std::uint32_t;
#endif

// Bindings of set 1 of the pass that adds photons' light
#define PHOTON_LATTICES 0u // uniform: GpuPhotons
#define PHOTON_ENTRIES                                                                             \
    1u                   // per cell of the lattices: its number in PHOTON_CELLS, or PHOTON_NO_ENTRY
#define PHOTON_CELLS 2u  // GpuPhotonCell
#define PHOTON_SPLATS 3u // GpuSplat, in the order of their buckets
#define PHOTON_SPLAT_BUCKETS                                                                       \
    4u // where each bucket's splats begin; the last one ends at the number of splats
#define PHOTON_BINDINGS 5u

#define PHOTON_NO_ENTRY 0xffffffffu
#define PHOTON_LATTICE_COUNT 3

// clang-format off
/// As limn::Lattice.
struct GpuPhotonLattice {
    vec3 lower; float cell; // m
    uvec3 size; uint first; // cells; index of cell 0 in PHOTON_ENTRIES
};

struct GpuPhotons {
    GpuPhotonLattice lattice[PHOTON_LATTICE_COUNT];
    uint trilinear, splats, bucketMask; float splatRadius; // 1 or 0; number; m
    float factor, lift, minArea, minCosine; // of irradiance; over a cell's side; over a cell's face; of splats' normals
};

/// Light in the first three, area in the last; coefficient i of the harmonics in row i.
struct GpuPhotonCell {
    vec4 value[4];
};

struct GpuSplat {
    vec3 power; float pad0;
    vec3 position; float pad1;
    vec3 normal; float pad2;
};
// clang-format on

#ifdef __cplusplus
static_assert(sizeof(GpuPhotons) == 128);
} // namespace limn::shared
#endif

/// Bucket of a cell of the splats' grid.
#ifdef __cplusplus
namespace limn::shared {
inline
#endif
    uint
    photonBucket(int x, int y, int z, uint mask) {
    uint h = uint(x) * 0x9e3779b1u ^ uint(y) * 0x85ebca77u ^ uint(z) * 0xc2b2ae3du;
    h ^= h >> 15;
    h *= 0x2c1b3c6du;
    h ^= h >> 12;
    return h & mask;
}
#ifdef __cplusplus
} // namespace limn::shared
#endif

#endif
