// SPDX-License-Identifier: MIT
#pragma once

#include "engine/picture/light_guide.h"
#include "engine/shading/incident_light.h"
#include "engine/shading/sampler.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>

namespace limn {

/// What emits light without being one of Scene::lights: emissive surfaces and the sky.
struct EmittedLightSources {
    Emitters emitters;
    SkyLight sky;       ///< of its image
    bool shine = false; ///< whether there is any
};
EmittedLightSources findEmittedLightSources(const TraceScene& trace);

/// One sample of the light that arrives at a surface from these without a bounce.
struct EmittedLightSample {
    /// Samples by three strategies: of a point on an emitter, of a direction of the sky's image,
    /// and of the ray below. Each is weighted by the balance heuristic, so that their sum is an
    /// unbiased estimate of the irradiance.
    std::array<IncidentLightSample, 3> samples;

    glm::vec3 direction{0};            ///< of a ray from the surface, unit
    float weight = 0;                  ///< cosine over the ray's density [sr]; 0: there is no ray
    Hit hit;                           ///< of the ray
    std::optional<SurfacePoint> point; ///< there; none also where the hit is black
};

/// Uses `sampler`'s pairs 0 to 3. `guide`: aims some of the rays, if there is one; they follow the
/// cosine otherwise. Combined as in Veach, Guibas. Optimally Combining Sampling Techniques for
/// Monte Carlo Rendering. 1995
EmittedLightSample sampleEmittedLight(const TraceScene& trace, const EmittedLightSources& sources,
                                      const SurfacePoint& p, const Sampler& sampler,
                                      const LightGuide* guide = nullptr);

} // namespace limn
