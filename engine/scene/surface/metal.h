// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

#include <cstdint>

#include <glm/vec3.hpp>

namespace limn {

/// The metallic part of a surface point: the share `metallic` of it reflects by specularBrdf() with
/// F0 = base.
struct Metal {
    glm::vec3 base{0};   ///< base colour, each in [0, 1]
    float metallic = 0;  ///< [0, 1]
    float roughness = 1; ///< [0, 1]
};

/// Metal at barycentrics (u, v) of `triangle`.
Metal surfaceMetal(const Scene& scene, const Instance& instance, std::uint32_t triangle, float u,
                   float v);

} // namespace limn
