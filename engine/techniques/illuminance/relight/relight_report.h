// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/lighting_report.h"
#include "engine/techniques/illuminance/relight/relight.h"

namespace limn {

/// The counters of relight() in the form that every technique reports.
LightingReport reportOf(const RelightStats& stats);

} // namespace limn
