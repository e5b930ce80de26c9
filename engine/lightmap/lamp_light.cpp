// SPDX-License-Identifier: MIT
#include "engine/lightmap/lamp_light.h"

#include "engine/math/sampling.h"
#include "engine/scene/mesh/input_hash.h"
#include "engine/scene/mesh/triangle_geometry.h"
#include "engine/trace/rays_together.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

static constexpr std::uint32_t kNoTriangle = ~0U, kPointsPerDirection = 2;
/// Limits of what isNear() looks at, so that its time is bounded.
static constexpr std::size_t kMaxNearLamps = 1000, kMaxNearTriangles = 256;

LampLight::LampLight(const TraceScene& trace) : m_trace(trace) {
    const Scene& scene = trace.scene();
    m_first.assign(scene.instances.size(), kNoTriangle);
    m_radiance.assign(scene.instances.size(), 0);
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        const double area =
            instance.dynamic || !emits(scene.materialOf(instance)) ? 0 : worldArea(scene, instance);
        if (!(area > 0))
            continue;
        m_first[i] = std::uint32_t(m_triangles.size());
        m_radiance[i] = 1 / (area * std::numbers::pi);
        Lamp lamp{i, m_triangles.size(), 0, kNoBounds};
        double roots = 0;
        for (std::uint32_t t = 0; t < scene.meshOf(instance).triangleCount(); ++t) {
            const auto worldArea = double(triangleWorldArea(scene, instance, t));
            roots += std::sqrt(worldArea);
            m_triangles.push_back(
                {i, t, std::sqrt(worldArea), worldArea > 0 ? 1 / std::sqrt(worldArea) : 0});
            m_bounds.push_back(kNoBounds);
            for (const glm::vec2 corner : {glm::vec2(0), {1, 0}, {0, 1}})
                extend(m_bounds.back(), worldPoint(scene, instance, {t, corner}).position);
            extend(lamp.bounds, m_bounds.back());
        }
        lamp.end = m_triangles.size();
        for (std::size_t e = lamp.begin; e < lamp.end; ++e) {
            m_triangles[e].below /= roots;
            m_triangles[e].perArea /= roots;
        }
        m_lamps.push_back(lamp);
    }
    double sum = 0;
    for (Emitter& e : m_triangles) {
        e.below = sum += e.below / double(m_lamps.size());
        e.perArea /= double(m_lamps.size());
    }
}

/// Contribution of a point of a lamp, seen along `direction` at distance t under `cosine`, by the
/// densities of both kinds of samples; 0 where it shows a side that is dark.
double LampLight::weighted(const Emitter& emitter, glm::vec3 normal, glm::vec3 direction, float t,
                           double cosine, std::uint32_t samples) const {
    const Scene& scene = m_trace.scene();
    double facing = -double(glm::dot(normal, direction));
    if (isTwoSided(scene, scene.instances[emitter.instance]))
        facing = std::abs(facing);
    if (!(cosine > 0 && facing > 0))
        return 0;
    const double onLamp = kPointsPerDirection * emitter.perArea * double(t) * double(t) / facing;
    return m_radiance[emitter.instance] * cosine / (cosine / std::numbers::pi + onLamp) / samples;
}

bool LampLight::isNear(glm::vec3 point, float reach, std::uint32_t instance) const {
    const auto within = [&](const Bounds& b) {
        const glm::vec3 away = point - glm::clamp(point, b.lower, b.upper);
        return glm::dot(away, away) < reach * reach;
    };
    return m_lamps.size() <= kMaxNearLamps && std::ranges::any_of(m_lamps, [&](const Lamp& lamp) {
               return lamp.instance != instance && lamp.end - lamp.begin <= kMaxNearTriangles &&
                      within(lamp.bounds) &&
                      std::any_of(m_bounds.begin() + std::ptrdiff_t(lamp.begin),
                                  m_bounds.begin() + std::ptrdiff_t(lamp.end), within);
           });
}

