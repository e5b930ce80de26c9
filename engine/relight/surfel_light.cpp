// SPDX-License-Identifier: MIT
#include "engine/relight/surfel_light.h"

#include "engine/core/hash.h"
#include "engine/core/parallel.h"
#include "engine/math/sampling.h"
#include "engine/relight/rectangle_shadow.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

Bounds boundsOf(const std::vector<glm::vec3>& points) {
    Bounds bounds{glm::vec3(1e30f), glm::vec3(-1e30f)};
    for (const glm::vec3 p : points) {
        bounds.lower = glm::min(bounds.lower, p);
        bounds.upper = glm::max(bounds.upper, p);
    }
    return bounds;
}

Light withoutName(Light l) {
    l.name.clear();
    return l;
}

/// The light with everything that moves no shadow set to one.
Light shapeOf(Light l) {
    l.color = glm::vec3(1);
    l.strength = 1;
    return l;
}

std::uint64_t hashOccluders(const Scene& scene) {
    std::uint64_t h = 3;
    for (const Instance& i : scene.instances)
        h = hashBytes(&i.toWorld, sizeof i.toWorld, hashValue(i.mesh, h));
    return h;
}

// Neighbours shift the points on the rectangle differently, so that what is left of their pattern
// averages out over a cluster.
std::uint32_t traceRectangle(const Surfels& surfels, const TraceScene& trace,
                             SurfelLight::PerLight& out) {
    const LightRectangle rectangle = lightRectangle(out.light);
    std::atomic<std::uint64_t> rays = 0;
    parallelRanges(surfels.size(), 256, [&](std::size_t begin, std::size_t end) {
        std::uint64_t mine = 0;
        for (std::size_t s = begin; s < end; ++s) {
            const std::uint32_t bits = mixBits(std::uint32_t(s));
            out.share[s] = shadowedIrradiance(trace, rectangle, surfels.position[s],
                                              surfels.normal[s], SurfelLight::kRectanglePoints,
                                              {unitFloat(bits), unitFloat(mixBits(bits))}, mine);
        }
        rays += mine;
    });
    return std::uint32_t(rays);
}

// Returns the shadow rays traced.
std::uint32_t traceLight(const Surfels& surfels, const TraceScene& trace,
                         SurfelLight::PerLight& out) {
    out.share.resize(surfels.size());
    if (out.light.kind == LightKind::Rectangle)
        return traceRectangle(surfels, trace, out);
    std::atomic<std::uint32_t> rays = 0;
    parallelRanges(surfels.size(), 256, [&](std::size_t begin, std::size_t end) {
        std::uint32_t mine = 0;
        for (std::size_t s = begin; s < end; ++s) {
            out.share[s] = 0;
            const glm::vec3 p = surfels.position[s], n = surfels.normal[s];
            const LightSample light = sampleLight(out.light, p);
            const float cosTheta = glm::dot(n, light.toLight);
            if (!(cosTheta > 0) || !(light.irradiance.x > 0))
                continue;
            ++mine;
            const Ray ray{trace.clearOf(p, n), light.toLight, 0,
                          light.distance - trace.epsilonAt(p)};
            if (!trace.occluded(ray))
                out.share[s] = light.irradiance.x * cosTheta;
        }
        rays += mine;
    });
    return rays;
}

void sumLights(std::size_t surfels, SurfelLight& state) {
    state.irradiance.assign(surfels, glm::vec3(0));
    parallelRanges(surfels, 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t l = 0; l < state.lights.size(); ++l) {
            const glm::vec3 strength = state.summed[l].color * state.summed[l].strength;
            const std::vector<float>& share = state.lights[l].share;
            for (std::size_t s = begin; s < end; ++s)
                state.irradiance[s] += strength * share[s];
        }
    });
}

} // namespace

bool updateSurfelLight(const Surfels& surfels, const Scene& scene, const TraceScene& trace,
                       SurfelLight& state) {
    state.lightsTraced = state.raysTraced = 0;
    if (state.irradiance.size() != surfels.size())
        state.bounds = boundsOf(surfels.position);
    std::vector<Light>& lights = state.wanted;
    lights.clear();
    for (const Light& l : scene.lights)
        if (shines(l) && reaches(l, state.bounds))
            lights.push_back(withoutName(l));
    const std::uint64_t occluders = hashOccluders(trace.scene());
    if (occluders != state.occluders)
        for (SurfelLight::PerLight& light : state.lights)
            light.light.enabled = false; // no light that shines
    else if (lights == state.summed && state.irradiance.size() == surfels.size())
        return false;
    state.occluders = occluders;

    const auto hasShare = [](const SurfelLight::PerLight& l) { return !l.share.empty(); };
    std::vector<SurfelLight::PerLight>& known = state.known;
    known.clear();
    std::swap(known, state.lights);
    for (const Light& light : lights) {
        state.lights.push_back({shapeOf(light), {}});
        SurfelLight::PerLight& next = state.lights.back();
        const auto same = std::ranges::find_if(
            known, [&](const auto& l) { return l.light == next.light && hasShare(l); });
        if (same != known.end())
            std::swap(next.share, same->share);
    }
    auto gone = known.begin(); // whose memory is of use
    for (SurfelLight::PerLight& light : state.lights) {
        if (hasShare(light))
            continue;
        gone = std::find_if(gone, known.end(), hasShare);
        if (gone != known.end())
            std::swap(light.share, gone->share);
        state.raysTraced += traceLight(surfels, trace, light);
        ++state.lightsTraced;
    }
    std::swap(state.summed, lights);
    std::swap(state.before, state.irradiance);
    sumLights(surfels.size(), state);
    return state.before != state.irradiance;
}

} // namespace limn
