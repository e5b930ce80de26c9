// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/convergence.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// What bounces work with, an entry per surfel.
struct BouncingSurfels {
    std::span<const glm::vec3> albedo;
    std::span<const glm::vec4> radiosity; ///< [W m^-2]; nodes of the tree follow
    std::span<const float> area;          ///< [m^2]
    std::span<const float> seenShare;     ///< seenShares()
};

/// Looks ahead of bounces while the light that makes them stands still. A bounce maps the surfels'
/// irradiance x to g(x), and the light of all bounces is the fixed point of that map, which is
/// linear but for what is kept from being negative. The latest bounces are combined, with weights
/// of sum 1 in each colour, so that the same combination of their changes g(x) - x becomes as small
/// as possible; the next bounce starts from what they combine to. Results are the same for any
/// number of threads. Anderson. Iterative Procedures for Nonlinear Integral Equations. 1965;
/// Walker, Ni. Anderson Acceleration for Fixed-Point Iterations. 2011
class BounceExtrapolation {
public:
    static constexpr std::uint32_t kKept = 4;   ///< bounces that are combined
    static constexpr std::uint32_t kPlain = 20; ///< bounces before there is something to gain

    /// Forgets all bounces: the light that they brought has changed.
    void clear();
    /// Frees the memory as well.
    void release();

    /// Takes the irradiance [W m^-2] with which a bounce begins.
    void begin(std::span<const glm::vec3> irradiance);

    /// Takes the irradiance that came out of it and replaces it. Does nothing without begin().
    void end(const BouncingSurfels& surfels, std::span<glm::vec3> irradiance);

    /// What another bounce would change, had the latest one not been replaced, and the maximum
    /// share of a change that a bounce has been seen to pass on. None before two bounces, and
    /// where a bounce passes on all of a change or more: there is no fixed point to look for, and
    /// nothing is replaced.
    struct Residual {
        RoundChange change;
        double passedOn = 0;
    };
    const std::optional<Residual>& residual() const { return m_residual; }
    /// Counts a bounce that changed surfels by `round`: by residual(), where there is one.
    void addRound(const RoundChange& round, Convergence& convergence) const;

    std::uint64_t bytes() const;

private:
    static constexpr std::uint32_t kUnknowns = kKept - 1;
    using PerSurfel = std::vector<glm::vec3>;
    using Factors = std::array<glm::vec3, kUnknowns>; ///< of older bounces

    std::uint32_t slot(std::uint32_t age) const { return (m_newest + kKept - age) % kKept; }
    RoundChange takeChange(const BouncingSurfels& surfels, std::span<const glm::vec3> irradiance);
    double sharePassedOn(const BouncingSurfels& surfels) const;
    void multiplyNewest(const BouncingSurfels& surfels);
    Factors bestFactors() const;
    void combine(const Factors& factors, std::span<glm::vec3> irradiance) const;

    std::array<PerSurfel, kKept> m_change, m_after;
    /// Sums over surfels of the products of two slots' changes.
    std::array<std::array<glm::dvec3, kKept>, kKept> m_products{};
    std::uint32_t m_count = 0, m_newest = 0;
    bool m_begun = false, m_grows = false;
    double m_passedOn = 0;
    std::optional<Residual> m_residual;
};

} // namespace limn
