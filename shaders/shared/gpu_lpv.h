// SPDX-License-Identifier: MIT
// Read by C++ and GLSL. Each row is 16 bytes, so std430 and the C++ layout agree.
#ifndef SHADERS_SHARED_GPU_LPV_H
#define SHADERS_SHARED_GPU_LPV_H

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

// A lobe of one colour is a vec4: the three harmonics of l = 1 in the order x, y, z, then that of
// l = 0. Volumes have a border of one cell on each side. In those of light, the lobe of colour c in
// cell k is c times the number of cells + k [W sr^-1]; in the blockers, that of the face between a
// cell and the one before it along axis a is a times the number of cells + k.

// Bindings of set 0
#define LPV_BLOCKERS 0u
#define LPV_FROM 1u      // light to propagate; what is injected before the first round
#define LPV_TO 2u        // light after a round
#define LPV_SUM 3u       // light of all rounds so far
#define LPV_BRIGHTEST 4u // bits of the field's largest magnitude, a float
#define LPV_GRID 5u      // as IndirectField::grid, packed
#define LPV_BINDINGS 6u

// Number of invocations of a group along each axis of the lattice, or of a list of lobes
#define LPV_GROUP_X 8
#define LPV_GROUP_Y 4
#define LPV_GROUP_Z 2
#define LPV_LIST_LANES 64

// Solid angles in which the middle of a cell sees faces of the next one [sr]
#define LPV_FRONT_SOLID_ANGLE 0.40066968f
#define LPV_SIDE_SOLID_ANGLE 0.42343136f
// Harmonics of a clamped cosine
#define LPV_COSINE_MEAN 0.88622693f
#define LPV_COSINE_SLOPE 1.02332671f

// clang-format off
/// What a light of colour 1 sends into a cell.
struct GpuCellLobe { vec4 color[3]; uint cell, pad0, pad1, pad2; };

/// Push constants of every step.
struct GpuLpvStep {
    uvec3 size; uint count;   // cells without the border; inject: lobes in the list
    vec3 color; uint first;   // inject: of the light; propagate: 1 in the first round, which nothing blocks
    float mean, slope;        // field: factors of its bands
    float pad0, pad1;
};
// clang-format on

#ifdef __cplusplus
static_assert(sizeof(GpuCellLobe) == 64);
static_assert(sizeof(GpuLpvStep) == 48);
} // namespace limn::shared
#endif

#endif
