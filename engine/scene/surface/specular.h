// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

#include <cstdint>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// Glossy reflection at a surface point: reflectance at normal incidence and roughness [0, 1].
struct Gloss {
    glm::vec3 F0{0.04f};
    float roughness = 1;
};

/// Gloss at barycentrics (u, v) of `triangle`: F0 is dielectricF0() of the index of refraction for
/// dielectrics, 0.04 by default, and the base colour for metals.
Gloss surfaceGloss(const Scene& scene, const Instance& instance, std::uint32_t triangle, float u,
                   float v);

/// Cook-Torrance BRDF with GGX, without the cosine of the light [sr^-1]. All directions are unit
/// and point away from the surface. Walter et al. Microfacet Models for Refraction through Rough
/// Surfaces. 2007; the visibility term is Hammon's approximation of the height-correlated Smith
/// term. alpha >= 0.002; NoV >= 1e-4.
glm::vec3 specularBrdf(const Gloss& gloss, glm::vec3 n, glm::vec3 toEye, glm::vec3 toLight);

/// A sampled direction towards the light.
struct SpecularSample {
    glm::vec3 toLight{0}; ///< unit, above the horizon of `n`; 0 where the facet reflects below it
    glm::vec3 weight{0};  ///< specularBrdf() times the cosine over specularPdf()
};

/// Samples the microfacet normals visible to the eye, from `u` in [0, 1)^2. The mean of weight
/// times radiance is the reflected radiance. An eye below the horizon of `n` is treated as just
/// above it.
/// Heitz. Sampling the GGX Distribution of Visible Normals. 2018
SpecularSample sampleSpecular(const Gloss& gloss, glm::vec3 n, glm::vec3 toEye, glm::vec2 u);

/// The unit normal of a microfacet that is visible from direction `toEye`, as sampleSpecular()
/// selects it.
glm::vec3 sampleFacet(float roughness, glm::vec3 n, glm::vec3 toEye, glm::vec2 u);

/// Share of light that leaves a facet visible at cosine NoV in a direction at cosine NoL to the
/// normal, on either side, and is masked by no other facet; in [0, 1], 0 for NoL <= 0.
float facetShare(float roughness, float NoV, float NoL);

/// Probability density of sampleSpecular() [sr^-1]. It integrates to less than 1, because some
/// facets reflect below the horizon.
float specularPdf(float roughness, glm::vec3 n, glm::vec3 toEye, glm::vec3 toLight);

} // namespace limn
