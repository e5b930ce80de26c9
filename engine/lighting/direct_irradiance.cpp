// SPDX-License-Identifier: MIT
#include "engine/lighting/direct_irradiance.h"

#include "engine/core/hash.h"
#include "engine/core/parallel.h"
#include "engine/math/sampling.h"
#include "engine/scene/light/light_parts.h"
#include "engine/scene/light/unit_light.h"
#include "engine/trace/rays_together.h"
#include "engine/trace/rectangle_shadow.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

Light withoutName(Light l) {
    l.name.clear();
    return l;
}

std::uint64_t hashOccluders(const Scene& scene) {
    std::uint64_t h = 3;
    for (const Instance& i : scene.instances)
        h = hashBytes(&i.toWorld, sizeof i.toWorld, hashValue(i.mesh, h));
    return h;
}

/// The rectangles from which a light shines; empty: a point.
std::vector<LightRectangle> rectanglesOf(const Light& light, const Scene& scene) {
    if (light.kind != LightKind::Rectangle)
        return {};
    std::vector<LightRectangle> parts;
    for (const Light& part : partsBetweenWalls(light, scene))
        parts.push_back(lightRectangle(part));
    return parts;
}

// Neighbours shift the points on the rectangle differently, so that the remaining pattern averages
// out over an area.
float rectangleShare(const TraceScene& trace, const std::vector<LightRectangle>& rectangles,
                     glm::vec3 p, glm::vec3 n, std::uint32_t point, std::uint32_t samples,
                     std::uint64_t& rays) {
    const std::uint32_t bits = mixBits(point);
    const glm::vec2 shift(unitFloat(bits), unitFloat(mixBits(bits)));
    float sum = 0;
    for (const LightRectangle& r : rectangles)
        sum += shadowedIrradiance(trace, r, RectangleReceiver::flat(p, n), samples, shift, rays);
    return sum;
}

/// Adds up the light of a point light, a spot or a sun at many positions. Shadow rays are traced
/// several at once, since light reaches neighbours from about the same direction.
class PointShares {
    /// What a ray adds to a point where it is not occluded.
    struct Share {
        std::size_t point;
        float light;
    };
    auto open() const {
        return [this](const Share& s) { m_share[s.point] += s.light; };
    }

public:
    PointShares(const TraceScene& trace, const Light& light, std::uint32_t each,
                std::span<float> share)
        : m_trace(trace), m_light(light), m_each(each), m_share(share),
          m_rays(trace, TraceMask::All) {}

    /// Adds position `index`, and the normal there, to the mean of its point.
    void add(std::size_t index, glm::vec3 p, glm::vec3 n) {
        const LightSample sample = sampleLight(m_light, p);
        const float cosTheta = glm::dot(n, sample.toLight);
        if (!(cosTheta > 0) || !(sample.irradiance.x > 0))
            return;
        m_rays.add(
            {m_trace.clearOf(p, n), sample.toLight, 0, sample.distance - m_trace.epsilonAt(p)},
            {index / m_each, sample.irradiance.x * cosTheta / float(m_each)}, open());
    }

    /// Traces the rays that wait.
    void flush() { m_rays.flush(open()); }

    std::uint64_t traced() const { return m_rays.traced(); }

private:
    const TraceScene& m_trace;
    const Light& m_light;
    std::uint32_t m_each;
    std::span<float> m_share;
    RaysTogether<Share> m_rays;
};

// Returns the shadow rays traced.
std::uint64_t traceLight(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals,
                         std::uint32_t each, const TraceScene& trace,
                         DirectIrradiance::PerLight& out) {
    // A ray that grazes an edge may depend on those traced with it. Blocks are the same for any
    // number of threads, and so are the rays that are traced together.
    constexpr std::size_t kBlock = 256;
    const std::vector<LightRectangle> rectangles = rectanglesOf(out.light, trace.scene());
    const std::size_t points = positions.size() / each;
    out.share.assign(points, 0);
    const std::uint32_t samples = std::max(DirectIrradiance::kRectanglePoints / each, 1U);
    std::atomic<std::uint64_t> rays = 0;
    const auto lightBlock = [&](std::size_t begin, std::size_t end) {
        if (rectangles.empty()) {
            PointShares shares(trace, out.light, each, out.share);
            for (std::size_t index = begin * each; index < end * each; ++index)
                shares.add(index, positions[index], normals[index]);
            shares.flush();
            return shares.traced();
        }
        std::uint64_t mine = 0;
        for (std::size_t index = begin * each; index < end * each; ++index)
            out.share[index / each] +=
                rectangleShare(trace, rectangles, positions[index], normals[index],
                               std::uint32_t(index), samples, mine) /
                float(each);
        return mine;
    };
    parallelRanges((points + kBlock - 1) / kBlock, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t b = begin; b < end; ++b)
            rays += lightBlock(b * kBlock, std::min((b + 1) * kBlock, points));
    });
    return rays;
}

void sumLights(std::size_t points, DirectIrradiance& state) {
    state.irradiance.assign(points, glm::vec3(0));
    parallelRanges(points, 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t l = 0; l < state.lights.size(); ++l) {
            const glm::vec3 strength = state.summed[l].color * state.summed[l].strength;
            const std::vector<float>& share = state.lights[l].share;
            for (std::size_t s = begin; s < end; ++s)
                state.irradiance[s] += glm::min(strength * share[s], kMaxIrradiance);
        }
    });
}

} // namespace

bool updateDirectIrradiance(std::span<const glm::vec3> positions,
                            std::span<const glm::vec3> normals, const Scene& scene,
                            const TraceScene& trace, DirectIrradiance& state, std::uint32_t each) {
    assert(positions.size() == normals.size() && positions.size() % each == 0);
    const std::size_t points = positions.size() / each;
    state.lightsTraced = 0;
    state.raysTraced = 0;
    if (state.irradiance.size() != points)
        state.bounds = boundsOf(positions);
    std::vector<Light>& lights = state.wanted;
    lights.clear();
    for (const Light& l : scene.lights)
        if (shines(l) && reaches(l, state.bounds))
            lights.push_back(withoutName(l));
    const std::uint64_t occluders = hashOccluders(trace.scene());
    if (occluders != state.occluders)
        for (DirectIrradiance::PerLight& light : state.lights)
            light.light.enabled = false; // matches no light that shines
    else if (lights == state.summed && state.irradiance.size() == points)
        return false;
    state.occluders = occluders;

    const auto hasShare = [](const DirectIrradiance::PerLight& l) { return !l.share.empty(); };
    std::vector<DirectIrradiance::PerLight>& known = state.known;
    known.clear();
    std::swap(known, state.lights);
    for (const Light& light : lights) {
        state.lights.push_back({unitLight(light), {}});
        DirectIrradiance::PerLight& next = state.lights.back();
        const auto same = std::ranges::find_if(
            known, [&](const auto& l) { return l.light == next.light && hasShare(l); });
        if (same != known.end())
            std::swap(next.share, same->share);
    }
    auto gone = known.begin(); // unused entries, whose memory is reused
    for (DirectIrradiance::PerLight& light : state.lights) {
        if (hasShare(light))
            continue;
        gone = std::find_if(gone, known.end(), hasShare);
        if (gone != known.end())
            std::swap(light.share, gone->share);
        state.raysTraced += traceLight(positions, normals, each, trace, light);
        ++state.lightsTraced;
    }
    std::swap(state.summed, lights);
    std::swap(state.before, state.irradiance);
    sumLights(points, state);
    return state.before != state.irradiance;
}

} // namespace limn
