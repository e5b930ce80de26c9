// SPDX-License-Identifier: MIT
#include "engine/final_lightmap/chart_pieces.h"

#include "engine/final_lightmap/crossing_line.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <glm/common.hpp>

namespace limn {

namespace {

/// Fewer samples on one side of a cut do not tell how much is left there.
constexpr std::ptrdiff_t kMinSamples = 64;
/// Cuts are worth it where they leave less than this part of the cost.
constexpr double kWorth = 0.9;

using Samples = std::span<ResidualSample>;

/// The rectangle around samples, which lie in the middles of what they stand for.
struct Rectangle {
    glm::vec2 lower{1e30f}, upper{-1e30f};

    explicit Rectangle(Samples samples) {
        for (const ResidualSample& s : samples) {
            lower = glm::min(lower, s.uv);
            upper = glm::max(upper, s.uv);
        }
    }
    glm::vec2 size() const { return upper - lower; }
};

/// Moves the samples below a cut to the front. Returns the first above.
Samples::iterator divide(Samples samples, const ChartCuts::Node& cut) {
    return std::partition(samples.begin(), samples.end(),
                          [&](const ResidualSample& s) { return !cut.isAbove(s.uv); });
}

struct Cutter {
    double dim;
    const PieceDensity& density;
    std::vector<ChartCuts::Node>& nodes;
    std::vector<ResidualSums> pieces;
    std::uint32_t parts = 0;

    ResidualSums sumsOf(Samples samples, glm::vec2 size) const;
    double costOf(const ResidualSums& sums, glm::vec2 size) const;
    std::uint32_t addChildren(std::uint32_t node, ChartCuts::Node cut);
    double halve(std::uint32_t node, Samples samples);
    void cut(std::uint32_t node, Samples samples, std::vector<glm::vec2> crossings);
};

ResidualSums Cutter::sumsOf(Samples samples, glm::vec2 size) const {
    ResidualSums sums = sumOf(samples);
    const double perUnit = density.perUnit;
    sums.rectangle = std::max(double(size.x) * double(size.y) * perUnit * perUnit, sums.area);
    return sums;
}

double Cutter::costOf(const ResidualSums& sums, glm::vec2 size) const {
    const double squared = sums.relativeInRectangle(dim),
                 perUnit = density.perUnit * density.factor(squared);
    double border = 1; // texels per texel inside
    for (int k = 0; k < 2; ++k)
        border *= 1 + 1 / std::max(double(size[k]) * perUnit, 0.125);
    return sums.rectangle * std::sqrt(squared * border);
}

std::uint32_t Cutter::addChildren(std::uint32_t node, ChartCuts::Node cut) {
    cut.child = std::uint32_t(nodes.size());
    nodes.resize(nodes.size() + 2);
    nodes[node] = cut;
    return cut.child;
}

/// Fills a node and those below it. Returns their cost.
double Cutter::halve(std::uint32_t node, Samples samples) {
    const Rectangle around(samples);
    const glm::vec2 size = around.size();
    const ResidualSums sums = sumsOf(samples, size);
    const double whole = costOf(sums, size);
    const auto firstPiece = std::uint32_t(pieces.size());
    const std::size_t firstNode = nodes.size();
    if (std::ssize(samples) >= 2 * kMinSamples) {
        const int axis = size.x >= size.y ? 0 : 1;
        ChartCuts::Node cut;
        cut.across[axis] = 1;
        cut.position = (around.lower[axis] + around.upper[axis]) / 2;
        auto middle = divide(samples, cut);
        if (std::min(middle - samples.begin(), samples.end() - middle) < kMinSamples) {
            const auto median = samples.begin() + std::ssize(samples) / 2;
            std::nth_element(samples.begin(), median, samples.end(),
                             [&](const auto& a, const auto& b) { return a.uv[axis] < b.uv[axis]; });
            cut.position = median->uv[axis];
            middle = divide(samples, cut);
        }
        if (std::min(middle - samples.begin(), samples.end() - middle) >= kMinSamples) {
            const std::uint32_t child = addChildren(node, cut);
            const double cost =
                halve(child, {samples.begin(), middle}) + halve(child + 1, {middle, samples.end()});
            if (cost < kWorth * whole)
                return cost;
            nodes.resize(firstNode);
            pieces.resize(firstPiece);
        }
    }
    nodes[node] = {};
    nodes[node].child = firstPiece;
    pieces.push_back(sums);
    pieces.back().part = parts;
    return whole;
}

/// Cuts along crossings first.
void Cutter::cut(std::uint32_t node, Samples samples, std::vector<glm::vec2> crossings) {
    const std::optional<ChartCuts::Node> line = crossingLine(crossings, samples);
    if (!line) {
        halve(node, samples);
        ++parts;
        return;
    }
    const std::uint32_t child = addChildren(node, *line);
    const auto middle = divide(samples, *line);
    const auto above = std::partition(crossings.begin(), crossings.end(),
                                      [&](glm::vec2 p) { return !line->isAbove(p); });
    cut(child, {samples.begin(), middle}, {crossings.begin(), above});
    cut(child + 1, {middle, samples.end()}, {above, crossings.end()});
}

} // namespace

ResidualSums sumOf(std::span<const ResidualSample> samples) {
    ResidualSums sums;
    for (const ResidualSample& s : samples) {
        sums.area += double(s.area);
        sums.light += double(s.area) * double(s.light);
        sums.squared += double(s.area) * double(s.squared);
        sums.floor += double(s.area) * double(s.floor);
    }
    return sums;
}

double ResidualSums::relative(double dim) const {
    if (!(area > 0))
        return 0;
    const double mean = light / area;
    return (squared / (mean * mean + dim * dim) + floor) / area;
}

double ResidualSums::relativeInRectangle(double dim) const {
    return rectangle > 0 ? relative(dim) * area / rectangle : relative(dim);
}

std::vector<ResidualSums> cutIntoPieces(std::vector<ResidualSample>& samples,
                                        const std::vector<glm::vec2>& crossings, double dim,
                                        const PieceDensity& density, ChartCuts& cuts) {
    cuts.nodes.assign(1, {});
    Cutter cutter{dim, density, cuts.nodes, {}};
    cutter.cut(0, samples, crossings);
    if (cutter.pieces.size() == 1)
        cuts.nodes.clear();
    return std::move(cutter.pieces);
}

} // namespace limn
