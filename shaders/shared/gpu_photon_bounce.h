// SPDX-License-Identifier: MIT
// Read by C++ and GLSL. Each row is 16 bytes, so std430 and the C++ layout agree.
#ifndef SHADERS_SHARED_GPU_PHOTON_BOUNCE_H
#define SHADERS_SHARED_GPU_PHOTON_BOUNCE_H

#include "shaders/shared/gpu_rsm.h"

#ifdef __cplusplus
namespace limn::shared {
#endif

// Bindings of set 0 after those of the map
#define PHOTON_MAP_RECEIVER 3u
#define PHOTON_MAP_GLASS                                                                           \
    4u // per instance: transmission, index of refraction, 1 for a thin sheet, 0
#define PHOTON_MAP_BOUNCES 5u // GpuBounce per texel of all views, in the order of castRsm()
#define PHOTON_MAP_BINDINGS 6u

#define PHOTON_MAP_LANES 8    // of a group along each side of a map
#define PHOTON_START_PAIRS 4u // as kStartPairs

// limn::PhotonEvent; 0: absorbed
#define PHOTON_DIFFUSE 1u
#define PHOTON_SPECULAR 2u
#define PHOTON_TRANSMITTED 3u
#define PHOTON_EVENTS 3u // mask of them
#define PHOTON_NARROW 4u

// clang-format off
/// A view of a light's map, and its place among all views.
struct GpuPhotonMap {
    GpuRsmView view;
    uint viewIndex, turned, pad0, pad1; // of limn::rsmViews(); 1: `right` and `up` are exchanged
};

/// A photon after its first bounce.
struct GpuBounce {
    vec3 power; uint event;       // W; PHOTON_*
    vec3 direction; uint instance;
    vec3 position; float incident; // power that met the surface, in each colour; 0: the texel is dark
    vec3 normal; float pad;        // geometric, to the light
};
// clang-format on

#ifdef __cplusplus
static_assert(sizeof(GpuPhotonMap) == 112 && sizeof(GpuBounce) == 64);
} // namespace limn::shared
#endif

#endif
