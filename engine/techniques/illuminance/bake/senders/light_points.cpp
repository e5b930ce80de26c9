// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/senders/light_points.h"

#include "engine/core/parallel.h"
#include "engine/math/sampling.h"

#include <atomic>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace limn {

namespace {

/// The surface may lie this far above or below the disc [radii], and turn by 11 degrees:
/// the surfel's normal stands for all points.
constexpr float kDepth = 0.1f, kTurn = 0.98f;

/// Point k of the disc's in its plane, [-1, 1]^2. All points stand for equal areas. Vogel. A Better
/// Way to Construct the Sunflower Head. 1979
glm::vec2 inDisc(std::uint32_t k, float turn) {
    const float r = std::sqrt((float(k) + 0.5f) / float(kLightPoints));
    const float angle =
        2 * std::numbers::pi_v<float> * (float(k) * (std::numbers::phi_v<float> - 1) + turn);
    return {r * std::cos(angle), r * std::sin(angle)};
}

} // namespace

LightPoints findLightPoints(const TraceScene& trace, const Surfels& surfels,
                            const Progress& progress) {
    LightPoints result;
    result.at.resize(surfels.size() * kLightPoints);
    std::atomic<std::uint64_t> rays = 0;
    const Progress quiet{.report = {}, .cancel = progress.cancel};
    parallelRanges(surfels.size(), 256, quiet, "caches", [&](std::size_t begin, std::size_t end) {
        std::uint64_t traced = 0;
        for (std::size_t s = begin; s < end; ++s) {
            const glm::vec3 middle = surfels.position[s], n = surfels.normal[s];
            const glm::mat3 toWorld = basisAround(n);
            const float radius = std::sqrt(surfels.area[s] / std::numbers::pi_v<float>),
                        depth = kDepth * radius;
            const float turn = unitFloat(mixBits(std::uint32_t(s)));
            const glm::vec3 above = trace.clearOf(middle, n) + n * depth;
            for (std::uint32_t k = 0; k < kLightPoints; ++k, ++traced) {
                glm::vec3& point = result.at[s * kLightPoints + k];
                point = middle;
                const glm::vec3 over = above + toWorld * glm::vec3(radius * inDisc(k, turn), 0);
                if (trace.blocked(above, over, TraceMask::Static))
                    continue;
                ++traced;
                const Hit hit = trace.closestHit({over, -n, 0, 3 * depth}, TraceMask::Static);
                if (hit && hit.instance == surfels.instance[s] &&
                    std::abs(glm::dot(hit.geometricNormal, n)) > kTurn)
                    point = hit.position;
            }
        }
        rays += traced;
    });
    result.rays = rays;
    return result;
}

} // namespace limn
