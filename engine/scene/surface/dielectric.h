// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// How a surface point passes light on. Of what its boundary does not reflect, `tint` goes through;
/// the rest is scattered or absorbed. Which side is the front does not matter to a thin sheet; a
/// body lies behind it.
struct Transmission {
    glm::vec3 tint{0};   ///< base colour * (1 - metallic) * transmission; each in [0, 1]
    float share = 0;     ///< (1 - metallic) * transmission
    float ior = 1.5f;    ///< of the body behind the surface, against vacuum; >= 1
    bool isThin = true;  ///< a sheet, which light crosses without bending
    float roughness = 1; ///< [0, 1]

    explicit operator bool() const { return tint != glm::vec3(0); }
};

/// Below this roughness, a surface that mirrors or transmits light is taken to be smooth.
inline constexpr float kSmoothRoughness = 0.05f;

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

/// The index of refraction, >= 1, of which dielectricF0() is `reflectance`, which is limited to
/// [0, 0.99].
float iorOfF0(float reflectance);

/// Direction in which light continues behind a boundary, by Snell's law. `n` and `toLight` are
/// unit, point away from the boundary and lie on the same side of it; `eta` as above. 0 under total
/// internal reflection, else unit.
glm::vec3 refractedDirection(glm::vec3 n, glm::vec3 toLight, float eta);

/// The two ways on for light that meets a transmissive surface, for one microfacet of it.
struct BoundarySplit {
    float reflectance = 0;    ///< fresnelDielectric() at the facet; the rest is refracted
    glm::vec3 mirrored{0};    ///< unit, on the side of the incident light; 0: into the surface
    glm::vec3 refracted{0};   ///< unit, on the other side; 0: there is none
    float mirroredShare = 1;  ///< what other facets do not mask of it
    float refractedShare = 1; ///< likewise
};

/// Splits light that arrives from direction `toLight` at a surface with unit normal `n` on the same
/// side; `inside`: from within the body, where the surface is not a thin sheet. `u` in [0, 1)^2
/// selects the facet of a rough surface. A rough sheet scatters what it transmits as it scatters
/// what it reflects, only to the other side. Walter et al. Microfacet Models for Refraction through
/// Rough Surfaces. 2007
BoundarySplit splitAtBoundary(const Transmission& transmission, glm::vec3 n, glm::vec3 toLight,
                              bool inside, glm::vec2 u);

} // namespace limn
