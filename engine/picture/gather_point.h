// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lightmap/layout/lightmap_layout.h"
#include "engine/picture/emitted_light.h"
#include "engine/picture/field_lobe.h"
#include "engine/picture/gather_tile.h"
#include "engine/picture/light_sink.h"
#include "engine/trace/trace_scene.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <glm/gtc/constants.hpp>

namespace limn {

/// What final gathering at a surface point reads (final_gather.h).
struct GatherScene {
    const TraceScene& trace;
    const IndirectField& field;   ///< all bounced light
    const IndirectField& emitted; ///< its part that arrives without a bounce
    const LightmapLayout& layout; ///< of both fields
    EmittedLightSources sources;
    std::vector<float> widths;   ///< per instance, twice the nearReaches() [m]
    std::uint32_t raysPerSample; ///< rays of one sample of a point, > 0
};
GatherScene gatherScene(const TraceScene& trace, const IndirectField& field,
                        const IndirectField& emitted, const LightmapLayout& layout,
                        std::uint32_t raysPerSample);

/// Minimum distance of a surface at which the field is read, in widths of its texels. Where a ray
/// meets a nearer one, a path continues it, because light from so near varies too much for texels.
inline constexpr float kMinTexels = 4;

/// Limits of such a path, as in a gap between surfaces: the field is read all the same where the
/// product of the albedos after the first hit's is below kMinReflected, and at the last of
/// kMaxGatherBounces.
inline constexpr float kMinReflected = 0.03f;
inline constexpr std::uint32_t kMaxGatherBounces = 64;

/// Weights of the parts of a sample's light.
using PartWeights = std::array<glm::vec3, kGatherParts>;

/// Hands the bounced light that a ray brings to a sink. `met`: what the ray met.
template <GatherSink Sink>
void walkGatheredBounces(const GatherScene& in, EmittedLightSample met, const Sampler& sampler,
                         glm::vec3 weight, Sink& sink) {
    const std::uint32_t via = met.hit.instance;
    const Scene& scene = in.trace.scene();
    float reflected = 1;
    for (std::uint32_t bounce = 1; met.point && sink.reflects(met.hit.instance); ++bounce) {
        const glm::vec3 albedo = met.point->albedo;
        weight *= albedo / glm::pi<float>();
        reflected *= bounce > 1 ? std::max({albedo.x, albedo.y, albedo.z}) : 1;
        const Sampler light{mixBits(sampler.seed, kOnLightDimension + bounce), sampler.index};
        sink.gatheredDirectLight(*met.point, {light.pair(0).x, light.pair(1)}, weight, via);
        if (reflected < kMinReflected || bounce == kMaxGatherBounces ||
            !(met.hit.t < kMinTexels * in.widths[met.hit.instance])) {
            sink.fieldIrradiance(fieldPoint(in.field, in.layout, scene, met.hit, *met.point),
                                 weight, Bounced);
            return;
        }
        met = sampleEmittedLight(in.trace, in.sources, *met.point,
                                 {mixBits(sampler.seed, bounce), sampler.index});
        for (const IncidentLightSample& f : met.samples)
            if (f.irradiance != glm::vec3(0))
                sink.gatheredEmission(f, weight * f.irradiance, Bounced, via);
        weight *= met.weight;
    }
}

/// Hands the terms of sample `index` of surface point `p` to a sink: irradiance that the field
/// shows there, and the differences of irradiance between gathered light and the field's, each part
/// times its weight. The numbers of its rays are those of `seed` from index * raysPerSample on.
/// `guide` samples directions; null: they are sampled in proportion to the cosine.
template <GatherSink Sink>
void walkGatheredPoint(const GatherScene& in, const Hit& hit, const SurfacePoint& p,
                       std::uint32_t seed, std::uint32_t index, const LightGuide* guide,
                       const PartWeights& weights, Sink& sink) {
    const Scene& scene = in.trace.scene();
    const FieldPoint here = fieldPoint(in.field, in.layout, scene, hit, p),
                     emittedHere = fieldPoint(in.emitted, in.layout, scene, hit, p);
    if (weights[Shown] != glm::vec3(0))
        sink.fieldIrradiance(here, weights[Shown], Shown);
    sink.fieldIrradiance(emittedHere, -weights[Emitted], Emitted);
    sink.fieldIrradiance(emittedHere, weights[Bounced], Bounced);
    sink.fieldIrradiance(here, -weights[Bounced], Bounced);
    const std::uint32_t rays = in.raysPerSample;
    for (std::uint32_t k = 0; k < rays; ++k) {
        const Sampler sampler{seed, index * rays + k};
        const EmittedLightSample light =
            sampleEmittedLight(in.trace, in.sources, p, sampler, guide);
        const auto arrives = [&](const IncidentLightSample& f) {
            if (f.irradiance != glm::vec3(0))
                sink.gatheredEmission(f, weights[Emitted] / float(rays) * f.irradiance, Emitted,
                                      f.instance);
        };
        arrives(light.samples[0]);
        arrives(light.samples[1]);
        sink.rayBegins(light);
        arrives(light.samples[2]);
        if (light.weight > 0 && light.hit)
            walkGatheredBounces(in, light, sampler, light.weight / float(rays) * weights[Bounced],
                                sink);
        sink.rayEnds();
    }
}

} // namespace limn
