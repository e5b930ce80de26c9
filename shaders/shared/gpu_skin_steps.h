// SPDX-License-Identifier: MIT
// Virtual area lights, their choice, and what light caches receive of them. Read by C++ and GLSL.
// Each row is 16 bytes, so std430 and the C++ layout agree.
#ifndef SHADERS_SHARED_GPU_SKIN_STEPS_H
#define SHADERS_SHARED_GPU_SKIN_STEPS_H

#include "shaders/shared/gpu_rsm.h"

#ifdef __cplusplus
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
namespace limn::shared {
using glm::mat4;
using glm::uvec2;
#endif

// Bindings of set 0 after those of a map
#define SKIN_STEP_TEXELS                                                                           \
    3u // GpuVirtualLight of each texel of a light's views: column (view size + x), then row
#define SKIN_STEP_IMPORTANCE 4u // float of each texel
#define SKIN_STEP_SUMS                                                                             \
    5u // floats: sums down the columns of importance, of flux and of area; along their sums of each
#define SKIN_STEP_SAMPLES 6u  // GpuViewSample
#define SKIN_STEP_CHOSEN 7u   // GpuChosenLight
#define SKIN_STEP_CACHES 8u   // GpuGatheringCache
#define SKIN_STEP_RECEIVED 9u // SKIN_SUMS floats of each cache, as limn::CacheSums
#define SKIN_STEP_DRAWS 10u   // GpuLightDraw of each draw
#define SKIN_STEP_BINDINGS 11u

#define SKIN_SUMS 20
#define SKIN_MAP_LANES 8      // of a group along each side of a map
#define SKIN_SEEN_SHARE 0.125 // as kSeenShare
#define SKIN_BATCH 65536u     // virtual lights that are gathered at once

// clang-format off
/// A disc; area 0: the texel is dark.
struct GpuVirtualLight {
    vec3 position; float area; // m; m^2, across the beam
    vec3 flux; uint normal;    // reflected, of a light of colour 1; two snorms of octEncode()
};

struct GpuViewSample {
    vec3 position; float found; // m; 1, or 0: the view shows no surface there
    vec3 normal; uint pixel;    // unit, of the side that is seen; of a cache: x + 65536 y
};

/// The texel that a draw chose.
struct GpuLightDraw {
    uint texel; float weight; // 1 / (N P); 0: there was nothing to draw
};

struct GpuChosenLight {
    vec3 position; float area;
    vec3 normal; float weight; // 1 / (N P); 0: it counts for nothing
    vec3 flux; float pad;      // times the weight
};

struct GpuGatheringCache {
    vec3 position; float exponent; // of its lobe; 0: it gathers nothing glossy
    vec3 normal; float pad;
};

/// A view of a light's map.
struct GpuSkinMap {
    GpuRsmView view;
    uint column, turned; uint pad0, pad1; // first one; as DrawnRsmView::turned
};

/// A picture in which samples are found.
struct GpuSkinView {
    mat4 fromClip;
    uvec2 size; uint samples; uint pad0;
    vec3 eye; float near; // m; distance within which a cache's own surface lies [m]
};

struct GpuSkinStep {
    uint columns, rows, samples, count; // of the map; of the view; lights to choose, or in the batch
    uint first, defensive, all, add;    // of the batch; draws by flux and area; every texel counts; the sums go on
    vec3 eye; float nearest;            // m; m, below which lights beside a sample count alike
    uint caches; float epsilon; // m^-2; weight of an area that does not light a cache
    uint block, blocks;         // of the draws that are made again, as DrawBlock
};
// clang-format on

#ifdef __cplusplus
static_assert(sizeof(GpuVirtualLight) == 32);
static_assert(sizeof(GpuViewSample) == 32);
static_assert(sizeof(GpuLightDraw) == 8);
static_assert(sizeof(GpuChosenLight) == 48);
static_assert(sizeof(GpuGatheringCache) == 32);
static_assert(sizeof(GpuSkinMap) == 112);
static_assert(sizeof(GpuSkinView) == 96);
static_assert(sizeof(GpuSkinStep) == 64);
} // namespace limn::shared
#endif

#endif
