// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

#include <glm/vec3.hpp>

namespace limn {

/// How a surface point passes light on. What a smooth boundary does not reflect, which is 1 -
/// fresnelDielectric(), goes through by the share `tint`; the rest is scattered or absorbed.
struct Transmission {
    glm::vec3 tint{0};   ///< base colour * (1 - metallic) * transmission; each in [0, 1]
    float ior = 1.5f;    ///< of the body behind the surface, against vacuum; >= 1
    bool isThin = true;  ///< a sheet, which light crosses without bending
    float roughness = 1; ///< [0, 1]

    explicit operator bool() const { return tint != glm::vec3(0); }
};

/// Transmission at barycentrics (u, v) of `triangle`.
Transmission surfaceTransmission(const Scene& scene, const Instance& instance,
                                 std::uint32_t triangle, float u, float v);

/// Share of unpolarised light that a smooth boundary between dielectrics reflects, in [0, 1].
/// `cosine` in [0, 1] is that of the angle of incidence; `eta` > 0 is the index of refraction on
/// the far side over that on the incident side. 1 under total internal reflection.
/// Fresnel's equations, as in Pharr, Jakob, Humphreys. Physically Based Rendering. 4th ed. 2023
float fresnelDielectric(float cosine, float eta);

/// fresnelDielectric() at normal incidence from vacuum, ((ior - 1) / (ior + 1))^2.
float dielectricF0(float ior);

/// Direction in which light continues behind a boundary, by Snell's law. `n` and `toLight` are
/// unit, point away from the boundary and lie on the same side of it; `eta` as above. 0 under total
/// internal reflection, else unit.
glm::vec3 refractedDirection(glm::vec3 n, glm::vec3 toLight, float eta);

} // namespace limn
