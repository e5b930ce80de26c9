// SPDX-License-Identifier: MIT
#pragma once

#include "engine/runtime/vectors.h"

#include <cstddef>
#include <cstdint>

namespace limn::runtime {

/// What a bounce is made of, per surfel.
struct BouncedLight {
    F4* irradiance; ///< that came out of it [W m^-2]
    const F4 *albedo, *radiosity;
    const float *area, *seenShare;
    std::size_t surfels;
};

/// Change that a bounce would bring to what surfels send if it were repeated.
struct Residual {
    double change = 0, total = 0, relative = 0; ///< as in RoundChange
    double passedOn = 0; ///< share of a change that the next bounce passes on, the largest met
};

/// Looks ahead of bounces. A bounce is a linear map of the surfels' irradiance x to g(x), and the
/// light of all bounces is its fixed point. The latest bounces are combined, with weights of sum 1
/// in each colour, so that the same combination of their changes g(x) - x becomes as small as it
/// can; what they combine to goes into the next bounce. In a white room, where each bounce passes
/// on 97 % of the change before it, some twenty bounces do the work of three hundred. Anderson.
/// Iterative Procedures for Nonlinear Integral Equations. 1965 Walker, Ni. Anderson Acceleration
/// for Fixed-Point Iterations. 2011
class Extrapolation {
public:
    static constexpr std::uint32_t kKept = 4; ///< bounces that are combined

    /// Working space, an array per surfel each.
    F4 *change[kKept], *after[kKept];

    /// Forgets all bounces: the light that they brought has changed.
    void clear() {
        m_count = 0;
        m_passedOn = 0;
    }
    /// Takes what goes into a bounce.
    void before(const F4* irradiance, std::size_t surfels);
    /// Replaces what came out of it.
    Residual replace(const BouncedLight& light);

private:
    struct Sums;
    struct Totals;
    void take(const BouncedLight& light, std::size_t surfel, Sums& sums);
    void measurePassedOn(const double* into, const double* out, const double* light);
    void combine(const BouncedLight& light);
    std::uint32_t slot(std::uint32_t age) const { return (m_newest + kKept - age) % kKept; }

    std::uint32_t m_count = 0, m_newest = 0;
    double m_passedOn = 0;
    double m_products[kKept][kKept][3] = {}; ///< of two slots' changes, in each colour
};

} // namespace limn::runtime
