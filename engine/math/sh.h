// SPDX-License-Identifier: MIT
#pragma once

#include <array>

#include <glm/vec3.hpp>

namespace limn {

/// Real, orthonormal spherical harmonics without Condon-Shortley sign: coefficient (l, m) has index
/// l(l+1)+m. "bands" counts l = 0 … bands-1, so there are bands^2 coefficients.
inline constexpr int kMaxBands = 8;
inline constexpr int kMaxCoefficients = kMaxBands * kMaxBands;

/// Writes bands^2 values Y_i(d) to `y`. `d` unit; bands in [1, kMaxBands].
void shBasis(int bands, glm::vec3 d, float* y);

/// Factor s_l of a normalised cosine lobe (n+1)/(2 pi) cos^n: the lobe integral of radiance SH L
/// about d is sum_l s_l sum_m L_lm Y_lm(d). s_0 = 1, s_1 = (n+1)/(n+2), s_l = s_{l-2}
/// (n+2-l)/(n+l+1). n > 0.
std::array<float, kMaxBands> lobeFactors(float n);

/// Irradiance factors A_l = pi s_l(1): pi, 2pi/3, pi/4, 0, -pi/24, 0, pi/64, 0.
/// Ramamoorthi and Hanrahan. An Efficient Representation for Irradiance Environment Maps. 2001
std::array<float, kMaxBands> irradianceFactors();

/// Number of bands from which irradiance is evaluated everywhere: in pictures, for surfels, and
/// when links are fitted. Further bands are for glossy lobes.
inline constexpr int kIrradianceBands = 3;

/// E(n) [W m^-2] of radiance coefficients `c` (bands^2 of them). Not clamped: ringing may make it
/// slightly negative.
glm::vec3 shIrradiance(int bands, const glm::vec3* c, glm::vec3 n);

} // namespace limn
