// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/technique.h"

#include <array>
#include <cstdint>

namespace limn {

/// How light from virtual area lights is shadowed.
enum class ConeShadows : std::uint8_t { None, Directional, Published };

/// Settings of radiance volumes, in the order of VolumeSettings.
extern const std::array<TechniqueSetting, 16> kVolumeSettings;

/// The settings' values. Those that must be powers of two are.
struct VolumeSettings {
    std::uint32_t read = 0, map = 0, bands = 0, cascades = 0, nodes = 0, caches = 0;
    float transition = 0;
    std::uint32_t level = 0;
    ConeShadows shadow = ConeShadows::None;
    std::uint32_t voxels = 0;
    float rate = 0; ///< change of a voxel's opacity in an update, in [0, 1]; 0: at once
    bool glossy = false, microfacet = false; ///< maps for reflections; GlossyMapShape::microfacet
    std::uint32_t tile = 0, fill = 0;
    bool freeze = false;
    bool clamp = false; ///< irradiance of each cache, not of their mean
    bool operator==(const VolumeSettings&) const = default;
};

VolumeSettings volumeSettingsOf(const TechniqueChoice& choice);

} // namespace limn
