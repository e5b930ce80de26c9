// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/bake/bake.h"
#include "engine/techniques/illuminance/relight/caches/light_links.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace limn {

/// What a round did to the light that surfels send, all colours.
struct RoundChange {
    double change = 0;   ///< summed radiosity times area that each sends more or less [W]
    double total = 0;    ///< summed radiosity times area [W]
    double relative = 0; ///< relativeChange() of each, summed times its seenShares()

    double ofAll() const { return total > 0 ? change / total : (change > 0 ? 1 : 0); }
};

/// Of a surfel that sends b, and did |b - d| or b + d before; 1 where it sends nothing any more.
inline float relativeChange(float d, float b) {
    return d > 0 ? std::min(d / std::max(b, std::numeric_limits<float>::min()), 1.f) : 0.f;
}

/// Per surfel, how much of all that caches see it is; 1 in all, with the sky.
std::vector<float> seenShares(const ClusterTree& tree);

/// When bounces may end, on whichever device they run.
class Convergence {
public:
    /// Bounces have converged when one, and all that would follow it, change both the total
    /// radiosity of all surfels, and each surfel's own in the mean over what caches see, by less
    /// than this share. With the total alone, a sunlit ground of 200 m hid the bounces in the house
    /// on it, and its walls came out up to a fourth too dark. With this bounce alone, a closed room
    /// of albedo 0.99 missed 1 %: each one that follows passes on nearly as much.
    static constexpr double kChange = 1e-4;

    bool reached() const { return m_reached; }

    /// Share of the change by one round that the next one hands on; 0: not known yet. As surfaces
    /// reflect less than they receive and receive no more than is sent, it is below 1.
    double passedOn() const { return m_passedOn; }

    /// Rounds end, too, where the sum of all surfels' light grew in kGrowing of them, one after the
    /// other, or kGrown times in all of these. It may grow for a few rounds although no surfel gets
    /// more than the brightest one sends: by chance, rays meet some surfels more often than their
    /// area deserves.
    static constexpr std::uint32_t kGrowing = 12;
    static constexpr double kGrown = 1e6;
    bool grows() const { return m_growing >= kGrowing || m_grown >= kGrown; }

    void lightChanged() {
        m_reached = false;
        m_rounds = m_growing = 0;
        m_grown = 1;
        m_passedOn = 0;
        m_latest = {};
    }
    /// A changed sky, or links that are dimmed otherwise, change no surfel before the caches have
    /// seen it: it reaches them in the first round, and the surfels' radiosity in the second.
    void skyChanged() {
        lightChanged();
        m_unseenRounds = 2;
    }
    void addRound(RoundChange round) {
        // Two rounds bring what has changed; each one after them reflects the one before.
        const bool reflects = ++m_rounds > kBringing && m_before > 0;
        m_passedOn = reflects ? round.change / m_before : 0;
        m_before = round.change;
        m_latest[m_rounds % m_latest.size()] = m_passedOn;
        const double toCome = following();
        const bool converged =
            round.ofAll() * toCome < kChange && round.relative * toCome < kChange;
        const bool more = m_passedOn > kRounding && !converged;
        m_growing = more ? m_growing + 1 : 0;
        m_grown = more ? m_grown * m_passedOn : 1;
        m_reached = (converged && m_unseenRounds == 0 && m_rounds >= kBringing) || grows();
        m_unseenRounds -= m_unseenRounds > 0;
    }

private:
    static constexpr std::uint32_t kBringing = 2;
    static constexpr double kRounding = 1.001;

    /// This change and all that it would lead to, by the sum of the geometric series, over this
    /// change alone where that is more. By the most that one of the latest rounds passed on: where
    /// changes are no more than a hundred roundings, shares scatter by some per cent, and in a
    /// white room the first one that came out low would end bounces 0.03 % to 0.1 % too early.
    double following() const {
        constexpr double kMaxPassedOn = 0.999; // noise, rounding
        const double q = std::min(std::ranges::max(m_latest), kMaxPassedOn);
        return std::max(q / (1 - q), 1.);
    }

    bool m_reached = false;
    std::uint32_t m_unseenRounds = 0, m_rounds = 0, m_growing = 0;
    double m_before = 0, m_passedOn = 0, m_grown = 1;
    std::array<double, 4> m_latest{}; ///< passed on by the latest rounds
};

/// The bands that receivers see at last, where `lit` of the bake's are lit.
inline LightBands finalBands(const BakeSettings& settings, int lit) {
    return {lit, std::min(int(chromaBandsOf(settings)), lit)};
}

/// The bands that surfels read. A surface gets half of its irradiance from the second one: without
/// its colour every bounce would grey the light.
inline LightBands bounceBands(const BakeSettings& settings, int lit) {
    const LightBands last = finalBands(settings, lit);
    return {last.luma, std::max(last.chroma, 2)};
}

} // namespace limn
