// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/lighting_report.h"
#include "engine/techniques/radiance_volumes/lit_volume.h"
#include "engine/techniques/radiance_volumes/volume_sources.h"

#include <cstdint>

namespace limn {

/// What an update took.
struct VolumeCost : VolumeSourceCost {
    double lightMs = 0;
    std::uint64_t cones = 0;
};

/// Sets steps and counters of a report. `lit` may be empty before the first update.
void describeVolume(const LitVolume& lit, const VolumeCost& cost, LightingReport& report);

} // namespace limn
