// SPDX-License-Identifier: MIT
#include "engine/picture/emitted_light.h"

#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace limn {

/// The balance heuristic: the weight of a strategy of density `pdf` against one other.
static float balanceWeight(float pdf, float other) {
    return pdf / (pdf + other);
}

EmittedLightSources findEmittedLightSources(const TraceScene& trace) {
    EmittedLightSources sources{findEmitters(trace), findSkyLight(trace.scene().sky), false};
    const auto shines = [](glm::vec3 radiance) { return channelSum(radiance) > 0; };
    sources.any = !sources.emitters.empty() ||
                  std::ranges::any_of(skyCellRadiance(trace.scene().sky), shines);
    return sources;
}

EmittedLightSample sampleEmittedLight(const TraceScene& trace, const EmittedLightSources& sources,
                                      const SurfacePoint& p, const Sampler& sampler,
                                      const LightGuide* guide) {
    const float guided = guide ? guide->probability() : 0;
    // The density of the ray below in a direction.
    const auto density = [&](glm::vec3 d) {
        const float byCosine =
            (1 - guided) * std::max(glm::dot(p.normal, d), 0.f) / glm::pi<float>();
        return guided > 0 ? byCosine + guided * guide->pdf(d) : byCosine;
    };
    EmittedLightSample s;
    std::uint64_t rays = 0;
    s.samples[0] =
        sampleEmitterLight(trace, sources.emitters, p, sampler.pair(0).x, sampler.pair(1), rays);
    s.samples[1] = sampleSkyLight(trace, sources.sky, p, sampler.pair(2), rays);
    for (IncidentLightSample& f : std::span(s.samples).first(2))
        if (f.irradiance != glm::vec3(0))
            f.irradiance *= balanceWeight(f.pdf, density(f.toLight));

    // Guide and cosine share one stratified pair of numbers, so that both have stratified ones.
    const glm::vec2 u = sampler.pair(3);
    s.direction = u.x < guided
                      ? guide->sample({u.x / guided, u.y})
                      : sampleCosineHemisphere(p.normal, {(u.x - guided) / (1 - guided), u.y});
    const float cosTheta = glm::dot(p.normal, s.direction);
    if (!(cosTheta > 0) || !(glm::dot(p.geometricNormal, s.direction) > 0))
        return s;
    const float pdf = density(s.direction);
    s.weight = cosTheta / pdf;
    s.hit = trace.closestHit({rayOrigin(trace, p), s.direction});
    IncidentLightSample& f = s.samples[2];
    f = {.toLight = s.direction, .pdf = pdf};
    if (!s.hit) {
        const glm::vec3 radiance = skyRadiance(trace.scene().sky, s.direction);
        f.irradiance = radiance * s.weight * balanceWeight(pdf, skyPdf(sources.sky, radiance));
        return s;
    }
    s.point = surfacePoint(trace, s.hit);
    if (s.point && s.point->emission != glm::vec3(0)) {
        f.irradiance = s.point->emission * s.weight *
                       balanceWeight(pdf, emitterPdf(sources.emitters, s.hit, p.position));
        f.instance = s.hit.instance;
    }
    return s;
}

} // namespace limn
