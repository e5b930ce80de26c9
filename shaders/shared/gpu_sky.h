// SPDX-License-Identifier: MIT
// Read by C++ and GLSL.
#ifndef SHADERS_SHARED_GPU_SKY_H
#define SHADERS_SHARED_GPU_SKY_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/vec3.hpp>
namespace limn::shared {
using glm::vec3;
using uint = std::uint32_t;
#endif

/// Push constants of the sky behind everything: limn::Sky [nits].
struct GpuSky {
    vec3 zenith;
    float strength; // of the image
    vec3 horizon;
    float turn; // of the image, in whole turns
    vec3 ground;
    uint image; // 0: the gradient
};

#ifdef __cplusplus
static_assert(sizeof(GpuSky) == 48);
} // namespace limn::shared
#endif

#endif
