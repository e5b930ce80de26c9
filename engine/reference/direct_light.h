// SPDX-License-Identifier: MIT
#pragma once

#include "engine/reference/surface_point.h"

#include <cstdint>

namespace limn {

/// Shadow rays of directIrradiance() to a rectangle, the same points on it from everywhere.
inline constexpr std::uint32_t kRectanglePoints = 64;

/// Irradiance of all directional, point, spot and rectangle lights [W m^-2]. Shadows of the first
/// three are hard. Adds the shadow rays to `rays`.
glm::vec3 directIrradiance(const TraceScene& trace, const SurfacePoint& p, std::uint64_t& rays);

/// What reaches a point straight from one light.
struct DirectSample {
    glm::vec3 irradiance{0}; ///< [W m^-2]
    glm::vec3 toLight{0};    ///< unit, where the irradiance is not 0
};

/// The same as directIrradiance() from one light, picked by its unshadowed share with `pick` in
/// [0, 1): unbiased, one ray. `onLight` in [0, 1)^2 is its end on a rectangle, uniform in area.
DirectSample sampleDirectLight(const TraceScene& trace, const SurfacePoint& p, float pick,
                               glm::vec2 onLight, std::uint64_t& rays);

} // namespace limn
