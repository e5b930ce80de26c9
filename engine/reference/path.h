// SPDX-License-Identifier: MIT
#pragma once

#include "engine/reference/emitters.h"
#include "engine/reference/sampler.h"
#include "engine/reference/sky_light.h"
#include "engine/reference/surface_point.h"

#include <cstdint>

namespace limn {

/// Paths end by chance, as light is absorbed, so that nothing is lost. Where next to nothing is
/// absorbed and nothing escapes, this many segments end them all the same: 0.999^10000 = 5e-5.
inline constexpr std::uint32_t kMaxBounces = 10000;

/// What all paths of a render share.
struct PathContext {
    const TraceScene& trace;
    const Emitters& emitters;
    const SkyLight& sky;
    std::uint32_t maxBounces = kMaxBounces;
};

/// Dimensions of the Sampler that a caller may use itself; paths take those from here on.
inline constexpr std::uint32_t kFirstPathDimension = 2;

/// Dimension of the points on lights that the first surface of a path is lit from; those after it
/// take the next ones.
inline constexpr std::uint32_t kOnLightDimension = 1u << 16;

/// One unbiased estimate of the irradiance that reaches `first` by any way but straight from
/// directional, point, spot and rectangle lights [W m^-2]: bounces, emissive surfaces, sky.
glm::vec3 sampleIndirectIrradiance(const PathContext& context, const SurfacePoint& first,
                                   const Sampler& sampler, std::uint64_t& rays);

/// One unbiased estimate of the radiance [W m^-2 sr^-1] that the glossy side of `p` reflects to the
/// eye, of all light but what comes straight from directional, point, spot and rectangle lights.
/// From below the triangle's horizon comes none.
glm::vec3 sampleReflectedRadiance(const PathContext& context, const GlossyPoint& p,
                                  const Sampler& sampler, std::uint64_t& rays);

} // namespace limn
