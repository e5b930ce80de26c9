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

/// Sets the steps of a report, and the counters that the CPU and a device have in common. Null:
/// there are none.
void describeVolume(const CacheAllocation* caches, const VoxelVolume* voxels,
                    const VolumeCost& cost, LightingReport& report);

/// The same with the counters of the CPU. `lit` may be empty before the first update.
void describeVolume(const LitVolume& lit, const VolumeCost& cost, LightingReport& report);

} // namespace limn
