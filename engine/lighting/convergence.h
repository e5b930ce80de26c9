// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/relight_settings.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

namespace limn {

/// Change of the light that surfaces send in one round, summed over colours.
struct RoundChange {
    double change = 0;   ///< sum of the absolute changes of radiosity times area [W]
    double total = 0;    ///< summed radiosity times area [W]
    double relative = 0; ///< sum of each sample's relativeChange() times its share of
                         ///< what receivers see, a mean

    void operator+=(const RoundChange& other) {
        change += other.change;
        total += other.total;
        relative += other.relative;
    }
    double ofAll() const { return total > 0 ? change / total : (change > 0 ? 1 : 0); }
};

/// Relative change of a surfel that sends b now and sent |b - d| or b + d before; 1 where it no
/// longer sends anything.
inline float relativeChange(float d, float b) {
    return d > 0 ? std::min(d / std::max(b, std::numeric_limits<float>::min()), 1.f) : 0.f;
}

/// Decides when bounces may end, on any device.
class Convergence {
public:
    /// Bounces have converged when the latest one and all that would follow it change less than
    /// RelightSettings::tolerance of both the total radiosity of all surfels and each surfel's own,
    /// averaged over what caches see. With the total alone, a sunlit ground of 200 m hid the
    /// bounces in the house on it, and its walls came out up to a fourth too dark. With the latest
    /// bounce alone, a closed room of albedo 0.99 missed 1 %, because each later one passes on
    /// nearly as much.
    bool reached() const { return m_reached; }

    /// Share of one round's change that the next round passes on; 0: not known yet. It is below 1,
    /// because surfaces reflect less than they receive and receive no more than is sent.
    double passedOn() const { return m_passedOn; }

    /// Rounds also end where the sum of all surfels' light grew in kGrowing consecutive rounds, or
    /// by a factor of kGrown over consecutive rounds. It may grow for a few rounds although no
    /// surfel receives more than the brightest one sends, because rays meet some surfels by chance
    /// more often than in proportion to their area.
    static constexpr std::uint32_t kGrowing = 12;
    static constexpr double kGrown = 1e6;
    bool grows() const { return m_growing >= kGrowing || m_grown >= kGrown; }

    /// Applies the settings on which the end of bounces depends. Returns whether they changed,
    /// which counts as a change of light.
    bool applySettings(const RelightSettings& settings) {
        const bool same = m_settings.maxBounces == settings.maxBounces &&
                          m_settings.tolerance == settings.tolerance;
        m_settings = settings;
        if (!same)
            lightChanged();
        return !same;
    }
    /// Those last applied.
    const RelightSettings& settings() const { return m_settings; }
    /// Whether every change restarts from zero bounced light.
    bool restarts() const { return m_settings.maxBounces <= kFewBounces; }

    void lightChanged() {
        m_reached = false;
        m_rounds = m_growing = 0;
        m_grown = 1;
        m_passedOn = 0;
        m_latest = {};
        m_excess = 0;
    }
    /// Call this where the sky or the occlusion of links has changed. Such a change reaches the
    /// caches in the first round and the surfels' radiosity only in the second.
    void skyChanged() {
        lightChanged();
        m_unseenRounds = 2;
    }
    /// The rounds since the light changed.
    std::uint32_t rounds() const { return m_rounds; }
    /// The rounds that are still needed if each passes on as little as any of the latest ones; at
    /// least 1.
    std::uint32_t expectedRounds() const;
    /// Rounds that bring what has changed; each one after them reflects the one before.
    static constexpr std::uint32_t kBringing = 2;

    /// `uncertain`: a round has been seen to pass on all of a change, so that only a change of next
    /// to nothing ends rounds.
    void addRound(RoundChange round, bool uncertain = false);

    /// The same for a round after an extrapolation. `residual`: the change that another round
    /// would have brought without it. `passedOn`: the largest share of a change that a round has
    /// passed on, below 1. This share is not capped as in addRound(), because extrapolated light
    /// may change by no more than roundings from round to round while it is still far from its
    /// limit.
    void addResidual(RoundChange residual, double passedOn);

private:
    /// Whether a change and all that follow it, `toCome` times it, are tolerated.
    bool isReached(const RoundChange& round, double toCome);

    RelightSettings m_settings;
    bool m_reached = false;
    std::uint32_t m_unseenRounds = 0, m_rounds = 0, m_growing = 0;
    double m_before = 0, m_passedOn = 0, m_grown = 1;
    double m_excess = 0; ///< change to come after the latest round, relative to what is tolerated
    std::array<double, 4> m_latest{}; ///< shares passed on by the latest rounds
};

} // namespace limn
