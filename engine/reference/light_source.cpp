// SPDX-License-Identifier: MIT
#include "engine/reference/light_source.h"

#include "engine/math/sampling.h"
#include "engine/scene/light/rectangle_light.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace limn {

namespace {

constexpr float kPi = glm::pi<float>();

/// The part of a plane across `direction` through which light from there can reach the scene.
struct Beam {
    glm::mat3 basis;              ///< third column: the direction of the light
    glm::vec3 lower{0}, upper{0}; ///< bounds of the scene in this basis

    Beam(const Bounds& bounds, glm::vec3 direction) : basis(basisAround(direction)) {
        Bounds local = kNoBounds;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::vec3 p((corner & 1) != 0 ? bounds.upper.x : bounds.lower.x,
                              (corner & 2) != 0 ? bounds.upper.y : bounds.lower.y,
                              (corner & 4) != 0 ? bounds.upper.z : bounds.lower.z);
            extend(local, p * basis);
        }
        lower = local.lower;
        upper = local.upper;
    }
    double area() const { return double(upper.x - lower.x) * double(upper.y - lower.y); }
    Ray through(glm::vec2 u) const {
        const float margin = 1e-3f * glm::length(upper - lower);
        const glm::vec3 local(glm::mix(lower.x, upper.x, u.x), glm::mix(lower.y, upper.y, u.y),
                              lower.z - margin);
        return {basis * local, basis[2]};
    }
};

/// Solid angle that a point or spot light shines into [sr].
double solidAngle(const Light& light) {
    const double cosine = light.kind == LightKind::Spot ? std::cos(double(light.outerAngle)) : -1;
    return 2 * glm::pi<double>() * (1 - cosine);
}

double aboutPower(const Scene& scene, const Light& light) {
    const double strength = double(channelSum(light.color)) * double(light.strength);
    if (!shines(light))
        return 0;
    switch (light.kind) {
    case LightKind::Directional:
        return strength * Beam(scene.bounds, light.direction).area();
    case LightKind::Point:
    case LightKind::Spot:
        return strength *
               (profileOf(light) ? profileSolidAngle(*profileOf(light)) : solidAngle(light));
    case LightKind::Rectangle:
        return strength * double(lightRectangle(light).area) * glm::pi<double>();
    }
    return 0;
}

double aboutPower(const Scene& scene, const Emitters& emitters) {
    double power = 0;
    for (const EmissiveTriangle& e : emitters.triangles) {
        const glm::vec3 emission = scene.materialOf(scene.instances[e.instance]).emission;
        power += double(e.area) * double(channelSum(emission)) * (e.bothSides ? 2 : 1);
    }
    return power * glm::pi<double>();
}

double skyPower(const Scene& scene) {
    double radiance = 0; // cells have equal solid angles
    const std::vector<glm::vec3> cells = skyCellRadiance(scene.sky);
    for (const glm::vec3 cell : cells)
        radiance += double(channelSum(cell)) / double(cells.size());
    const double diameter = double(glm::length(scene.bounds.size()));
    return radiance * glm::pi<double>() * glm::pi<double>() * diameter * diameter;
}

Emission fromLamp(const TraceScene& trace, const Light& light, glm::vec2 place,
                  glm::vec2 direction) {
    Emission e;
    const float all = float(solidAngle(light));
    const float cosine = 1 - place.x * all / (2 * kPi);
    e.ray.origin = light.position;
    e.ray.tNear = trace.epsilonAt(light.position); // a light on a wall is not in the wall's shadow
    e.ray.direction = directionAbout(light.direction, std::sqrt(std::max(1 - cosine * cosine, 0.f)),
                                     cosine, direction.x);
    e.power = glm::vec3(all); // times the intensity, see powerAt()
    return e;
}

Emission fromRectangle(const TraceScene& trace, const Light& light, glm::vec2 place,
                       glm::vec2 direction) {
    const LightRectangle rectangle = lightRectangle(light);
    Emission e;
    e.ray = {trace.clearOf(rectangle.at(place), rectangle.normal),
             sampleCosineHemisphere(rectangle.normal, direction)};
    e.power = light.color * light.strength * (kPi * rectangle.area);
    return e;
}

