// SPDX-License-Identifier: MIT
#pragma once

#include "engine/shading/emitters.h"
#include "engine/shading/sampler.h"
#include "engine/shading/sky_light.h"
#include "engine/shading/surface_point.h"

#include <cstdint>

namespace limn {

/// Maximum number of segments of a path. Russian roulette ends paths as light is absorbed, without
/// bias; this limit ends those on which next to nothing is absorbed and nothing escapes:
/// 0.999^10000 = 5e-5.
inline constexpr std::uint32_t kMaxBounces = 10000;

/// Data that all paths of a render share.
struct PathContext {
    const TraceScene& trace;
    const Emitters& emitters;
    const SkyLight& sky;
    std::uint32_t maxBounces = kMaxBounces;
    TraceMask lampShadows =
        TraceMask::All; ///< what casts the shadows of lamps at the first surface
};

/// First of the Sampler's dimensions that paths use; callers may use those below it.
inline constexpr std::uint32_t kFirstPathDimension = 2;

/// One unbiased estimate of the irradiance [W m^-2] at `first` from bounces, emissive surfaces and
/// sky: everything but direct light from directional, point, spot and rectangle lights.
glm::vec3 sampleIndirectIrradiance(const PathContext& context, const SurfacePoint& first,
                                   const Sampler& sampler, std::uint64_t& rays);

/// One unbiased estimate of the radiance [W m^-2 sr^-1] that `p` reflects specularly to the eye,
/// from everything but direct light from directional, point, spot and rectangle lights.
/// Directions below the triangle's horizon contribute nothing.
glm::vec3 sampleReflectedRadiance(const PathContext& context, const GlossyPoint& p,
                                  const Sampler& sampler, std::uint64_t& rays);

} // namespace limn
