// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

#include <cstdint>

#include <glm/vec3.hpp>

namespace limn {

/// The glossy side of a surface point: reflectance at normal incidence and roughness [0, 1].
struct Gloss {
    glm::vec3 F0{0.04f};
    float roughness = 1;
};

/// At barycentrics (u, v) of `triangle`: F0 = 0.04 of dielectrics, base colour of metals.
Gloss surfaceGloss(const Scene& scene, const Instance& instance, std::uint32_t triangle, float u,
                   float v);

/// Share of light from everywhere that the lobe reflects to a direction of cosine NoV in [0, 1].
/// Karis. Physically Based Shading on Mobile. 2014. Its fit is of another visibility term: of rough
/// white metals it is up to 0.17 below the integral of specularBrdf().
glm::vec3 specularAlbedo(const Gloss& gloss, float NoV);

/// Cook-Torrance with GGX, without the cosine of the light [sr^-1]. All directions unit, away from
/// the surface. Walter et al. Microfacet Models for Refraction through Rough Surfaces. 2007; the
/// visibility term is Hammon's approximation of the height-correlated Smith term. alpha >= 0.002.
glm::vec3 specularBrdf(const Gloss& gloss, glm::vec3 n, glm::vec3 toEye, glm::vec3 toLight);

} // namespace limn
