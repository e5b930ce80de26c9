// SPDX-License-Identifier: MIT
#pragma once

#include "engine/math/sh.h"

#include <array>
#include <span>

#include <glm/vec3.hpp>

namespace limn {

/// Windowed factors s_l w_l, l < bands, of a lobe with factors `s`, so that it hardly rings when
/// cut off after `bands`; 0 from there on. w_l = exp(-t l (l+1)) is a blur over the sphere. t is
/// the smallest value for which the kernel of a mirror, cut off after `bands`, is nowhere below
/// -1/10 of its peak, minus the blur of the lobe itself, estimated from its last band. With 1/20,
/// the error of polished metal in 8 bands is a third larger than without a window (limn bench
/// glossy). Lobes wide enough for their bands are unchanged. No cosine lobe becomes wider than a
/// diffuse one, which is why 2 bands still ring. Deviates from Sloan. Deringing Spherical
/// Harmonics. 2017, whose window depends on the light: this one holds for every light. s[0] = 1;
/// bands in [2, kMaxBands].
std::array<float, kMaxBands> windowedFactors(const std::array<float, kMaxBands>& s, int bands);

/// Mean radiance in a rotationally symmetric lobe about unit `d`. `c` are the bands^2 SH
/// coefficients of the radiance and `factors` those of the lobe. Not clamped.
glm::vec3 shLobe(int bands, const glm::vec3* c, glm::vec3 d,
                 const std::array<float, kMaxBands>& factors);

/// Response of a symmetric lobe with these factors, in `bands` bands, to light that is 1 over a
/// hemisphere and 0 below it; `cosine` is that of the angle between the axes of the lobe and the
/// hemisphere. Dividing the lobe's light by it compensates for the part of the lobe below the
/// horizon. The result is at least 1/2, the value of a narrow lobe along the horizon: lobes turned
/// further away are not compensated.
float hemisphereSeen(const std::array<float, kMaxBands>& factors, int bands, float cosine);

/// Loss of a reflection in a lobe with factors `s` if only l bands are used, at [l], l in [1,
/// kMaxBands]: the rms over all directions of the contribution of the dropped bands, divided by the
/// mean. The light is a cap of random size in the dark, whose power per coefficient falls with l^-3
/// like that of any light with edges. The loss by the window is not included, nor are bands that
/// `s` does not have.
std::array<float, kMaxBands + 1> lobeLosses(std::span<const double> s);

} // namespace limn
