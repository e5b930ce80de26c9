// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/lighting.h"

#include <memory>
#include <optional>

namespace limn {

/// Decides when and where bounced light is updated, by how many bounces, and when it is done, for
/// any technique and device. While light changes, only what the view shows is updated; once it has
/// converged, the rest follows. Converged light is therefore correct everywhere; before that,
/// whatever comes into view is correct after the next update.
class LightingDriver {
public:
    /// If `lighting` is null, there is no light yet.
    explicit LightingDriver(std::unique_ptr<Lighting> lighting = nullptr);

    /// Lights, materials, sky or objects have changed: bounces are counted from 0 again.
    void lightChanged();

    /// Tells which view the next step is to light, before done() is asked. Where the light is of a
    /// view (Lighting::isOfView()), another one counts as a change.
    void viewIs(const Viewpoint& view);

    /// Whether nothing is left to do until lightChanged(), or until the view changes.
    bool done() const { return !m_lighting || (m_converged && m_whole); }
    bool converged() const { return m_converged; }
    std::uint32_t bounces() const { return m_bounces; } ///< since lightChanged()

    /// What step() does once the bounces have converged.
    enum class Rest : std::uint8_t {
        All,  ///< light what the view did not show
        Seen, ///< only what has come into view
        Later ///< do nothing
    };

    /// Performs one update: a few bounces, or, once they have converged, the rest as `rest` says.
    /// Overwrites input.bounces. Ignores the view until there is light everywhere, so that there is
    /// some wherever the user looks next. Light of a view has no rest, and its view always counts.
    /// Returns std::nullopt if there was nothing to do, and after updating the rest, whose report
    /// contains no bounces.
    std::optional<LightingReport> step(LightingInput input, Rest rest,
                                       const Progress& progress = {});

    /// Whether done() and there may be something for solveSources() to do.
    bool canSolve() const { return m_lighting && done() && m_unsolved; }

    /// Calls Lighting::solveSources() for the light of `input`, which is done().
    void solveSources(const LightingInput& input, const Progress& progress = {});

    Lighting* lighting() const { return m_lighting.get(); }

private:
    std::unique_ptr<Lighting> m_lighting;
    std::uint32_t m_bounces = 0;
    std::optional<Viewpoint> m_view; ///< where the light is of a view
    bool m_converged = false, m_whole = false, m_everWhole = false;
    bool m_unsolved = true;
};

/// Number of bounces between two checks of user input: 2, or all of them if there are few.
std::uint32_t bouncesPerUpdate(std::uint32_t maxBounces);

} // namespace limn
