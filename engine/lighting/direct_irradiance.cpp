// SPDX-License-Identifier: MIT
#include "engine/lighting/direct_irradiance.h"

#include "engine/core/parallel.h"
#include "engine/lighting/occluder_hash.h"
#include "engine/math/sampling.h"
#include "engine/scene/light/light_parts.h"
#include "engine/scene/light/unit_light.h"
#include "engine/trace/rays_together.h"
#include "engine/trace/rectangle_shadow.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cmath>
#include <optional>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

Light withoutName(Light l) {
    l.name.clear();
    return l;
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

/// Positions with normals, of which every `each` in turn form one point.
struct Points {
    std::span<const glm::vec3> positions, normals;
    std::uint32_t each = 1;

    std::size_t count() const { return positions.size() / each; }
};

/// Blocks of points are the same for any number of threads, and so are the rays that are traced
/// together: one that grazes an edge may depend on the others. A block has whole words of bits.
constexpr std::size_t kBlock = 256;

/// Lights points by a point light, a spot or a sun. Shadow rays are traced several at once, since
/// light reaches neighbours from about the same direction.
class PointShares {
public:
    PointShares(const TraceScene& trace, const Points& points, DirectIrradiance::PerLight& out)
        : m_trace(trace), m_points(points), m_light(out.light), m_out(out),
          m_anyMoving(std::ranges::any_of(trace.scene().instances, &Instance::dynamic)) {
        if (m_light.kind == LightKind::Directional)
            m_sun = sampleLight(m_light, glm::vec3(0)); // the same everywhere
    }

    /// Lights points [begin, end). `knowsStill`: `open` is that of the static instances. Returns
    /// the number of rays.
    std::uint64_t light(std::size_t begin, std::size_t end, bool knowsStill) const {
        std::fill(m_out.share.begin() + std::ptrdiff_t(begin),
                  m_out.share.begin() + std::ptrdiff_t(end), 0.f);
        const std::uint64_t rays = knowsStill ? 0 : traceStill(begin, end);
        if (!knowsStill && !m_anyMoving)
            return rays;
        return rays + traceMoving(begin, end);
    }

private:
    /// What a ray adds to a point where it is not occluded.
    struct Share {
        std::size_t position, point;
        float light;
    };

    /// Calls body(ray, share) for each position of a point whose front the light reaches.
    template <class Body>
    void forEachRay(std::size_t point, const Body& body) const {
        for (std::uint32_t k = 0; k < m_points.each; ++k) {
            const std::size_t i = point * m_points.each + k;
            const glm::vec3 p = m_points.positions[i], n = m_points.normals[i];
            const LightSample sample = m_sun ? *m_sun : sampleLight(m_light, p);
            const float cosTheta = glm::dot(n, sample.toLight);
            if (!(cosTheta > 0) || !(sample.irradiance.x > 0))
                continue;
            const float epsilon = m_trace.epsilonAt(p);
            body(Ray{p + epsilon * n, sample.toLight, 0, sample.distance - epsilon},
                 Share{i, point, sample.irradiance.x * cosTheta / float(m_points.each)});
        }
    }
    void add(const Share& s) const { m_out.share[s.point] += s.light; }

    /// Finds the positions that see the light past what stands still, and lights the points where
    /// nothing moves.
    std::uint64_t traceStill(std::size_t begin, std::size_t end) const {
        const auto first = m_out.open.begin() + std::ptrdiff_t(begin * m_points.each / 64);
        std::fill_n(first, ((end - begin) * m_points.each + 63) / 64, std::uint64_t(0));
        RaysTogether<Share> rays(m_trace, TraceMask::Static);
        const auto open = [&](const Share& s) {
            m_out.open[s.position / 64] |= std::uint64_t(1) << s.position % 64;
            if (!m_anyMoving)
                add(s);
        };
        for (std::size_t point = begin; point < end; ++point)
            forEachRay(point, [&](const Ray& ray, const Share& s) { rays.add(ray, s, open); });
        rays.flush(open);
        return rays.traced();
    }

    /// Lights the points from the positions that see the light past what moves, too.
    std::uint64_t traceMoving(std::size_t begin, std::size_t end) const {
        RaysTogether<Share> rays(m_trace, TraceMask::Dynamic);
        const auto open = [&](const Share& s) { add(s); };
        for (std::size_t point = begin; point < end; ++point)
            forEachRay(point, [&](const Ray& ray, const Share& s) {
                if ((m_out.open[s.position / 64] >> s.position % 64 & 1) == 0)
                    return;
                if (m_anyMoving)
                    rays.add(ray, s, open);
                else
                    add(s);
            });
        rays.flush(open);
        return rays.traced();
    }

    const TraceScene& m_trace;
    const Points& m_points;
    const Light& m_light;
    DirectIrradiance::PerLight& m_out;
    std::optional<LightSample> m_sun; ///< of a directional light
    bool m_anyMoving;
};

/// Calls light(begin, end) for blocks of points, which returns a number of rays, and sums these.
template <class LightBlock>
std::uint64_t forBlocks(std::size_t points, const LightBlock& light) {
    std::atomic<std::uint64_t> rays = 0;
    parallelRanges((points + kBlock - 1) / kBlock, 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t b = begin; b < end; ++b)
            rays += light(b * kBlock, std::min((b + 1) * kBlock, points));
    });
    return rays;
}

