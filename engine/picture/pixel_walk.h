// SPDX-License-Identifier: MIT
#pragma once

#include "engine/picture/field_lobe.h"
#include "engine/picture/field_render.h"
#include "engine/picture/light_sink.h"
#include "engine/picture/near_light.h"
#include "engine/picture/pixel_sample.h"
#include "engine/shading/passed_ray.h"
#include "engine/shading/surface_point.h"

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/gtc/constants.hpp>

namespace limn {

/// The quantity that the terms of a pixel add up to. Diffuse radiance is what the surfaces reflect
/// diffusely to the eye.
enum class PixelSum : std::uint8_t {
    Radiance,          ///< that reaches the eye [W m^-2 sr^-1]
    DirectDiffuse,     ///< diffuse radiance, of direct light [W m^-2 sr^-1]
    BouncedDiffuse,    ///< diffuse radiance, of the field's light [W m^-2 sr^-1]
    BouncedIrradiance, ///< at the surfaces, of the field's light [W m^-2]
    Irradiance         ///< at the surfaces, of both [W m^-2]
};

/// The input of walks over a picture's pixels. All that it refers to outlives it.
struct PixelWalk {
    const TraceScene& trace;
    const IndirectField& field;
    const LightmapLayout& layout;
    PixelSum sum = PixelSum::Radiance;
    bool windowedLobes = true;
    std::vector<int> bands;                ///< number that each material reflects
    const FieldPart* reflecting = nullptr; ///< of the field, for glossy receivers
    std::vector<bool> glossy;              ///< where there is one: the materials of these
    NearLight near;
    bool gathers = false; ///< the field's diffuse light is left to FinalGather, but behind glass

    FieldPoint lookup(const Hit& hit, const SurfacePoint& p) const {
        return fieldPoint(field, layout, trace.scene(), hit, p);
    }
};
PixelWalk pixelWalk(const TraceScene& trace, const IndirectField& field,
                    const LightmapLayout& layout, const FieldRenderOptions& options, PixelSum sum,
                    bool gathers);

/// Walks the irradiance from the field and from near surfaces at a point.
template <PixelSink Sink>
void walkBounced(const PixelWalk& w, const PixelSample& sample, const Hit& hit,
                 const SurfacePoint& p, Sink& sink) {
    if (w.field.empty() || (w.gathers && sample.crossings == 0))
        return;
    sink.fieldIrradiance(w.lookup(hit, p), glm::vec3(1), GatherPart::Shown);
    sink.scaled(glm::vec3(1), [&] { walkNearLight(w.near, hit, p, sample.near, sink); });
}

/// Walks the specular reflection of the field's light.
template <PixelSink Sink>
void walkReflection(const PixelWalk& w, const Hit& hit, const GlossyPoint& g, Sink& sink) {
    if (w.field.empty())
        return;
    const std::uint32_t material = w.trace.scene().instances[hit.instance].material;
    if (w.reflecting && w.glossy[material]) {
        sink.fieldReflection(*w.reflecting, fieldReflection(w.trace, g));
        return;
    }
    const FieldPoint point = w.lookup(hit, g.surface);
    sink.fieldLobe(point, fieldLobe(point, g, w.bands[material], w.windowedLobes));
}

/// Walks the radiance that a point sends to the eye.
template <PixelSink Sink>
void walkRadiance(const PixelWalk& w, const PixelSample& sample, const Hit& hit, SurfacePoint p,
                  Sink& sink) {
    if (!sink.reflects(hit.instance))
        p.albedo = glm::vec3(0);
    const GlossyPoint g = glossyPoint(w.trace, hit, sample.ray, p);
    sink.emission(p.emission);
    sink.directLight(p, sample.light,
                     [&](const DirectSample& d) { return g.reflect(d.irradiance, d.toLight); });
    sink.scaled(p.albedo / glm::pi<float>(), [&] { walkBounced(w, sample, hit, p, sink); });
    walkReflection(w, hit, g, sink);
}

/// Walks the radiance that reaches the eye along the sample's ray, and through transmissive
/// surfaces.
template <PixelSink Sink>
void walkSight(const PixelWalk& w, const PixelSample& sample, Sink& sink) {
    const Hit hit = w.trace.closestHit(sample.ray, TraceMask::Seen);
    if (!hit) {
        sink.background(skyRadiance(w.trace.scene().sky, sample.ray.direction));
        return;
    }
    const bool within = isWithinBody(w.trace.scene(), hit);
    if (const std::optional<SurfacePoint> p = surfacePoint(w.trace, hit); p && !within) {
        sink.meets(hit.instance);
        walkRadiance(w, sample, hit, *p, sink);
    }
    if (sample.crossings == kMaxCrossings)
        return;
    const PassedRay passed =
        passRay(w.trace, hit, sample.ray, sample.passing.pair(2 * sample.crossings).x,
                sample.passing.pair(2 * sample.crossings + 1));
    if (passed.weight != glm::vec3(0))
        sink.scaled(passed.weight, [&] { walkSight(w, sample.behind(passed.ray), sink); });
}

/// Walks the light that one sample of a pixel shows: hands each of its terms to a sink
/// (light_sink.h). The sum of the terms is an unbiased estimate of `w.sum`, but for the diffuse
/// light that is gathered. Only radiance is seen through transmissive surfaces.
template <PixelSink Sink>
void walkPixel(const PixelWalk& w, const PixelSample& sample, Sink& sink) {
    if (w.sum == PixelSum::Radiance) {
        walkSight(w, sample, sink);
        return;
    }
    const Hit hit = w.trace.closestHit(sample.ray, TraceMask::Seen);
    const std::optional<SurfacePoint> p = hit ? surfacePoint(w.trace, hit) : std::nullopt;
    if (!p)
        return;
    sink.meets(hit.instance);
    const auto direct = [&] { sink.directLight(*p, sample.light, irradianceOf); };
    const auto bounced = [&] { walkBounced(w, sample, hit, *p, sink); };
    const glm::vec3 reflectance = p->albedo / glm::pi<float>();
    switch (w.sum) {
    case PixelSum::Radiance: // walkSight()
        break;
    case PixelSum::DirectDiffuse:
        sink.scaled(reflectance, direct);
        break;
    case PixelSum::BouncedDiffuse:
        sink.scaled(reflectance, bounced);
        break;
    case PixelSum::BouncedIrradiance:
        bounced();
        break;
    case PixelSum::Irradiance:
        direct();
        bounced();
        break;
    }
}

} // namespace limn
