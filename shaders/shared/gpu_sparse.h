// SPDX-License-Identifier: MIT
// Read by C++ and GLSL. Each row is 16 bytes, so std430 and the C++ layout agree.
#ifndef SHADERS_SHARED_GPU_SPARSE_H
#define SHADERS_SHARED_GPU_SPARSE_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/vec3.hpp>
namespace limn::shared {
using glm::vec3;
using uint = std::uint32_t;
#endif

// Bindings of set 0. Colours are vec4 with w = 0. Harmonics are in rows of an even number of
// values.
#define SPARSE_RECEIVERS 0u  // GpuReceiver per receiver
#define SPARSE_DIRECT 1u     // irradiance from lights per receiver [W m^-2]
#define SPARSE_ALBEDO 2u     // per receiver
#define SPARSE_EMISSION 3u   // radiance per receiver [W m^-2 sr^-1]
#define SPARSE_IRRADIANCE 4u // bounced, per receiver [W m^-2]
#define SPARSE_RADIANCE 5u   // that receivers send [W m^-2 sr^-1]
#define SPARSE_CHANGE                                                                              \
    6u // vec4 per group of receivers: change, total, relative, by area shares; brightest
#define SPARSE_HITS 7u    // per probe and relight ray: as traceRelightRays()
#define SPARSE_BASIS 8u   // float: harmonics of each relight direction
#define SPARSE_SKY 9u     // a row per probe of what it sees of the sky
#define SPARSE_PROBES 10u // a row per probe of what it sees
#define SPARSE_NEAR 11u   // uvec4 per receiver: eight probes; or GpuCluster per cluster
#define SPARSE_TRANSPORT                                                                           \
    12u                  // pairs of halfs of a block of receivers, or words of a block of clusters
#define SPARSE_CELLS 13u // per cell of the grid: eight probes, then the bits of their weights
#define SPARSE_GRID 14u  // as GpuField::grid
#define SPARSE_LIGHTMAP 15u // the storage image
#define SPARSE_BINDINGS 16u

#define SPARSE_PROBES_PER_RECEIVER 8u // as limn::kProbesPerReceiver
#define SPARSE_DARK_HIT 0xfffffffeu   // as limn::kDarkHit: hits from here on are no receivers
#define SPARSE_CLUSTER_RECEIVERS 256u // as limn::kMaxClusterReceivers

// clang-format off
/// A receiver. The first two rows begin as PointBuffers::points.
struct GpuReceiver {
    vec3 position; float share; // m; of the area of all receivers
    vec3 normal; uint texel;    // unit; y * width + x
};

/// A cluster of a compressed transport. Offsets are those of words in its block.
struct GpuCluster {
    uint receivers, receiverCount; // ids
    uint probes, probeCount;       // ids
    uint left;  // pairs of halfs of L, all receivers' first pair before their second one
    uint right; // pairs of halfs of R, by probe, then by pair of coefficients, then by component
    uint rank, pad;
};

/// Push constants of every step.
struct GpuSparseRange {
    uint begin, end;   // items: receivers, probes, clusters or cells
    uint clampParts;   // 1: as TechniqueSetting "sparse-probes.clamp"
    uint coefficients; // of the field
    float fieldScale;
};
// clang-format on

#ifdef __cplusplus
static_assert(sizeof(GpuReceiver) == 32);
static_assert(sizeof(GpuCluster) == 32);
static_assert(sizeof(GpuSparseRange) == 20);
} // namespace limn::shared
#endif

#endif
