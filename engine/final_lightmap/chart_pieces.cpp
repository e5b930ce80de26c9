// SPDX-License-Identifier: MIT
#include "engine/final_lightmap/chart_pieces.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

namespace limn {

namespace {

/// Fewer samples on one side of a cut do not tell how much is left there.
constexpr std::ptrdiff_t kMinSamples = 64;
/// Cuts are worth it where they leave less than this part of the cost.
constexpr double kWorth = 0.9;

struct Rectangle {
    glm::vec2 lower, upper;
};

struct Cutter {
    double dim;
    const std::function<double(double)>& texels;
    std::vector<ChartCuts::Node>& nodes;
    std::vector<ResidualSums> pieces;

    double costOf(const ResidualSums& sums, const Rectangle& r) const;
    double cut(std::uint32_t node, std::span<ResidualSample> samples, const Rectangle& r);
};

double Cutter::costOf(const ResidualSums& sums, const Rectangle& r) const {
    const double squared = sums.relative(dim), perUnit = texels(squared);
    double border = 1; // texels per texel inside
    for (int k = 0; k < 2; ++k)
        border *= 1 + 1 / std::max(double(r.upper[k] - r.lower[k]) * perUnit, 0.125);
    return sums.area * std::sqrt(squared * border);
}

/// Fills a node and those below it. Returns their cost.
double Cutter::cut(std::uint32_t node, std::span<ResidualSample> samples, const Rectangle& r) {
    ResidualSums sums;
    for (const ResidualSample& s : samples)
        sums.add(s);
    const double whole = costOf(sums, r);
    const auto piece = std::uint32_t(pieces.size());
    if (std::ssize(samples) >= 2 * kMinSamples) {
        const glm::vec2 size = r.upper - r.lower;
        const int axis = size.x >= size.y ? 0 : 1;
        const auto isBelow = [axis](float position) {
            return [=](const ResidualSample& s) { return s.uv[axis] <= position; };
        };
        float position = (r.lower[axis] + r.upper[axis]) / 2;
        auto middle = std::partition(samples.begin(), samples.end(), isBelow(position));
        if (std::min(middle - samples.begin(), samples.end() - middle) < kMinSamples) {
            const auto median = samples.begin() + std::ptrdiff_t(samples.size() / 2);
            std::nth_element(samples.begin(), median, samples.end(),
                             [&](const auto& a, const auto& b) { return a.uv[axis] < b.uv[axis]; });
            position = median->uv[axis];
            middle = std::partition(samples.begin(), samples.end(), isBelow(position));
        }
        if (std::min(middle - samples.begin(), samples.end() - middle) >= kMinSamples) {
            Rectangle below = r, above = r;
            below.upper[axis] = above.lower[axis] = position;
            const auto child = std::uint32_t(nodes.size());
            nodes.resize(child + 2);
            const double cost = cut(child, {samples.begin(), middle}, below) +
                                cut(child + 1, {middle, samples.end()}, above);
            if (cost < kWorth * whole) {
                nodes[node] = {axis, position, child};
                return cost;
            }
            nodes.resize(child);
            pieces.resize(piece);
        }
    }
    nodes[node] = {-1, 0, piece};
    pieces.push_back(sums);
    return whole;
}

} // namespace

void ResidualSums::add(const ResidualSample& s) {
    area += double(s.area);
    light += double(s.area) * double(s.light);
    squared += double(s.area) * double(s.squared);
    floor += double(s.area) * double(s.floor);
    ++count;
}

double ResidualSums::relative(double dim) const {
    if (!(area > 0))
        return 0;
    const double mean = light / area;
    return (squared / (mean * mean + dim * dim) + floor) / area;
}

std::vector<ResidualSums> cutIntoPieces(std::vector<ResidualSample>& samples, glm::vec2 chartSize,
                                        double dim, const std::function<double(double)>& texels,
                                        ChartCuts& cuts) {
    cuts.nodes.assign(1, {});
    Cutter cutter{dim, texels, cuts.nodes, {}};
    cutter.cut(0, samples, {glm::vec2(0), chartSize});
    if (cutter.pieces.size() == 1)
        cuts.nodes.clear();
    return std::move(cutter.pieces);
}

} // namespace limn
