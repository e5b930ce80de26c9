// SPDX-License-Identifier: MIT
#pragma once

#include "engine/shading/emitters.h"
#include "engine/shading/sky_light.h"
#include "engine/shading/surface_point.h"

#include <cstdint>

namespace limn {

/// A Monte Carlo estimate of the light that arrives at a surface from an emitter or the sky. The
/// functions below sample it by light sampling (next-event estimation), not by a ray that follows
/// the surface's reflection.
struct IncidentLightSample {
    glm::vec3 irradiance{0};      ///< estimate, divided by the density [W m^-2]; 0: none arrives
    glm::vec3 toLight{0};         ///< direction, unit, where some arrives
    float pdf = 1;                ///< density of the direction [sr^-1]
    std::uint32_t instance = ~0U; ///< instance that emits it; ~0: the sky
};

/// Samples one point on an emitter and traces a shadow ray, which is added to `rays`.
IncidentLightSample sampleEmitterLight(const TraceScene& trace, const Emitters& emitters,
                                       const SurfacePoint& p, float pick, glm::vec2 u,
                                       std::uint64_t& rays);

/// Samples one direction of the sky's image likewise. The estimate is 0 where `sky` is empty.
IncidentLightSample sampleSkyLight(const TraceScene& trace, const SkyLight& sky,
                                   const SurfacePoint& p, glm::vec2 u, std::uint64_t& rays);

} // namespace limn
