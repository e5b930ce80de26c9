// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/lighting_report.h"
#include "engine/techniques/light_skin/skin_state.h"

namespace limn {

/// Sets the steps and counters of an update that the state followed.
void describeSkin(const SkinState& state, const SkinCost& cost, LightingReport& report);

} // namespace limn
