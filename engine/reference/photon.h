// SPDX-License-Identifier: MIT
#pragma once

#include "engine/reference/light_source.h"
#include "engine/shading/surface_point.h"

#include <cstdint>
#include <vector>

namespace limn {

/// Maximum number of mirrorings and refractions of a photon without a diffuse reflection between
/// them. Only light that is caught in glass without loss has more.
inline constexpr std::uint32_t kMaxSpecular = 64;

/// A photon as it arrives at a surface.
struct PhotonHit {
    SurfacePoint surface;
    glm::vec3 power{0};   ///< [W]; the mean over photons is the flux on a surface
    glm::vec3 toLight{0}; ///< unit, the way it came from
    /// Diffuse reflections before this one, and one more for light of emitters and the sky: the
    /// segments that a path of the path tracer needs to find this light.
    std::uint32_t bounces = 0;
    bool isCaustic = false; ///< it was mirrored or refracted since its last diffuse reflection

    /// Ratio of the light's cosines about the shading normal and the geometric one, >= 0: the
    /// factor from power to what a surface receives by its shading normal. Veach. Robust Monte
    /// Carlo Methods for Light Transport. 1997, section 5.3
    float shadingRatio() const;
    /// Whether it comes straight from a light, which the reference counts as direct light.
    bool isDirect() const { return bounces == 0 && !isCaustic; }
};

/// Traces photon number sampler.index from a source of light, and appends to `hits` its arrivals
/// at diffuse surfaces, black ones too, after at most `maxBounces` of PhotonHit::bounces. Surfaces
/// reflect by surfaceMaterial()'s albedo, the metallic part of them by surfaceMetal(), as a mirror
/// below kSmoothRoughness and by sampleSpecular() above; transmissive ones by splitAtBoundary().
/// Interpolated normals turn mirrored and refracted light, and what they send to the wrong side of
/// the triangle is absorbed. Russian roulette selects one of these ways on, or absorption, in
/// proportion to the power. Adds the number of rays to `rays`.
void tracePhoton(const TraceScene& trace, const LightSources& sources, std::uint32_t maxBounces,
                 const Sampler& sampler, std::vector<PhotonHit>& hits, std::uint64_t& rays);

} // namespace limn