LampPoints LampLight::pointsOnLamps(std::uint32_t samples, std::uint32_t seed) const {
    const Scene& scene = m_trace.scene();
    const float first = unitFloat(mixBits(seed + 1)), second = unitFloat(mixBits(seed + 2));
    const std::uint32_t points = kPointsPerDirection * samples;
    LampPoints result{samples, {}};
    for (std::uint32_t r = 0; r < points; ++r) {
        const double choice = (r + double(first)) / points * m_triangles.back().below;
        const auto emitter =
            std::min(std::ranges::lower_bound(m_triangles, choice, {}, &Emitter::below) -
                         m_triangles.begin(),
                     std::ptrdiff_t(m_triangles.size()) - 1);
        const Emitter& e = m_triangles[std::size_t(emitter)];
        const auto shifted = [](float x, float offset) {
            return x + offset - std::floor(x + offset);
        };
        const glm::vec2 square(shifted(radicalInverse(r, 2), second),
                               shifted(radicalInverse(r, 3), first));
        const WorldPoint point =
            worldPoint(scene, scene.instances[e.instance], {e.triangle, sampleTriangle(square)});
        result.all.push_back({std::uint32_t(emitter), point});
    }
    return result;
}

double LampLight::fromLamps(const WorldPoint& point, const LampPoints& lamps) const {
    const glm::vec3 from = m_trace.clearOf(point.position, point.normal);
    double sum = 0;
    RaysTogether<double> rays(m_trace, TraceMask::Static);
    const auto open = [&](double light) { sum += light; };
    for (const auto& [emitter, lamp] : lamps.all) {
        const glm::vec3 away = lamp.position - from;
        const float t = glm::length(away);
        if (!(t > 0))
            continue;
        const glm::vec3 direction = away / t;
        const double light = weighted(m_triangles[emitter], lamp.normal, direction, t,
                                      double(glm::dot(direction, point.normal)), lamps.samples);
        if (!(light > 0))
            continue;
        const glm::vec3 facing = glm::dot(lamp.normal, direction) > 0 ? -lamp.normal : lamp.normal;
        rays.add(rayBetween(from, m_trace.clearOf(lamp.position, facing)), light, open);
    }
    rays.flush(open);
    return sum;
}

LampIrradiance LampLight::at(const WorldPoint& point, float reach, std::uint32_t turn,
                             const LampPoints& lamps) const {
    const std::uint32_t samples = lamps.samples;
    const Scene& scene = m_trace.scene();
    const glm::vec3 from = m_trace.clearOf(point.position, point.normal);
    const glm::mat3 toWorld = basisAround(point.normal);
    const float lift = unitFloat(mixBits(turn)), spin = unitFloat(mixBits(turn + 0x9e3779b9U));
    double sum = 0;
    std::uint32_t open = 0;
    for (std::uint32_t r = 0; r < samples; ++r) {
        // Heights in strata of equal weight, all shifted alike, so that none is left out.
        const float z2 = 1 - (float(r) + lift) / float(samples), across = std::sqrt(1 - z2);
        const float angle =
            2 * std::numbers::pi_v<float> * (float(r) * (std::numbers::phi_v<float> - 1) + spin);
        const float cosine = std::sqrt(z2);
        const glm::vec3 direction =
            toWorld * glm::vec3(across * std::cos(angle), across * std::sin(angle), cosine);
        const Hit hit = m_trace.closestHit({from, direction}, TraceMask::Static);
        const bool back =
            hit && !hit.frontFace && !isTwoSided(scene, scene.instances[hit.instance]);
        open += back || (hit && hit.t < reach) ? 0 : 1;
        if (!hit)
            continue;
        if (!back && m_first[hit.instance] != kNoTriangle)
            sum += weighted(m_triangles[m_first[hit.instance] + hit.triangle], hit.geometricNormal,
                            direction, hit.t, double(cosine), samples);
    }
    sum += fromLamps(point, lamps);
    return {sum, double(open) / samples};
}

} // namespace limn
