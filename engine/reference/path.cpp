// SPDX-License-Identifier: MIT
#include "engine/reference/path.h"

#include "engine/shading/direct_light.h"
#include "engine/shading/incident_light.h"

#include <algorithm>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace limn {

namespace {

constexpr std::uint32_t kRouletteBounce = 3; ///< shorter paths are never cut
constexpr std::uint32_t kDimensionsPerBounce = 5;
constexpr std::uint32_t kLobeSeed =
    0x6c6f6265; // separates a reflection's random numbers from the others of a pixel

/// The power heuristic with exponent 2. Veach. Robust Monte Carlo Methods for Light Transport. 1997
float misWeight(float pdf, float other) {
    const float ratio = other / pdf;
    return 1 / (1 + ratio * ratio);
}

/// Irradiance of a light sample, weighted against the density with which a bounce finds the light.
glm::vec3 weightedIrradiance(const SurfacePoint& p, const IncidentLightSample& f) {
    if (f.irradiance == glm::vec3(0))
        return glm::vec3(0);
    return f.irradiance * misWeight(f.pdf, glm::dot(p.normal, f.toLight) / glm::pi<float>());
}

/// Reflected radiance of a light sample, weighted likewise.
glm::vec3 weightedReflection(const GlossyPoint& g, const IncidentLightSample& f) {
    if (f.irradiance == glm::vec3(0))
        return glm::vec3(0);
    const glm::vec3 n = g.surface.normal;
    return f.irradiance * specularBrdf(g.gloss, n, g.toEye, f.toLight) *
           misWeight(f.pdf, specularPdf(g.gloss.roughness, n, g.toEye, f.toLight));
}

} // namespace

// E = sum over path vertices of the throughput T (product of albedos after the first surface, which
// is left out) times what arrives there. A cosine-distributed bounce of density cos / pi brings
// irradiance pi L; reflection turns E into rho E / pi of radiance, so T only collects albedos.
glm::vec3 sampleIndirectIrradiance(const PathContext& c, const SurfacePoint& first,
                                   const Sampler& sampler, std::uint64_t& rays) {
    constexpr float pi = glm::pi<float>();
    glm::vec3 E(0), T(1);
    SurfacePoint p = first;
    for (std::uint32_t bounce = 0; bounce < c.maxBounces; ++bounce) {
        const std::uint32_t dimension = kFirstPathDimension + bounce * kDimensionsPerBounce;
        const glm::vec2 picks = sampler.pair(dimension);
        E += T * weightedIrradiance(p, sampleEmitterLight(c.trace, c.emitters, p, picks.x,
                                                          sampler.pair(dimension + 1), rays));
        E += T * weightedIrradiance(
                     p, sampleSkyLight(c.trace, c.sky, p, sampler.pair(dimension + 4), rays));

        const glm::vec3 direction = sampleCosineHemisphere(p.normal, sampler.pair(dimension + 2));
        if (!(glm::dot(direction, p.geometricNormal) > 0))
            break; // below the triangle's horizon
        ++rays;
        const Hit hit = c.trace.closestHit({rayOrigin(c.trace, p), direction});
        if (!hit) {
            const glm::vec3 radiance = skyRadiance(c.trace.scene().sky, direction);
            const float bouncePdf = glm::dot(p.normal, direction) / pi;
            E += T * pi * radiance * misWeight(bouncePdf, skyPdf(c.sky, radiance));
            break;
        }
        const std::optional<SurfacePoint> next = surfacePoint(c.trace, hit);
        if (!next)
            break;
        if (next->emission != glm::vec3(0)) {
            const float bouncePdf = glm::dot(p.normal, direction) / pi;
            E += T * pi * next->emission *
                 misWeight(bouncePdf, emitterPdf(c.emitters, hit, p.position));
        }
        const float before = std::max({T.x, T.y, T.z});
        T *= next->albedo;
        const float survival = std::max({T.x, T.y, T.z}) / before;
        if (!(survival > 0))
            break;
        if (bounce >=
            kRouletteBounce) { // Russian roulette in proportion to what the surface absorbs
            if (!(sampler.pair(dimension + 3).x < survival))
                break;
            T /= survival;
        }
        p = *next;
        E += T * sampleDirectLight(c.trace, p, picks.y,
                                   sampler.pair(kOnLightDimension + 1 + bounce), rays)
                     .irradiance;
    }
    return E;
}

/// Radiance that a glossy bounce finds; `pdf` is the density of its direction.
static glm::vec3 radianceAlong(const PathContext& c, const SurfacePoint& p, glm::vec3 direction,
                               float pdf, const Sampler& sampler, std::uint64_t& rays) {
    ++rays;
    const Hit hit = c.trace.closestHit({rayOrigin(c.trace, p), direction});
    if (!hit) {
        const glm::vec3 radiance = skyRadiance(c.trace.scene().sky, direction);
        return radiance * misWeight(pdf, skyPdf(c.sky, radiance));
    }
    const std::optional<SurfacePoint> next = surfacePoint(c.trace, hit);
    if (!next)
        return glm::vec3(0);
    const glm::vec3 direct =
        sampleDirectLight(c.trace, *next, sampler.pair(1).x, sampler.pair(kOnLightDimension), rays)
            .irradiance;
    const glm::vec3 bounced = sampleIndirectIrradiance(
        {c.trace, c.emitters, c.sky, c.maxBounces - 1}, *next, sampler, rays);
    glm::vec3 radiance = next->albedo / glm::pi<float>() * (direct + bounced);
    if (next->emission != glm::vec3(0))
        radiance += next->emission * misWeight(pdf, emitterPdf(c.emitters, hit, p.position));
    return radiance;
}

glm::vec3 sampleReflectedRadiance(const PathContext& c, const GlossyPoint& g,
                                  const Sampler& sampler, std::uint64_t& rays) {
    if (c.maxBounces == 0)
        return glm::vec3(0);
    const Sampler lobe{mixBits(sampler.seed, kLobeSeed), sampler.index};
    const Sampler light{mixBits(lobe.seed, kLobeSeed), sampler.index};
    const SurfacePoint& p = g.surface;
    glm::vec3 L = weightedReflection(g, sampleEmitterLight(c.trace, c.emitters, p, light.pair(0).x,
                                                           light.pair(1), rays)) +
                  weightedReflection(g, sampleSkyLight(c.trace, c.sky, p, light.pair(2), rays));
    const SpecularSample s = sampleSpecular(g.gloss, p.normal, g.toEye, lobe.pair(0));
    if (glm::dot(s.toLight, p.geometricNormal) > 0)
        L += s.weight * radianceAlong(c, p, s.toLight,
                                      specularPdf(g.gloss.roughness, p.normal, g.toEye, s.toLight),
                                      lobe, rays);
    return L;
}

} // namespace limn
