// SPDX-License-Identifier: MIT
#include "engine/reference/path.h"

#include "engine/reference/direct_light.h"

#include <algorithm>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace limn {

namespace {

constexpr std::uint32_t kRouletteBounce = 3; ///< shorter paths are never cut
constexpr std::uint32_t kDimensionsPerBounce = 5;
constexpr std::uint32_t kLobeSeed = 0x6c6f6265; // parts a lobe's samples from the others of a pixel

// Power heuristic, exponent 2. Veach. Robust Monte Carlo Methods for Light Transport. 1997
float misWeight(float pdf, float other) {
    const float ratio = other / pdf;
    return 1 / (1 + ratio * ratio);
}

// Irradiance from one point on an emitter, weighted against the chance of the bounce to find it.
glm::vec3 emitterIrradiance(const PathContext& c, const SurfacePoint& p, float pick, glm::vec2 u,
                            std::uint64_t& rays) {
    const EmitterSample s = sampleEmitter(c.emitters, c.trace.scene(), p.position, pick, u);
    if (s.radiance == glm::vec3(0))
        return glm::vec3(0);
    const glm::vec3 origin = rayOrigin(c.trace, p);
    const glm::vec3 way = s.position + s.normal * c.trace.epsilonAt(s.position) - origin;
    const float distance = glm::length(way);
    const glm::vec3 direction = way / distance;
    const float cosTheta = glm::dot(p.normal, direction);
    if (!(cosTheta > 0) || !(glm::dot(p.geometricNormal, direction) > 0))
        return glm::vec3(0);
    ++rays;
    if (c.trace.occluded({origin, direction, 0, distance}))
        return glm::vec3(0);
    const float bouncePdf = cosTheta / glm::pi<float>();
    return s.radiance * (cosTheta / s.pdf * misWeight(s.pdf, bouncePdf));
}

// Irradiance from one direction of the sky's image, weighted against the chance of the bounce.
glm::vec3 skyIrradiance(const PathContext& c, const SurfacePoint& p, glm::vec2 u,
                        std::uint64_t& rays) {
    const SkySample s = sampleSky(c.sky, c.trace.scene().sky, u);
    const float cosTheta = glm::dot(p.normal, s.direction);
    if (!(s.pdf > 0) || !(cosTheta > 0) || !(glm::dot(p.geometricNormal, s.direction) > 0))
        return glm::vec3(0);
    ++rays;
    if (c.trace.occluded({rayOrigin(c.trace, p), s.direction}))
        return glm::vec3(0);
    return s.radiance * (cosTheta / s.pdf * misWeight(s.pdf, cosTheta / glm::pi<float>()));
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
        if (!c.emitters.empty())
            E += T * emitterIrradiance(c, p, picks.x, sampler.pair(dimension + 1), rays);

        if (!c.sky.empty())
            E += T * skyIrradiance(c, p, sampler.pair(dimension + 4), rays);

        const glm::vec3 direction = sampleCosineHemisphere(p.normal, sampler.pair(dimension + 2));
        if (!(glm::dot(direction, p.geometricNormal) > 0))
            break; // under the surface's own horizon
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
        if (bounce >= kRouletteBounce) { // absorbed as by the surface itself: T stays as it was
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

glm::vec3 sampleLobeRadiance(const PathContext& c, const SurfacePoint& p, glm::vec3 mirrored,
                             float n, const Sampler& sampler, std::uint64_t& rays) {
    const Sampler own{mixBits(sampler.seed, kLobeSeed), sampler.index};
    const glm::vec3 direction = sampleLobeDirection(mirrored, n, own.pair(0));
    if (c.maxBounces == 0 || !(glm::dot(direction, p.geometricNormal) > 0))
        return glm::vec3(0);
    ++rays;
    const Hit hit = c.trace.closestHit({rayOrigin(c.trace, p), direction});
    if (!hit)
        return skyRadiance(c.trace.scene().sky, direction);
    const std::optional<SurfacePoint> next = surfacePoint(c.trace, hit);
    if (!next)
        return glm::vec3(0);
    const glm::vec3 direct =
        sampleDirectLight(c.trace, *next, own.pair(1).x, own.pair(kOnLightDimension), rays)
            .irradiance;
    const glm::vec3 bounced =
        sampleIndirectIrradiance({c.trace, c.emitters, c.sky, c.maxBounces - 1}, *next, own, rays);
    return next->emission + next->albedo / glm::pi<float>() * (direct + bounced);
}

} // namespace limn
