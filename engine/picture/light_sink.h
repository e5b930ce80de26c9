// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/sample_field.h"
#include "engine/picture/emitted_light.h"
#include "engine/picture/field_lobe.h"
#include "engine/picture/gather_tile.h"
#include "engine/shading/direct_light.h"

#include <concepts>
#include <cstdint>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// Random numbers of one sample of direct light, for sampleDirectLight().
struct LightNumbers {
    float pick = 0;       ///< selects the light, in [0, 1)
    glm::vec2 onLight{0}; ///< selects the point on it, in [0, 1)^2
};

inline glm::vec3 irradianceOf(const DirectSample& sample) {
    return sample.irradiance;
}

// The light of a pixel is a sum of terms, each of which is linear in the light of lights, emissive
// surfaces, the sky or a field. A walk finds the terms (pixel_walk.h, final_gather_walk.h) and
// hands each of them to a sink. A ValueSink adds them up, which draws the picture; a ReadingSink
// splits them by where their light comes from, which explains it.

/// What both kinds of walk need of a sink.
template <class Sink>
concept LightSink = requires(Sink& sink, const FieldPoint& point, glm::vec3 weight, GatherPart part,
                             std::uint32_t instance) {
    /// Whether an instance reflects light diffusely; if not, its albedo is taken to be 0.
    { sink.reflects(instance) } -> std::convertible_to<bool>;
    /// Weight times the field's irradiance at a point.
    sink.fieldIrradiance(point, weight, part);
};

/// What walkPixel() needs of a sink.
template <class Sink>
concept PixelSink = LightSink<Sink> &&
    requires(Sink& sink, const SurfacePoint& surface, const FieldPoint& point,
             const LightNumbers& numbers, const FieldLobe& lobe, const FieldPart& part,
             const FieldReflection& reflection, glm::vec3 light, std::uint32_t instance,
             void (*body)()) {
    /// A pixel shows a surface of this instance.
    sink.meets(instance);
    /// The factor times the terms that body() hands over.
    sink.scaled(light, body);
    /// Radiance of the sky where a pixel shows no surface, and of the surface that it shows.
    sink.background(light);
    sink.emission(light);
    /// What a function of direct light at a point returns, such as irradianceOf().
    sink.directLight(surface, numbers, irradianceOf);
    /// Direct irradiance at a point of a near surface, which is `instance`.
    sink.nearDirectLight(surface, numbers, instance);
    /// Weight times the field's radiance at a point, from a direction.
    sink.fieldRadiance(point, light, light);
    /// Specular reflection of the field's harmonics, and of its part that reflects().
    sink.fieldLobe(point, lobe);
    sink.fieldReflection(part, reflection);
};

/// What FinalGather::walk() needs of a sink. `via`: the instance that a ray from the pixel met
/// first.
template <class Sink>
concept GatherSink = LightSink<Sink> &&
    requires(Sink& sink, const SurfacePoint& surface, const LightNumbers& numbers,
             const EmittedLightSample& ray, const IncidentLightSample& sample, glm::vec3 light,
             GatherPart part, std::uint32_t via) {
    /// A ray from the pixel brings all light that is handed over between these two calls.
    sink.rayBegins(ray);
    sink.rayEnds();
    /// Weight times direct irradiance at a point that a ray met, part Bounced.
    sink.gatheredDirectLight(surface, numbers, light, via);
    /// Light from the sky or an emissive surface.
    sink.gatheredEmission(sample, light, part, via);
};

} // namespace limn
