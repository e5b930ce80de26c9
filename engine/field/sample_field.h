// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/indirect_field.h"
#include "engine/lightmap/lightmap_layout.h"
#include "engine/math/sh.h"
#include "engine/scene/scene.h"

#include <array>
#include <cstdint>

namespace limn {

/// A surface point that looks a field up: in the lightmap, or in the grid where its instance has no
/// lightmap.
struct FieldPoint {
    const IndirectField& field;
    const LightmapLayout& layout;
    const Scene& scene;
    std::uint32_t instance, triangle;
    float u, v; ///< barycentrics of the triangle
    glm::vec3 position;
    glm::vec3 normal;  ///< unit, of the side in question
    bool back = false; ///< that side is the back of a two-sided surface
};

/// Irradiance [W m^-2], >= 0.
glm::vec3 sampleIrradiance(const FieldPoint& at);

/// Mean radiance [W m^-2 sr^-1], >= 0, in a lobe about unit `direction`: of the first `bands`
/// bands, or as many as the field has, by their factors.
glm::vec3 sampleLobe(const FieldPoint& at, glm::vec3 direction, int bands,
                     const std::array<float, kMaxBands>& factors);

} // namespace limn
