// SPDX-License-Identifier: MIT
#pragma once

#include "engine/shading/surface_point.h"

#include <cstdint>

namespace limn {

/// Number of shadow rays of directIrradiance() to a rectangle. All receivers use the same points on
/// it.
inline constexpr std::uint32_t kRectanglePoints = 64;

/// Irradiance from all directional, point, spot and rectangle lights [W m^-2]. Shadows of the first
/// three are hard. Adds the number of shadow rays to `rays`.
glm::vec3 directIrradiance(const TraceScene& trace, const SurfacePoint& p, std::uint64_t& rays);

/// Adds the radiance of the same lights [W m^-2 sr^-1] as spherical harmonics to `c`, bands^2 of
/// them, as in sh.h: the sum over directions of light times Y_i. Only light from above the surface
/// counts. Irradiance evaluated from them is that of light limited to these bands. Bands in [1,
/// kMaxBands].
void addDirectHarmonics(const TraceScene& trace, const SurfacePoint& p, int bands, glm::vec3* c,
                        std::uint64_t& rays);

/// Direct light at a point from one light.
struct DirectSample {
    glm::vec3 irradiance{0}; ///< [W m^-2]
    glm::vec3 toLight{0};    ///< unit, if the irradiance is not 0
};

/// Unbiased estimate of what one light adds to directIrradiance(), with one shadow ray: exact but
/// for rectangles. `onLight` in [0, 1)^2 selects the ray's end on a rectangle, uniform in solid
/// angle.
DirectSample sampleDirectLightFrom(const TraceScene& trace, const SurfacePoint& p,
                                   const Light& light, glm::vec2 onLight, std::uint64_t& rays);

/// Unbiased estimate of directIrradiance() with one shadow ray. `pick` in [0, 1) selects a light in
/// proportion to its unshadowed contribution. `onLight` is that of sampleDirectLightFrom(). `mask`:
/// what casts shadows.
DirectSample sampleDirectLight(const TraceScene& trace, const SurfacePoint& p, float pick,
                               glm::vec2 onLight, std::uint64_t& rays,
                               TraceMask mask = TraceMask::All);

} // namespace limn
