// SPDX-License-Identifier: MIT
#pragma once

#include "engine/math/sh.h"
#include "engine/scene/surface/specular.h"

#include <array>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace limn {

/// What specularBrdf() times the cosine of the light does to light given in spherical harmonics,
/// seen under one angle. Its directions have their mean nearer to the normal than the mirrored one;
/// about that mean it is taken as round. Bands 0 and 1 are exact, the others have the factors of
/// the round lobe that is nearest in the mean square. The shape is that of a white metal: Fresnel's
/// term changes how much is reflected, and hardly to where.
///
/// Error of a metal wall in the sample "cornell" against path tracing with GGX (limn bench glossy,
/// nRMSE, of which 0.02 to 0.05 is noise), and in brackets of the lobe cos^(2/alpha^2 - 2) about
/// the mirrored direction:
///
///     bands            3              5              8
///     roughness 0.3    2.13 (2.13)    1.89 (1.82)    1.15 (1.08)   the panel's mirror image,
///     blurred roughness 0.5    0.64 (0.67)    0.33 (0.40)    0.10 (0.83) roughness 0.7    0.15
///     (0.10)    0.07 (0.51)    0.06 (0.53) roughness 0.9    0.04 (0.30)    0.07 (0.31)    0.06
///     (0.31)
struct ReflectionLobe {
    /// Share of light from everywhere that is reflected: F0 share.x + share.y.
    glm::vec2 share{0};
    /// Mean direction: towards.x times the normal and towards.y times the mirrored direction; its
    /// length is s_1.
    glm::vec2 towards{0, 1};
    std::array<float, kMaxBands> factors{}; ///< s_l about the mean direction; s_0 = 1
};

/// Of roughness [0, 1] and the cosine NoV [0, 1] of the eye's angle, from a table that is computed
/// on the first call (some 0.1 s). Thread-safe.
ReflectionLobe reflectionLobe(float roughness, float NoV);

/// Unit mean direction of `lobe` about a surface of unit normal `n`.
glm::vec3 lobeAxis(const ReflectionLobe& lobe, glm::vec3 n, glm::vec3 mirrored);

/// Share of light from everywhere that the surface reflects to an eye of cosine NoV in [0, 1].
glm::vec3 specularAlbedo(const Gloss& gloss, float NoV);

/// The table as a texture of shaders/shared/specular.glsl: kReflectionNodes^2 texels in each of
/// kReflectionLayers layers; columns are sqrt(NoV), rows roughness, from 0 to 1 at the centres of
/// the outer texels. Layers: (share, towards), (s_2 ... s_5), (s_6, s_7, 0, 0).
inline constexpr std::uint32_t kReflectionNodes = 32, kReflectionLayers = 3;
std::span<const glm::vec4> reflectionTable();

/// The lobe as `samples` x `samples` / 2 visible normals have it, with factors of any number of
/// bands: s_l at [l].
struct LobeIntegral {
    glm::dvec2 share{0}, towards{0};
    std::vector<double> factors;
};
LobeIntegral integrateReflection(float roughness, float NoV, int samples, std::size_t bands);

} // namespace limn
