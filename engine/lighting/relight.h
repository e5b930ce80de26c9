// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/lighting_report.h"

#include <optional>
#include <utility>

namespace limn {

/// An update of light that has one bounce, all of which follows from its inputs: calls
/// `relight(now)` unless the light is of `now` already. `lit`: the inputs that it is of; none
/// before the first update, and after one in which `relight` returned false because it was
/// cancelled. Steps, counters and time of the report are the caller's matter.
template <typename Inputs, typename Relight>
LightingReport relightUnlessSame(Inputs now, std::optional<Inputs>& lit, const Relight& relight) {
    LightingReport report{.converged = true};
    report.skipped = lit == now;
    if (report.skipped)
        return report;
    lit.reset();
    if (relight(std::as_const(now))) {
        lit = std::move(now);
        report.bounces = 1;
    } else {
        report.converged = report.whole = false;
    }
    return report;
}

} // namespace limn
