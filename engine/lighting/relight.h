// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/lighting_report.h"

#include <cstdint>
#include <optional>
#include <utility>

namespace limn {

/// How far an update has come.
enum class Relit : std::uint8_t {
    Cancelled, ///< the next update starts anew
    InPart,    ///< there is light, which further updates with the same inputs complete
    Whole
};

/// An update of light that has one bounce, all of which follows from its inputs: calls
/// `relight(now)`, which returns a Relit, unless the light is of `now` already, as a whole. `lit`:
/// the inputs that it is of; none before the first update and after one that was cancelled.
/// `inPart`: whether the last update came no further than that. Steps, counters and time of the
/// report are the caller's matter.
template <typename Inputs, typename Relight>
LightingReport relightUnlessSame(Inputs now, std::optional<Inputs>& lit, bool inPart,
                                 const Relight& relight) {
    LightingReport report{.converged = true};
    report.skipped = lit == now && !inPart;
    if (report.skipped)
        return report;
    lit.reset();
    const Relit relit = relight(std::as_const(now));
    report.converged = relit == Relit::Whole;
    report.whole = relit != Relit::Cancelled;
    // Light in part is replaced, whatever number of bounces suffices.
    report.bounces = report.converged ? 1 : 0;
    if (report.whole)
        lit = std::move(now);
    return report;
}

} // namespace limn
