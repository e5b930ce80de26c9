// SPDX-License-Identifier: MIT
#pragma once

#include "engine/reference/surface_point.h"

#include <cstdint>

namespace limn {

/// Irradiance of all directional, point and spot lights, with hard shadows [W m^-2].
/// Adds the shadow rays to `rays`.
glm::vec3 directIrradiance(const TraceScene& trace, const SurfacePoint& p, std::uint64_t& rays);

/// The same from one light, picked by its unshadowed share with `u` in [0, 1): unbiased, one ray.
glm::vec3 sampleDirectIrradiance(const TraceScene& trace, const SurfacePoint& p, float u,
                                 std::uint64_t& rays);

} // namespace limn
