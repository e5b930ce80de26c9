// SPDX-License-Identifier: MIT
#include "engine/trace/direct_light.h"

#include "engine/trace/rectangle_shadow.h"

#include <algorithm>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

static glm::vec3 limited(glm::vec3 irradiance) {
    return glm::min(irradiance, glm::vec3(kMaxIrradiance));
}

glm::vec3 shadowedLight(const TraceScene& trace, const Light& light, const LitPoint& point,
                        std::uint32_t points, std::uint64_t& rays) {
    if (light.kind == LightKind::Rectangle) {
        if (!shines(light))
            return glm::vec3(0);
        const float e = shadowedIrradiance(trace, lightRectangle(light),
                                           RectangleReceiver::flat(point.position, point.normal),
                                           points, point.shift, rays);
        return limited(light.color * light.strength * e);
    }
    const LightSample sample = sampleLight(light, point.position);
    const float cosine = glm::dot(point.normal, sample.toLight);
    if (!(cosine > 0) || sample.irradiance == glm::vec3(0))
        return glm::vec3(0);
    ++rays;
    const Ray shadow{point.position, sample.toLight, 0, sample.distance};
    return trace.occluded(shadow) ? glm::vec3(0) : limited(sample.irradiance * cosine);
}

} // namespace limn
