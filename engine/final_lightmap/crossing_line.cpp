// SPDX-License-Identifier: MIT
#include "engine/final_lightmap/crossing_line.h"

#include "engine/math/sampling.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <set>

#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr std::size_t kMinCrossings = 8;
constexpr std::uint32_t kTries = 64;
constexpr float kOnLine = 0.05f; ///< largest distance of crossings from their line [texels]
/// Least part of a line that has crossings, in steps of texels.
constexpr double kCovered = 0.7;
/// Lines closer than this to the border of a part cut nothing off [texels].
constexpr float kInside = 0.1f;

struct Line {
    glm::vec2 across{0};
    float position = 0;

    float beyond(glm::vec2 p) const { return glm::dot(across, p) - position; }
    float along(glm::vec2 p) const { return across.x * p.y - across.y * p.x; }
};

Line through(glm::vec2 a, glm::vec2 b) {
    const glm::vec2 way = glm::normalize(b - a), across(-way.y, way.x);
    return {across, glm::dot(across, a)};
}

/// Least texel width among the samples.
float narrowest(std::span<const ResidualSample> samples) {
    float width = std::numeric_limits<float>::max();
    for (const ResidualSample& s : samples)
        width = std::min(width, s.width);
    return width;
}

/// The part of the line within the samples that has crossings, or 0 where all samples are on one
/// side of it.
double coverage(const Line& line, const std::vector<glm::vec2>& crossings,
                std::span<const ResidualSample> samples, float near) {
    float below = 0, above = 0, step = 0;
    for (const ResidualSample& s : samples) {
        const float d = line.beyond(s.uv) / s.width;
        below = std::max(below, -d);
        above = std::max(above, d);
        if (std::abs(d) < 1)
            step = std::max(step, s.width);
    }
    if (below < kInside || above < kInside || !(step > 0))
        return 0;
    std::set<int> met, whole;
    for (const ResidualSample& s : samples)
        if (std::abs(line.beyond(s.uv)) < s.width)
            whole.insert(int(std::floor(line.along(s.uv) / step)));
    for (const glm::vec2 p : crossings)
        if (std::abs(line.beyond(p)) < near)
            met.insert(int(std::floor(line.along(p) / step)));
    return double(met.size()) / double(whole.size());
}

} // namespace

std::optional<ChartCuts::Node> crossingLine(std::vector<glm::vec2>& crossings,
                                            std::span<const ResidualSample> samples) {
    if (crossings.size() < kMinCrossings || samples.empty())
        return std::nullopt;
    const float width = narrowest(samples), near = kOnLine * width;
    Line best;
    std::ptrdiff_t found = std::ptrdiff_t(kMinCrossings) - 1;
    for (std::uint32_t k = 0; k < kTries; ++k) {
        const auto count = std::uint32_t(crossings.size());
        const glm::vec2 a = crossings[mixBits(2 * k) % count],
                        b = crossings[mixBits(2 * k + 1) % count];
        if (glm::distance(a, b) < width)
            continue;
        const Line line = through(a, b);
        const std::ptrdiff_t onLine = std::ranges::count_if(
            crossings, [&](glm::vec2 p) { return std::abs(line.beyond(p)) < near; });
        if (onLine > found) {
            found = onLine;
            best = line;
        }
    }
    if (best.across == glm::vec2(0) || coverage(best, crossings, samples, near) < kCovered)
        return std::nullopt;
    std::vector<float> positions; // of those near the line; their median lies best
    for (const glm::vec2 p : crossings)
        if (std::abs(best.beyond(p)) < near)
            positions.push_back(glm::dot(best.across, p));
    const auto median = positions.begin() + std::ssize(positions) / 2;
    std::ranges::nth_element(positions, median);
    best.position = *median;
    std::erase_if(crossings, [&](glm::vec2 p) { return std::abs(best.beyond(p)) < 2 * near; });
    ChartCuts::Node cut;
    cut.across = best.across;
    cut.position = best.position;
    return cut;
}

} // namespace limn