Emission fromEmitter(const TraceScene& trace, const Emitters& emitters, float pick, glm::vec2 place,
                     glm::vec2 direction) {
    const Scene& scene = trace.scene();
    const auto found = std::upper_bound(emitters.cdf.begin(), emitters.cdf.end(), double(pick));
    const std::size_t i =
        std::min(std::size_t(found - emitters.cdf.begin()), emitters.cdf.size() - 1);
    const double probability = emitters.cdf[i] - (i > 0 ? emitters.cdf[i - 1] : 0);
    const EmissiveTriangle& triangle = emitters.triangles[i];
    glm::vec3 normal = triangle.normal;
    float sides = 1;
    if (triangle.bothSides) {
        sides = 2;
        normal = place.x < 0.5f ? normal : -normal;
        place.x = place.x < 0.5f ? 2 * place.x : 2 * place.x - 1;
    }
    if (place.x + place.y > 1)
        place = 1.f - place;
    const SurfaceMaterial m = surfaceMaterial(scene, scene.instances[triangle.instance],
                                              triangle.triangle, place.x, place.y);
    Emission e;
    if (!(m.alpha > 0))
        return e;
    const glm::vec3 p = triangle.corner + place.x * triangle.edge1 + place.y * triangle.edge2;
    e.ray = {trace.clearOf(p, normal), sampleCosineHemisphere(normal, direction)};
    e.power = m.emission * float(double(kPi * sides * triangle.area) / probability);
    return e;
}

Emission fromSky(const Scene& scene, const SkyLight& light, glm::vec2 place, glm::vec2 direction) {
    SkySample s;
    if (light.empty()) {
        s.direction = directionAbout({0, 1, 0}, 2 * std::sqrt(direction.x * (1 - direction.x)),
                                     1 - 2 * direction.x, direction.y);
        s.radiance = skyRadiance(scene.sky, s.direction);
        s.pdf = 1 / (4 * kPi);
    } else {
        s = sampleSky(light, scene.sky, direction);
    }
    Emission e;
    if (!(s.pdf > 0))
        return e;
    const Beam beam(scene.bounds, -s.direction);
    e.ray = beam.through(place);
    e.power = s.radiance * float(beam.area() / double(s.pdf));
    return e;
}

Emission fromLight(const TraceScene& trace, std::size_t index, glm::vec2 place,
                   glm::vec2 direction) {
    const Light& light = trace.scene().lights[index];
    Emission e;
    switch (light.kind) {
    case LightKind::Directional: {
        const Beam beam(trace.scene().bounds, light.direction);
        e.ray = beam.through(place);
        e.power = light.color * light.strength * float(beam.area());
        break;
    }
    case LightKind::Point:
    case LightKind::Spot:
        e = fromLamp(trace, light, place, direction);
        e.lamp = std::int32_t(index);
        break;
    case LightKind::Rectangle:
        e = fromRectangle(trace, light, place, direction);
        break;
    }
    e.isLamp = true;
    return e;
}

} // namespace

LightSources findLightSources(const TraceScene& trace) {
    const Scene& scene = trace.scene();
    LightSources sources;
    sources.emitters = findEmitters(trace);
    sources.sky = findSkyLight(scene.sky);
    double sum = 0;
    for (const Light& light : scene.lights)
        sources.cdf.push_back(sum += aboutPower(scene, light));
    sources.cdf.push_back(sum += aboutPower(scene, sources.emitters));
    sources.cdf.push_back(sum += skyPower(scene));
    if (!(sum > 0) || !std::isfinite(sum))
        return {};
    for (double& c : sources.cdf)
        c /= sum;
    return sources;
}

Emission sampleEmission(const TraceScene& trace, const LightSources& sources,
                        const Sampler& sampler) {
    const std::size_t lights = trace.scene().lights.size();
    const glm::vec2 picks = sampler.pair(0), place = sampler.pair(1), direction = sampler.pair(2);
    const auto found = std::upper_bound(sources.cdf.begin(), sources.cdf.end(), double(picks.x));
    const std::size_t i =
        std::min(std::size_t(found - sources.cdf.begin()), sources.cdf.size() - 1);
    const double probability = sources.cdf[i] - (i > 0 ? sources.cdf[i - 1] : 0);
    Emission e;
    if (i < lights)
        e = fromLight(trace, i, place, direction);
    else if (i == lights)
        e = fromEmitter(trace, sources.emitters, picks.y, place, direction);
    else
        e = fromSky(trace.scene(), sources.sky, place, direction);
    e.power = glm::vec3(glm::dvec3(e.power) / probability);
    return e;
}

glm::vec3 powerAt(const Scene& scene, const Emission& emission, glm::vec3 p) {
    if (emission.lamp < 0)
        return emission.power;
    const LightSample sample = sampleLight(scene.lights[std::size_t(emission.lamp)], p);
    return emission.power * sample.irradiance * (sample.distance * sample.distance);
}

} // namespace limn
