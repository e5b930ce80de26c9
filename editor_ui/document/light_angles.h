// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/light/light.h"

namespace limn {

/// Whether Light::direction matters: a point shines the same to all sides unless it has a profile.
inline bool hasDirection(const Light& light) {
    return light.kind != LightKind::Point || light.profile;
}

/// Where a light comes from.
struct LightAngles {
    float elevation = 0; ///< height above the horizon [degrees], [-90, 90]
    float azimuth = 0;   ///< compass direction, from +Z towards +X [degrees], [-180, 180]
};

/// Largest elevation that lightDirection() gives: beyond it an azimuth would be lost [degrees].
inline constexpr float kMaxElevation = 89.9f;

/// Unit vector along which the light of a new sun travels: from 53 degrees above the horizon.
inline constexpr glm::vec3 kNewSunDirection{-0.48f, -0.8f, -0.36f};

/// Angles of a light that travels along the unit vector `direction`. The azimuth of a light from
/// the zenith or the nadir is 0.
LightAngles lightAngles(glm::vec3 direction);

/// Unit vector along which the light travels. The elevation is kept within +-kMaxElevation.
glm::vec3 lightDirection(LightAngles angles);

} // namespace limn
