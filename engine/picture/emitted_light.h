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
    SkyLight sky;     ///< importance sampling of the sky's image
    bool any = false; ///< whether any of them emits light
};
EmittedLightSources findEmittedLightSources(const TraceScene& trace);

/// One sample of the light that arrives at a surface from these without a bounce.
struct EmittedLightSample {
    /// Samples by three strategies: of a point on an emitter, of a direction of the sky's image,
    /// and of the ray below. Each is weighted by the balance heuristic, so that their sum is an
    /// unbiased estimate of the irradiance.
    std::array<IncidentLightSample, 3> samples;

    glm::vec3 direction{0};            ///< direction of a ray from the surface, unit
    float weight = 0;                  ///< cosine over the ray's density [sr]; 0: there is no ray
    Hit hit;                           ///< what the ray hits
    std::optional<SurfacePoint> point; ///< surface point there; none where the hit is black
};

/// Samples the light that is emitted to point `p`, with `sampler`'s pairs 0 to 3. The ray's
/// direction has a density in proportion to the cosine; if there is a `guide`, it samples a part of
/// the directions instead. The strategies are combined by multiple importance sampling.
/// Veach, Guibas. Optimally Combining Sampling Techniques for Monte Carlo Rendering. 1995
EmittedLightSample sampleEmittedLight(const TraceScene& trace, const EmittedLightSources& sources,
                                      const SurfacePoint& p, const Sampler& sampler,
                                      const LightGuide* guide = nullptr);

} // namespace limn
