// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"
#include "engine/techniques/radiance_volumes/volume_settings.h"
#include "engine/techniques/radiance_volumes/voxels.h"

#include <memory>
#include <optional>

namespace limn {

/// `shown` with the opacity of each voxel moved towards that of `target` by at most `rate`, in
/// (0, 1], rounded to a whole number of 255ths that is not 0. None where all voxels arrive, or
/// where the two differ in their lattices. `target` has no VoxelVolume::opacity.
std::optional<VoxelVolume> nearTarget(const VoxelVolume& shown, const VoxelVolume& target,
                                      float rate);

/// The voxels that cones meet. Those of a changed scene fade in and out over several updates, by
/// VolumeSettings::rate in each, so that shadows do not pop: after the program of Reich. Realtime
/// Global Illumination using Dynamic Radiance Volumes. 2015. The first ones appear at once.
class ShownVoxels {
public:
    /// Surfaces, or the number of voxels, have changed.
    void outdate() { m_outdated = true; }
    /// Shows none, and the next ones at once.
    void reset() { m_shown = m_target = nullptr; }

    /// Brings the voxels up to date with the scene, or nearer to that by a step. Returns whether
    /// they changed. There are none where nothing casts a shadow.
    bool follow(const Scene& scene, const VolumeSettings& settings);

    /// Null: none.
    const std::shared_ptr<const VoxelVolume>& shown() const { return m_shown; }
    /// Whether further steps are to follow.
    bool fading() const { return m_shown != m_target; }

private:
    std::shared_ptr<const VoxelVolume> m_shown, m_target;
    bool m_outdated = true;
};

} // namespace limn
