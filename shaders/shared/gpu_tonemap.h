// SPDX-License-Identifier: MIT
// Read by C++ and GLSL.
#ifndef SHADERS_SHARED_GPU_TONEMAP_H
#define SHADERS_SHARED_GPU_TONEMAP_H

#ifdef __cplusplus
#include <cstdint>
namespace limn::shared {
using uint = std::uint32_t;
#endif

// The order of limn::Tonemap.
#define TONEMAP_NONE 0u
#define TONEMAP_ACES 1u
#define TONEMAP_AGX 2u
#define TONEMAP_PBR_NEUTRAL 3u

/// Push constants of the tone-mapping pass.
struct GpuTonemap {
    float exposure; // factor
    uint curve;     // TONEMAP_*
    float fade;     // 0: unchanged; towards 1: greyer and darker, beneath an overlay
    uint invalid;   // 1: pixels with a NaN or Inf are magenta, as are those around them
};

#ifdef __cplusplus
static_assert(sizeof(GpuTonemap) == 16);
} // namespace limn::shared
#endif

#endif