// Returns the shadow rays traced. `knowsStill`: as PointShares takes it.
std::uint64_t traceLight(const Points& points, const TraceScene& trace, bool knowsStill,
                         DirectIrradiance::PerLight& out) {
    out.share.resize(points.count());
    if (out.light.kind != LightKind::Rectangle) {
        out.open.resize((points.positions.size() + 63) / 64);
        const PointShares shares(trace, points, out);
        return forBlocks(points.count(), [&](std::size_t begin, std::size_t end) {
            return shares.light(begin, end, knowsStill);
        });
    }
    out.open.clear();
    const std::vector<LightRectangle> rectangles = rectanglesOf(out.light, trace.scene());
    const std::uint32_t samples = std::max(DirectIrradiance::kRectanglePoints / points.each, 1U);
    return forBlocks(points.count(), [&](std::size_t begin, std::size_t end) {
        std::uint64_t rays = 0;
        for (std::size_t point = begin; point < end; ++point) {
            out.share[point] = 0;
            for (std::size_t i = point * points.each; i < (point + 1) * points.each; ++i)
                out.share[point] +=
                    rectangleShare(trace, rectangles, points.positions[i], points.normals[i],
                                   std::uint32_t(i), samples, rays) /
                    float(points.each);
        }
        return rays;
    });
}

/// Returns whether a sum has changed.
bool sumLights(std::size_t points, DirectIrradiance& state) {
    constexpr std::size_t kTogether = 256;
    std::atomic<bool> changed = state.irradiance.size() != points;
    state.irradiance.resize(points);
    parallelRanges(
        (points + kTogether - 1) / kTogether, 4, [&](std::size_t first, std::size_t last) {
            bool differs = false;
            for (std::size_t k = first; k < last; ++k) {
                const std::size_t begin = k * kTogether,
                                  count = std::min(points - begin, kTogether);
                std::array<glm::vec3, kTogether> sum{};
                for (std::size_t l = 0; l < state.lights.size(); ++l) {
                    const glm::vec3 strength = state.summed[l].color * state.summed[l].strength;
                    const float* share = state.lights[l].share.data() + begin;
                    for (std::size_t i = 0; i < count; ++i)
                        sum[i] += glm::min(strength * share[i], kMaxIrradiance);
                }
                for (std::size_t i = 0; i < count; ++i) {
                    differs = differs || sum[i] != state.irradiance[begin + i];
                    state.irradiance[begin + i] = sum[i];
                }
            }
            if (differs)
                changed = true;
        });
    return changed;
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
    const std::uint64_t still = hashOccluders(trace.scene(), false),
                        moving = hashOccluders(trace.scene(), true);
    const bool stillSame = still == state.still, movingSame = moving == state.moving;
    if (stillSame && movingSame && lights == state.summed && state.irradiance.size() == points)
        return false;
    state.still = still;
    state.moving = moving;

    std::vector<DirectIrradiance::PerLight>& known = state.known;
    known.clear();
    std::swap(known, state.lights);
    const auto isUnused = [](const DirectIrradiance::PerLight& l) { return !l.share.empty(); };
    for (const Light& light : lights) {
        state.lights.push_back({unitLight(light), {}, {}});
        DirectIrradiance::PerLight& next = state.lights.back();
        const auto same = std::ranges::find_if(
            known, [&](const auto& l) { return l.light == next.light && isUnused(l); });
        if (stillSame && same != known.end()) {
            std::swap(next.share, same->share);
            std::swap(next.open, same->open);
        }
    }
    auto gone = known.begin(); // unused entries, whose memory is reused
    for (DirectIrradiance::PerLight& light : state.lights) {
        const bool isKnown = !light.share.empty();
        if (isKnown && movingSame)
            continue;
        const bool knowsStill = isKnown && !light.open.empty();
        gone = isKnown ? gone : std::find_if(gone, known.end(), isUnused);
        if (!isKnown && gone != known.end()) {
            std::swap(light.share, gone->share);
            std::swap(light.open, gone->open);
        }
        state.raysTraced += traceLight({positions, normals, each}, trace, knowsStill, light);
        ++state.lightsTraced;
    }
    std::swap(state.summed, lights);
    return sumLights(points, state);
}

} // namespace limn
