// SPDX-License-Identifier: MIT
#include "engine/trace/rectangle_shadow.h"

#include "engine/math/sampling.h"

#include <glm/common.hpp>

namespace limn {

glm::vec2 pointOnLight(std::uint32_t i, std::uint32_t points, glm::vec2 shift) {
    constexpr float kInset = 1e-3f;
    const glm::vec2 hammersley((float(i) + 0.5f) / float(points), radicalInverse(i, 2));
    return glm::mix(glm::vec2(kInset), glm::vec2(1 - kInset), glm::fract(hammersley + shift));
}

float shadowedIrradiance(const TraceScene& trace, const LightRectangle& rectangle, glm::vec3 p,
                         glm::vec3 n, std::uint32_t points, glm::vec2 shift, std::uint64_t& rays) {
    const float whole = rectangleIrradiance(rectangle, p, n);
    if (!(whole > 0))
        return 0;
    const glm::vec3 origin = trace.clearOf(p, n);
    const SphericalRectangle sphere(rectangle, p);
    double sum = 0, seen = 0;
    for (std::uint32_t i = 0; i < points; ++i) {
        const glm::vec3 onLight = sphere.at(pointOnLight(i, points, shift));
        const double share = double(glm::dot(glm::normalize(onLight - p), n));
        if (!(share > 0))
            continue;
        ++rays;
        sum += share;
        if (!trace.blocked(origin, trace.clearOf(onLight, rectangle.normal)))
            seen += share;
    }
    return sum > 0 ? whole * float(seen / sum) : 0; // none: only a sliver is above the horizon
}

} // namespace limn
