// SPDX-License-Identifier: MIT
#pragma once

#include "engine/math/sh.h"

#include <array>

#include <glm/vec3.hpp>

namespace limn {

/// Exponent n of the normalised lobe (n+1)/(2 pi) cos^n about the mirrored direction, for a
/// microfacet surface of this roughness in [0, 1]: 2 / alpha^2 - 2, alpha = max(roughness^2, 0.05),
/// so in [0, 798]. Karis. Specular BRDF Reference. 2013
float lobeExponent(float roughness);

/// Factors s_l w_l, l < bands, of a lobe that hardly rings in so few bands; 0 from there on.
/// w_l = exp(-t l (l+1)) is a blur over the sphere; t is the least for which the kernel, the lobe
/// cut off after `bands`, is nowhere below -1/10 of its peak. With 1/20, polished metal in 8 bands
/// is a third further from the truth than without a window (limn bench glossy). No lobe becomes
/// wider than a diffuse one, which is why 2 bands still ring; those of n >= 1 that are wide enough
/// for their bands are left as they are. Deviates from Sloan. Deringing Spherical Harmonics. 2017,
/// whose window depends on the light: this one holds for every light. n >= 0; bands in
/// [2, kMaxBands].
///
/// Error of a metal wall in a Cornell box with and without window (limn bench glossy, nRMSE against
/// path tracing, of which 0.02 is noise; links as cones and as harmonics agree to 1e-4):
///
///     bands      2          3          4          5          6          7          8
///     n = 5   .19 .14    .10 .14    .055 .057  .035 .035  .033 .033  .033 .033  .033 .033
///     n = 30  .46 .50    .46 .58    .44 .48    .41 .41    .35 .33    .23 .23    .16 .16
///     n = 100 .83 .88    .84 .96    .84 .90    .83 .83    .77 .73    .63 .58    .49 .45
std::array<float, kMaxBands> windowedLobeFactors(float n, int bands);

/// Mean radiance in the lobe cos^n about unit `d`, of radiance SH `c` (bands^2 of them); `factors`
/// are those of the lobe. Not clamped.
glm::vec3 shLobe(int bands, const glm::vec3* c, glm::vec3 d,
                 const std::array<float, kMaxBands>& factors);

/// What a reflection in the lobe cos^n loses in l bands, at [l], l in [1, kMaxBands]: the rms over
/// all directions of what the dropped bands would add, over the mean. Of light from a cap of random
/// size in the dark, whose power per coefficient falls with l^-3 as that of any light with edges.
/// The window's loss is not part of it. n in [0, 798].
std::array<float, kMaxBands + 1> lobeLosses(float n);

} // namespace limn
