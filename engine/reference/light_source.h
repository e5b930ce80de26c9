// SPDX-License-Identifier: MIT
#pragma once

#include "engine/shading/emitters.h"
#include "engine/shading/sampler.h"
#include "engine/shading/sky_light.h"

#include <cstdint>
#include <vector>

namespace limn {

/// All that sends light into a scene, for paths that begin there: lights, emissive triangles and
/// the sky, each selected with a probability proportional to about its power.
struct LightSources {
    std::vector<double> cdf; ///< of Scene::lights, then of all emitters, then of the sky; ends at 1
    Emitters emitters;
    SkyLight sky;

    bool empty() const { return cdf.empty(); } ///< nothing shines
};
LightSources findLightSources(const TraceScene& trace);

/// The beginning of a path of light.
struct Emission {
    Ray ray;
    glm::vec3 power{0};     ///< [W] over the density of what was sampled; 0: the path ends here
    std::int32_t lamp = -1; ///< index into Scene::lights if powerAt() must weigh it, else -1
    bool isLamp = false;    ///< from one of Scene::lights; otherwise from an emitter or the sky
};

/// Number of dimensions of `sampler` that sampleEmission() uses, from 0.
inline constexpr std::uint32_t kEmissionDimensions = 3;

/// Samples a ray that leaves a source: a sun's and the sky's towards the scene's bounds from
/// outside of them, points on rectangles and emitters uniform in area and their directions by the
/// cosine. The mean of `power` over the rays through a surface is the flux on it [W]. `sources` is
/// not empty.
Emission sampleEmission(const TraceScene& trace, const LightSources& sources,
                        const Sampler& sampler);

/// Power of an emission where its ray first ends, at world point `p`: point and spot lights fade
/// with their range and in their cone as sampleLight() says.
glm::vec3 powerAt(const Scene& scene, const Emission& emission, glm::vec3 p);

} // namespace limn
