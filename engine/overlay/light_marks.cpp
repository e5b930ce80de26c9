// SPDX-License-Identifier: MIT
#include "engine/overlay/light_marks.h"

#include "engine/math/luminance.h"
#include "engine/overlay/palette.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/common.hpp>

namespace limn {

/// With this ratio of radius to distance, the dots of a sphere touch each other.
static float dotSize(const DirectionSet& directions) {
    return std::sqrt(4 / float(directions.count));
}

glm::vec3 lightColor(glm::vec3 light, float middle) {
    return encodeSrgb(glm::clamp(light / (luminance(light) + middle), 0.f, 1.f));
}

std::vector<OverlayLegend::Entry> lightColorEntries(float middle, const char* unit) {
    std::vector<OverlayLegend::Entry> entries;
    for (const float times : {0.f, 0.1f, 0.3f, 1.f, 3.f, 10.f})
        entries.push_back({packColor(lightColor(glm::vec3(times * middle), middle)),
                           fmt::format("{:.3g} {}", times * middle, unit)});
    return entries;
}

glm::vec3 lightHue(glm::vec3 light) {
    const glm::vec3 positive = glm::max(light, 0.f);
    const float brightest = std::max({positive.x, positive.y, positive.z});
    const bool negative = luminance(light) < 0 || !(brightest > 0);
    return negative ? kNegativeLight : encodeSrgb(positive / brightest);
}

void addLobe(const LobeShape& lobe, const DirectionSet& directions, std::span<const float> value,
             std::span<const glm::vec3> color, std::vector<OverlayMark>& marks) {
    float maximum = 0;
    for (const float v : value)
        maximum = std::max(maximum, std::abs(v));
    if (!(maximum > 0))
        return;
    const float spread = dotSize(directions);
    for (std::uint32_t k = 0; k < directions.count; ++k) {
        const float r = std::abs(value[k]) / maximum * lobe.reach;
        OverlayMark m;
        m.position = lobe.position + directions[k] * r;
        m.radius = spread * std::max(r, 0.05f * lobe.reach);
        m.color = packColor(color[k] * (0.7f + 0.3f * directions[k].y));
        marks.push_back(m);
    }
}

void addBall(glm::vec3 position, float radius, const DirectionSet& directions,
             std::span<const glm::vec3> color, std::vector<OverlayMark>& marks) {
    const float spread = dotSize(directions);
    for (std::uint32_t k = 0; k < directions.count; ++k) {
        OverlayMark m;
        m.position = position + directions[k] * radius;
        m.radius = spread * radius;
        m.color = packColor(color[k]);
        marks.push_back(m);
    }
}

} // namespace limn
