// SPDX-License-Identifier: MIT
#pragma once

#include "engine/math/sh.h"

#include <span>

#include <glm/vec3.hpp>

namespace limn {

/// Adds the contribution of a sample of a cache's surroundings to a link at unit radiosity:
/// transport Y_i(direction), bands^2 coefficients. This is the Monte Carlo estimate by which the
/// paper projects links. With `u` > 0 the sample stands for a cone of that 1 - cos(half-angle)
/// about `direction` (coneFactors). `direction` is unit; `transport` is solid angle / pi.
/// Jendersie, Kuri, Grosch. Real-Time Global Illumination Using Precomputed Illuminance Composition
/// with Chrominance Compression. 2016, eq. 2 and appendix A
void addHarmonics(int bands, glm::vec3 direction, float u, float transport, float* coefficients);

/// Mean irradiance of surfaces of some unit normals as a linear function of SH coefficients: sum_i
/// a_i c_i, where a_i is the mean of A_l Y_i(normal). The coefficients are of light above the plane
/// with unit normal `plane`, below which it continues (engine/math/horizon.h). The series is too
/// short to be exact for one link.
class IrradianceAxis {
public:
    static constexpr float kMaxGain = 2; ///< for the near-zero series along the surface

    /// bands in [2, kIrradianceBands]; at least one normal.
    IrradianceAxis(int bands, std::span<const glm::vec3> normals, glm::vec3 plane);

    /// Irradiance of unscaled coefficients.
    float irradiance(const float* coefficients) const;

    /// Factor by which the coefficients give that irradiance, at most kMaxGain; 1 where the series
    /// is not positive. The least change of the first three bands, instead of a factor for all,
    /// would halve the error at normals tilted by 60 degrees, but would leave light along the
    /// surface at full strength, whose ringing turns reflections black: a metal box under a lamp is
    /// 57 % too dark in 8 bands instead of 16 % (limn bench links, limn bench glossy).
    float gainTo(float irradiance, const float* coefficients) const;

private:
    int m_count;
    float m_axis[kIrradianceBands * kIrradianceBands];
};

} // namespace limn
