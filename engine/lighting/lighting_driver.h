// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/lighting.h"

#include <functional>
#include <memory>

namespace limn {

/// Decides when bounced light is updated, by how many bounces, where, and when it is done; for
/// whatever technique and on whatever device. While light changes, what the view shows is lit; once
/// it has converged, the rest. So light that has converged is right everywhere, and before that
/// what comes into view is right with the next update.
class LightingDriver {
public:
    /// Lights nothing yet where `lighting` is null.
    explicit LightingDriver(std::unique_ptr<Lighting> lighting = nullptr);

    /// Lights, materials, sky or objects changed: bounces are counted from 0 again.
    void lightChanged();

    /// Nothing is left to do until lightChanged().
    bool done() const { return !m_lighting || (m_converged && m_whole); }
    bool converged() const { return m_converged; }
    std::uint32_t bounces() const { return m_bounces; } ///< since lightChanged()

    /// Light is everywhere, perhaps older where no view has been since. Until then updates take no
    /// heed of the view, so that there is light wherever somebody looks next.
    bool everWhole() const { return m_everWhole; }

    /// What step() may be told to do.
    enum class Rest : std::uint8_t {
        All,  ///< light what the view did not show
        Seen, ///< only what has come into view
        Later ///< leave it
    };

    /// One update: a few bounces, or, where they have converged, what is left by `rest`. Of
    /// `input`, bounces are set here. Precondition: there is a Lighting. Returns null where nothing
    /// was to be done, and after a rest, whose report tells nothing of bounces.
    const LightingReport* step(LightingInput input, Rest rest, const Progress& progress = {});

    Lighting* lighting() const { return m_lighting.get(); }

private:
    std::unique_ptr<Lighting> m_lighting;
    LightingReport m_report;
    std::uint32_t m_bounces = 0;
    bool m_converged = false, m_whole = false, m_everWhole = false;
};

/// Bounces between two looks at what the user did meanwhile: 2, or a few that are all.
std::uint32_t bouncesPerUpdate(std::uint32_t maxBounces);

} // namespace limn
