// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/field_reading.h"
#include "engine/lighting/explanation.h"
#include "engine/rsm/rsm_inputs.h"
#include "engine/techniques/radiance_volumes/volume_part.h"
#include "engine/techniques/radiance_volumes/volume_settings.h"
#include "engine/techniques/radiance_volumes/voxels.h"

#include <memory>
#include <span>
#include <vector>

namespace limn {

/// Lit caches and what lit them. Copies share their data.
struct LitVolume {
    VolumeSettings settings;
    std::shared_ptr<const VolumePart> part;
    std::shared_ptr<const VoxelVolume> voxels; ///< null: nothing casts a shadow
    std::vector<RsmSource> sources;
    std::vector<std::shared_ptr<const AreaLights>> lights; ///< of each source

    std::vector<LitAreaLights> coloured() const;
    /// What caches are lit from. `coloured` must outlive it.
    CacheLightInput input(std::span<const LitAreaLights> coloured) const;
};

/// Says where the light of a reading of `part`, the first part of its field, comes from: by light,
/// and by the objects to which the area lights belong. Lighting::explain().
Explanation explainVolume(const LitVolume& lit, const Scene& scene, const FieldReading& reading,
                          const ExplainOptions& options);

} // namespace limn
