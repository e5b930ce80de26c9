// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/lighting/lighting.h"
#include "engine/rsm/rsm_inputs.h"
#include "engine/techniques/radiance_volumes/allocation.h"
#include "engine/techniques/radiance_volumes/area_lights.h"
#include "engine/techniques/radiance_volumes/cache_light.h"
#include "engine/techniques/radiance_volumes/shown_voxels.h"
#include "engine/techniques/radiance_volumes/volume_settings.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace limn {

/// Everything that the light of a scene depends on.
struct VolumeInputs {
    RsmSurfaces surfaces;
    VolumeSettings settings;
    std::vector<RsmSource> sources;
    std::optional<Viewpoint> view; ///< none: everything is lit
    bool operator==(const VolumeInputs&) const = default;
};

/// The inputs of an update. With VolumeSettings::freeze, the view is that of the update `before`.
VolumeInputs volumeInputsOf(const LightingInput& input, const std::optional<VolumeInputs>& before);

/// What is out of date once inputs have changed.
struct VolumeChanges {
    bool maps = true, voxels = true, caches = true;
};
VolumeChanges changesOf(const std::optional<VolumeInputs>& before, const VolumeInputs& now);

/// What following the inputs took.
struct VolumeSourceCost {
    double mapMs = 0, voxelMs = 0, allocationMs = 0;
    std::uint64_t mapRays = 0, traced = 0; ///< of shadow maps; lights whose map was cast
    std::uint64_t viewRays = 0;            ///< that placed caches
};

/// What lights caches and where they are, kept from one update to the next.
class VolumeSources {
public:
    /// Those of the last follow().
    const std::optional<VolumeInputs>& inputs() const { return m_before; }

    /// Brings area lights, voxels and places of caches up to date with `now`, the inputs of
    /// `scene`. Returns false if cancelled; what was finished by then is kept.
    bool follow(const TraceScene& trace, const Scene& scene, const VolumeInputs& now,
                const Progress& progress, VolumeSourceCost& cost);

    const CacheAllocation& caches() const { return *m_caches; }
    std::shared_ptr<const CacheAllocation> sharedCaches() const { return m_caches; }
    /// Null where nothing casts a shadow.
    std::shared_ptr<const VoxelVolume> sharedVoxels() const { return m_voxels.shown(); }
    /// Whether voxels fade: the next follow() changes them, although no input has changed.
    bool fading() const { return m_voxels.fading(); }

    /// The area lights of each source, in their order. Precondition: follow() returned true.
    std::vector<std::shared_ptr<const AreaLights>>
    areaLights(const std::vector<RsmSource>& sources) const;

private:
    bool followLights(const TraceScene& trace, const Scene& scene, const VolumeInputs& now,
                      const Progress& progress, VolumeSourceCost& cost);

    std::optional<VolumeInputs> m_before;                    ///< of the last follow()
    std::vector<std::shared_ptr<const AreaLights>> m_lights; ///< each shape once
    ShownVoxels m_voxels;
    std::shared_ptr<const CacheAllocation> m_caches = std::make_shared<const CacheAllocation>();
    bool m_cachesCurrent = false;
};

} // namespace limn
