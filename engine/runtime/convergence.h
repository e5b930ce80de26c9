// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>

namespace limn::runtime {

/// Change of the light that surfels send in one bounce, summed over colours.
struct RoundChange {
    double change = 0;   ///< sum of the absolute changes of radiosity times area [W]
    double total = 0;    ///< summed radiosity times area [W]
    double relative = 0; ///< sum of each surfel's relative change times its share of what is seen

    double ofAll() const { return total > 0 ? change / total : (change > 0 ? 1 : 0); }
};

/// Decides when bounces may end; docs/transport-format.md has the rule.
class Convergence {
public:
    bool reached() const { return m_reached; }

    /// `skyChanged`: the change reaches the surfels' radiosity only in the second bounce.
    void lightChanged(bool skyChanged) {
        const std::uint32_t unseen = skyChanged ? 2 : m_unseen;
        const double tolerance = m_tolerance;
        *this = {};
        m_unseen = unseen;
        m_tolerance = tolerance;
    }
    /// Change that converged light may still be due, relative to all of it.
    void setTolerance(double tolerance) {
        m_reached = m_reached && tolerance >= m_tolerance;
        m_tolerance = tolerance;
    }
    void addRound(const RoundChange& round) {
        constexpr double kMaxPassedOn = 0.999, kRounding = 1.001, kGrown = 1e6;
        constexpr std::uint32_t kBringing = 2, kGrowing = 12;
        const bool reflects = ++m_rounds > kBringing && m_before > 0;
        const double passedOn = reflects ? round.change / m_before : 0;
        m_before = round.change;
        m_latest[m_rounds % 4] = passedOn;
        const double q = std::min(*std::max_element(m_latest, m_latest + 4), kMaxPassedOn);
        const double toCome = std::max(q / (1 - q), 1.);
        const bool converged =
            round.ofAll() * toCome < m_tolerance && round.relative * toCome < m_tolerance;
        const bool more = passedOn > kRounding && !converged;
        m_growing = more ? m_growing + 1 : 0;
        m_grown = more ? m_grown * passedOn : 1;
        const bool grows = m_growing >= kGrowing || m_grown >= kGrown;
        m_reached = (converged && m_unseen == 0 && m_rounds >= kBringing) || grows;
        m_unseen -= m_unseen > 0;
    }

private:
    bool m_reached = false;
    std::uint32_t m_unseen = 0, m_rounds = 0, m_growing = 0;
    double m_tolerance = 1e-4;
    double m_before = 0, m_grown = 1, m_latest[4] = {};
};

} // namespace limn::runtime
