// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

namespace limn::runtime {

/// Change of the light that surfels send in one bounce, summed over colours.
struct RoundChange {
    double change = 0;   ///< sum of the absolute changes of radiosity times area [W]
    double total = 0;    ///< summed radiosity times area [W]
    double relative = 0; ///< sum of each surfel's relative change times its share of what is seen

    double ofAll() const { return total > 0 ? change / total : (change > 0 ? 1 : 0); }
};

/// Relative change of what sends `now`, within [0, 1].
inline float relativeChange(float change, float now) {
    return change > 0 ? std::min(change / std::max(now, std::numeric_limits<float>::min()), 1.f)
                      : 0.f;
}

/// Decides when bounces may end; docs/transport-format.md has the rule.
class Convergence {
public:
    bool reached() const { return m_reached; }
    /// What the bounces after the latest one would change, [0, 1], by the same estimate.
    double missing() const { return m_missing; }

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
        const double due = std::max(round.ofAll(), round.relative) * toCome;
        m_missing = m_rounds < kBringing || m_unseen > 0 ? 1 : std::min(due, 1.);
        m_least = 1;
        const bool converged = due < m_tolerance;
        const bool more = passedOn > kRounding && !converged;
        m_growing = more ? m_growing + 1 : 0;
        m_grown = more ? m_grown * passedOn : 1;
        const bool grows = m_growing >= kGrowing || m_grown >= kGrown;
        m_reached = (converged && m_unseen == 0 && m_rounds >= kBringing) || grows;
        m_unseen -= m_unseen > 0;
    }

    /// A bounce that looks ahead: `residual` is what the next one would change if this one's light
    /// went into it, and `passedOn` the largest share of a change that one has passed on so far.
    /// Ends where the estimate has not become smaller for kStalled bounces.
    void addResidual(const RoundChange& residual, double passedOn) {
        constexpr double kMaxPassedOn = 0.999;
        constexpr std::uint32_t kMeasured = 3, kStalled = 30;
        ++m_rounds;
        m_before = 0; // a step after it has nothing to compare with
        const double due =
            std::max(residual.ofAll(), residual.relative) / (1 - std::min(passedOn, kMaxPassedOn));
        const bool known = m_rounds >= kMeasured && m_unseen == 0;
        m_missing = known ? std::min(due, 1.) : 1;
        m_growing = m_missing < m_least ? 0 : m_growing + 1;
        m_least = std::min(m_least, m_missing);
        m_reached = known && (due < m_tolerance || m_growing >= kStalled);
        m_unseen -= m_unseen > 0;
    }

private:
    bool m_reached = false;
    std::uint32_t m_unseen = 0, m_rounds = 0, m_growing = 0;
    double m_tolerance = 1e-4, m_missing = 1, m_least = 1;
    double m_before = 0, m_grown = 1, m_latest[4] = {};
};

} // namespace limn::runtime
