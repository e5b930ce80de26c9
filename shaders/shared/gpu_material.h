// SPDX-License-Identifier: MIT
// Read by C++ and GLSL. Each row is 16 bytes, so std140, std430 and the C++ layout agree.
#ifndef SHADERS_SHARED_GPU_MATERIAL_H
#define SHADERS_SHARED_GPU_MATERIAL_H

#ifdef __cplusplus
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
namespace limn::shared {
using glm::vec3;
using glm::vec4;
using uint = std::uint32_t;
#endif

#define TEXTURE_BASE_COLOR 0
#define TEXTURE_METALLIC_ROUGHNESS 1
#define TEXTURE_NORMAL 2
#define TEXTURE_EMISSIVE 3
#define TEXTURE_COUNT 4

// clang-format off
struct GpuMaterial {
    vec4 baseColor;
    vec3 emission;   float metallic; // nits
    float roughness; float normalScale; float alphaCutoff; float transmission;
    float dielectricF0; float pad0; float pad1; float pad2; // F0: reflectance at normal incidence
    // uv' = (dot(row u, (uv, 1)), dot(row v, (uv, 1))): rows 2k, 2k + 1 for texture k; w of row 2k: texture coordinate set
    vec4 uvRows[8];
};
// clang-format on

// Specialisation constant 1 of surface.frag, indirect.frag and depth_mask.frag: what a material
// needs.
#define FEATURE_BASE_COLOR_TEXTURE 1u
#define FEATURE_METALLIC_ROUGHNESS_TEXTURE 2u
#define FEATURE_NORMAL_TEXTURE 4u
#define FEATURE_EMISSIVE_TEXTURE 8u
#define FEATURE_ALPHA_MASK 16u
#define FEATURE_LIGHTMAP 32u
#define FEATURE_GRID 64u
#define FEATURE_REFLECTED_APART 128u // what it reflects glossily is drawn by a LightPass

// Specialisation constant 0 of surface.frag, indirect.frag and direct.frag: the order of
// limn::View.
#define VIEW_LIT 0u
#define VIEW_DIRECT 1u
#define VIEW_INDIRECT 2u
#define VIEW_IRRADIANCE 3u
#define VIEW_ALBEDO 4u
#define VIEW_NORMALS 5u

#ifdef __cplusplus
static_assert(sizeof(GpuMaterial) == 192);
} // namespace limn::shared
#endif

#endif
