// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/sample_field.h"
#include "engine/final_lightmap/lit_texels.h"
#include "engine/trace/trace_scene.h"

#include <array>
#include <cstdint>

namespace limn {

/// What a bilinear lookup of an exported lightmap blends.
struct TexelLookup {
    std::array<std::uint32_t, 4> texel{}; ///< indices into Atlas::texels
    std::array<float, 4> weight{};        ///< their sum is 1, or 0 where nothing can be read
};

/// The lookup at a point of a side of an instance, as a program without snaps does it.
TexelLookup lookUpTexels(const LitTexels& lit, std::uint32_t instance, std::uint32_t mesh,
                         const MeshPoint& point, bool back);

/// The coefficients of three bands of the field's incident radiance above a surface point. What the
/// field lets continue below the surface is cut off.
std::array<glm::vec3, 9> fieldCoefficients(const FieldPoint& point);

/// That point of the instance, as a ray from above that side hits it.
Hit hitOfPoint(const Scene& scene, std::uint32_t instance, const MeshPoint& point, bool back);

} // namespace limn
