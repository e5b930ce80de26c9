// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/lighting_report.h"
#include "engine/techniques/light_skin/skin_objects.h"

#include <cstdint>

namespace limn {

/// Sets the steps and counters of an update on the CPU or a device. `bytes`: of all that it reads
/// and writes.
void describeSkin(const SkinObjects& objects, std::uint64_t bytes, const SkinCost& cost,
                  LightingReport& report);

} // namespace limn
