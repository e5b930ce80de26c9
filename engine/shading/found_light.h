// SPDX-License-Identifier: MIT
#pragma once

#include "engine/shading/emitters.h"
#include "engine/shading/sky_light.h"
#include "engine/shading/surface_point.h"

#include <cstdint>

namespace limn {

/// Light that was found at a surface by sampling an emitter or the sky, not by a bounce.
struct FoundLight {
    glm::vec3 irradiance{0};      ///< [W m^-2], over its density; 0: none arrives
    glm::vec3 toLight{0};         ///< unit, where some arrives
    float pdf = 1;                ///< [sr^-1]
    std::uint32_t instance = ~0U; ///< that emits it; ~0: the sky
};

/// Samples one point on an emitter with a shadow ray, which is added to `rays`.
FoundLight emitterLightAt(const TraceScene& trace, const Emitters& emitters, const SurfacePoint& p,
                          float pick, glm::vec2 u, std::uint64_t& rays);

/// Samples one direction of the sky's image likewise; finds nothing where `sky` is empty.
FoundLight skyLightAt(const TraceScene& trace, const SkyLight& sky, const SurfacePoint& p,
                      glm::vec2 u, std::uint64_t& rays);

} // namespace limn
