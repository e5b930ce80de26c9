// SPDX-License-Identifier: MIT
#include "engine/shading/direct_light.h"

#include "engine/math/sh.h"
#include "engine/trace/rectangle_shadow.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

namespace limn {

namespace {

struct Unshadowed {
    glm::vec3 irradiance{0};
    LightSample sample;
};

Unshadowed unshadowed(const Light& light, const SurfacePoint& p) {
    Unshadowed u;
    if (light.kind == LightKind::Rectangle) {
        if (light.enabled)
            u.irradiance = light.color * light.strength *
                           rectangleIrradiance(lightRectangle(light), p.position, p.normal);
        return u;
    }
    u.sample = sampleLight(light, p.position);
    if (glm::dot(p.geometricNormal, u.sample.toLight) > 0)
        u.irradiance = u.sample.irradiance * std::max(0.f, glm::dot(p.normal, u.sample.toLight));
    return u;
}

bool inShadow(const TraceScene& trace, const SurfacePoint& p, const LightSample& s,
              TraceMask mask = TraceMask::All) {
    Ray ray;
    ray.origin = rayOrigin(trace, p);
    if (std::isinf(s.distance)) {
        ray.direction = s.toLight;
        return trace.occluded(ray, mask);
    }
    const glm::vec3 light = p.position + s.toLight * s.distance;
    const glm::vec3 way = light - ray.origin;
    const float distance = glm::length(way);
    ray.tFar = distance - trace.epsilonAt(light); // a light on a wall is not in the wall's shadow
    if (!(ray.tFar > 0))
        return false;
    ray.direction = way / distance;
    return trace.occluded(ray, mask);
}

/// Samples one point of a rectangle, uniform in solid angle.
DirectSample sampleRectangle(const TraceScene& trace, const SurfacePoint& p, const Light& light,
                             glm::vec2 uv, TraceMask mask) {
    const LightRectangle rectangle = lightRectangle(light);
    const SphericalRectangle sphere(rectangle, p.position);
    const glm::vec3 onLight = sphere.at(uv);
    const glm::vec3 way = onLight - p.position;
    if (!(glm::dot(p.geometricNormal, way) > 0) || !(glm::dot(rectangle.normal, way) < 0))
        return {};
    const glm::vec3 toLight = glm::normalize(way);
    const float projected = float(sphere.solidAngle()) * glm::dot(p.normal, toLight);
    if (!(projected > 0) ||
        trace.blocked(rayOrigin(trace, p), trace.clearOf(onLight, rectangle.normal), mask))
        return {};
    return {light.color * light.strength * projected, toLight};
}

/// Samples a light whose unshadowed irradiance `l` is not 0.
DirectSample sampleShadowed(const TraceScene& trace, const SurfacePoint& p, const Light& light,
                            const Unshadowed& l, glm::vec2 onLight, std::uint64_t& rays,
                            TraceMask mask = TraceMask::All) {
    ++rays;
    if (light.kind == LightKind::Rectangle)
        return sampleRectangle(trace, p, light, onLight, mask);
    if (inShadow(trace, p, l.sample, mask))
        return {};
    return {l.irradiance, l.sample.toLight};
}

/// Calls add(radiance times solid angle, direction) for what is visible of a rectangle.
template <class Add>
void addRectangle(const TraceScene& trace, const SurfacePoint& p, const Light& light,
                  const Add& add, std::uint64_t& rays) {
    const LightRectangle rectangle = lightRectangle(light);
    if (!light.enabled || !(glm::dot(rectangle.normal, p.position - rectangle.centre) > 0))
        return;
    const SphericalRectangle sphere(rectangle, p.position);
    const glm::vec3 share =
        light.color * light.strength * float(sphere.solidAngle() / kRectanglePoints);
    for (std::uint32_t i = 0; i < kRectanglePoints; ++i) {
        const glm::vec3 onLight = sphere.at(pointOnLight(i, kRectanglePoints, glm::vec2(0)));
        const glm::vec3 way = onLight - p.position;
        if (!(glm::dot(p.geometricNormal, way) > 0))
            continue;
        ++rays;
        if (!trace.blocked(rayOrigin(trace, p), trace.clearOf(onLight, rectangle.normal)))
            add(share, glm::normalize(way));
    }
}

} // namespace

glm::vec3 directIrradiance(const TraceScene& trace, const SurfacePoint& p, std::uint64_t& rays) {
    glm::vec3 E(0);
    for (const Light& light : trace.scene().lights) {
        const Unshadowed l = unshadowed(light, p);
        if (!(channelSum(l.irradiance) > 0))
            continue;
        if (light.kind == LightKind::Rectangle) {
            E += light.color * light.strength *
                 shadowedIrradiance(trace, lightRectangle(light),
                                    {p.position, p.geometricNormal, p.normal}, kRectanglePoints,
                                    glm::vec2(0), rays);
            continue;
        }
        ++rays;
        if (!inShadow(trace, p, l.sample))
            E += l.irradiance;
    }
    return E;
}

DirectSample sampleDirectLightFrom(const TraceScene& trace, const SurfacePoint& p,
                                   const Light& light, glm::vec2 onLight, std::uint64_t& rays) {
    const Unshadowed l = unshadowed(light, p);
    return channelSum(l.irradiance) > 0 ? sampleShadowed(trace, p, light, l, onLight, rays)
                                        : DirectSample{};
}

void addDirectHarmonics(const TraceScene& trace, const SurfacePoint& p, int bands, glm::vec3* c,
                        std::uint64_t& rays) {
    const auto add = [&](glm::vec3 light, glm::vec3 direction) {
        std::array<float, kMaxCoefficients> y;
        shBasis(bands, direction, y.data());
        for (int i = 0; i < bands * bands; ++i)
            c[i] += light * y[std::size_t(i)];
    };
    for (const Light& light : trace.scene().lights) {
        if (light.kind == LightKind::Rectangle) {
            addRectangle(trace, p, light, add, rays);
            continue;
        }
        const LightSample s = sampleLight(light, p.position);
        if (!(channelSum(s.irradiance) > 0) || !(glm::dot(p.geometricNormal, s.toLight) > 0))
            continue;
        ++rays;
        if (!inShadow(trace, p, s))
            add(s.irradiance, s.toLight);
    }
}

DirectSample sampleDirectLight(const TraceScene& trace, const SurfacePoint& p, float pick,
                               glm::vec2 onLight, std::uint64_t& rays, TraceMask mask) {
    float total = 0;
    for (const Light& light : trace.scene().lights)
        total += channelSum(unshadowed(light, p).irradiance);
    if (!(total > 0))
        return {};
    float below = 0;
    Unshadowed chosen;
    const Light* light = nullptr;
    for (const Light& candidate : trace.scene().lights) {
        const Unshadowed l = unshadowed(candidate, p);
        if (!(channelSum(l.irradiance) > 0))
            continue;
        chosen = l;
        light = &candidate;
        below += channelSum(l.irradiance);
        if (pick * total < below)
            break;
    }
    DirectSample s = sampleShadowed(trace, p, *light, chosen, onLight, rays, mask);
    s.irradiance *= total / channelSum(chosen.irradiance); // 1 / probability
    return s;
}

} // namespace limn
