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

float shadowedIrradiance(const TraceScene& trace, const LightRectangle& rectangle,
                         const RectangleReceiver& receiver, std::uint32_t points, glm::vec2 shift,
                         std::uint64_t& rays) {
    const glm::vec3 p = receiver.position;
    const float whole = rectangleIrradiance(rectangle, p, receiver.normal);
    if (!(whole > 0))
        return 0;
    const glm::vec3 origin = trace.clearOf(p, receiver.geometricNormal);
    const SphericalRectangle sphere(rectangle, p);
    double sum = 0, seen = 0;
    for (std::uint32_t i = 0; i < points; ++i) {
        const glm::vec3 onLight = sphere.at(pointOnLight(i, points, shift));
        const glm::vec3 toLight = glm::normalize(onLight - p);
        const double share = double(glm::dot(toLight, receiver.normal));
        if (!(share > 0))
            continue;
        sum += share;
        if (!(glm::dot(toLight, receiver.geometricNormal) > 0))
            continue;
        ++rays;
        if (!trace.blocked(origin, trace.clearOf(onLight, rectangle.normal)))
            seen += share;
    }
    return sum > 0 ? whole * float(seen / sum) : 0; // none: only a sliver is above the horizon
}

} // namespace limn
