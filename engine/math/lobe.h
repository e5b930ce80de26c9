// SPDX-License-Identifier: MIT
#pragma once

#include "engine/math/sh.h"

#include <array>
#include <span>

#include <glm/vec3.hpp>

namespace limn {

/// Factors s_l w_l, l < bands, of a lobe of factors `s` that hardly rings in so few bands; 0 from
/// there on. w_l = exp(-t l (l+1)) is a blur over the sphere; t is the least for which the kernel
/// of a mirror, cut off after `bands`, is nowhere below -1/10 of its peak, less the blur that the
/// lobe has of its own, judged by its last band. With 1/20, polished metal in 8 bands is a third
/// further from the truth than without a window (limn bench glossy). Lobes that are wide enough for
/// their bands are left as they are. No cosine lobe becomes wider than a diffuse one, which is why
/// 2 bands still ring. Deviates from Sloan. Deringing Spherical Harmonics. 2017, whose window
/// depends on the light: this one holds for every light. s[0] = 1; bands in [2, kMaxBands].
std::array<float, kMaxBands> windowedFactors(const std::array<float, kMaxBands>& s, int bands);

/// Mean radiance in a round lobe about unit `d`, of radiance SH `c` (bands^2 of them); `factors`
/// are those of the lobe. Not clamped.
glm::vec3 shLobe(int bands, const glm::vec3* c, glm::vec3 d,
                 const std::array<float, kMaxBands>& factors);

/// What a round lobe of these factors sees of light that is 1 over a hemisphere and 0 below it, in
/// so many bands; `cosine` is that of the angle between the lobe's axis and the hemisphere's. A
/// lobe's light over it is what the lobe would see were none of it below the horizon. At least 1/2,
/// which a narrow lobe along the horizon sees: one turned further away is not made up for.
float hemisphereSeen(const std::array<float, kMaxBands>& factors, int bands, float cosine);

/// What a reflection in a round lobe of factors `s` loses in l bands, at [l], l in [1, kMaxBands]:
/// the rms over all directions of what the dropped bands would add, over the mean. Of light from a
/// cap of random size in the dark, whose power per coefficient falls with l^-3 as that of any light
/// with edges. The window's loss is not part of it, nor are bands that `s` does not have.
std::array<float, kMaxBands + 1> lobeLosses(std::span<const double> s);

} // namespace limn
