// SPDX-License-Identifier: MIT
#pragma once

#include "engine/relight/light_links.h"

#include <algorithm>
#include <cstdint>

namespace limn {

/// When bounces may end, on whichever device they run.
class Convergence {
public:
    /// Of the total radiosity, by one bounce.
    static constexpr double kChange = 1e-4;

    bool reached() const { return m_reached; }

    void lightChanged() { m_reached = false; }
    /// A changed sky, or links that are dimmed otherwise, change no surfel before the caches have
    /// seen it: it reaches them in the first round, and the surfels' radiosity in the second.
    void skyChanged() {
        m_reached = false;
        m_unseenRounds = 2;
    }
    /// After each round: by how much it changed the total radiosity, over that total.
    void addRound(double change) {
        m_reached = change < kChange && m_unseenRounds == 0;
        m_unseenRounds -= m_unseenRounds > 0;
    }

private:
    bool m_reached = false;
    std::uint32_t m_unseenRounds = 0;
};

/// So few bounces, or fewer, are taken as they are asked for (BakeSettings::maxBounces): whenever
/// something changes they begin from no bounced light at all. More go on from the light that was.
inline constexpr std::uint32_t kFewBounces = 8;

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
