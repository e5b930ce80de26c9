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

/// How specularBrdf() times the cosine of the light filters light given in spherical harmonics, for
/// one viewing angle. The mean direction of the lobe lies nearer to the normal than the mirrored
/// direction; about that mean the lobe is treated as rotationally symmetric. Bands 0 and 1 are
/// exact; the others have the factors of the symmetric lobe that is nearest in the mean square. The
/// shape is that of a white metal: the Fresnel term changes how much is reflected, but hardly the
/// direction.
///
/// Error of a metal wall in the sample "cornell" against path tracing with GGX (limn bench glossy,
/// nRMSE, of which 0.02 to 0.05 is noise), and in brackets that of the lobe cos^(2/alpha^2 - 2)
/// about the mirrored direction. At roughness 0.3 the error is the panel's mirror image, blurred.
///
///     bands            3              5              8
///     roughness 0.3    2.13 (2.13)    1.89 (1.82)    1.15 (1.08)
///     roughness 0.5    0.64 (0.67)    0.33 (0.40)    0.10 (0.83)
///     roughness 0.7    0.15 (0.10)    0.07 (0.51)    0.06 (0.53)
///     roughness 0.9    0.04 (0.30)    0.07 (0.31)    0.06 (0.31)
struct ReflectionLobe {
    /// Reflected share of uniform light from all directions: F0 share.x + share.y.
    glm::vec2 share{0};
    /// Mean direction: towards.x times the normal plus towards.y times the mirrored direction. Its
    /// length is s_1.
    glm::vec2 towards{0, 1};
    std::array<float, kMaxBands> factors{}; ///< s_l about the mean direction; s_0 = 1
};

/// Lobe for roughness [0, 1] and the cosine NoV [0, 1] of the viewing angle, from a table that is
/// computed on the first call (some 0.1 s). Thread-safe.
ReflectionLobe reflectionLobe(float roughness, float NoV);

/// Unit mean direction of `lobe` for a surface with unit normal `n`.
glm::vec3 lobeAxis(const ReflectionLobe& lobe, glm::vec3 n, glm::vec3 mirrored);

/// Share of uniform light that the surface reflects to a viewer at cosine NoV in [0, 1].
glm::vec3 specularAlbedo(const Gloss& gloss, float NoV);

/// The table as the texture that shaders/shared/specular.glsl reads: kReflectionNodes^2 texels in
/// each of kReflectionLayers layers. Columns are sqrt(NoV) and rows roughness, from 0 to 1 at the
/// centres of the outer texels. Layers: (share, towards), (s_2 ... s_5), (s_6, s_7, 0, 0).
inline constexpr std::uint32_t kReflectionNodes = 32, kReflectionLayers = 3;
std::span<const glm::vec4> reflectionTable();

/// The lobe integrated over `samples` x `samples` / 2 visible normals, with factors for any number
/// of bands: s_l at [l].
struct LobeIntegral {
    glm::dvec2 share{0}, towards{0};
    std::vector<double> factors;
};
LobeIntegral integrateReflection(float roughness, float NoV, int samples, std::size_t bands);

} // namespace limn
