// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/lighting_report.h"
#include "engine/techniques/illuminance/relight/relight.h"

namespace limn {

/// What relight() counted, as every technique reports it.
LightingReport reportOf(const RelightStats& stats);

} // namespace limn
