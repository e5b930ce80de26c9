// SPDX-License-Identifier: MIT
#include "engine/final_lightmap/straight_charts.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr std::size_t kMaxEdges = 16; ///< of a chart, the longest ones
/// A rectangle is worth a turn where it has less than this part of the area.
constexpr float kWorth = 0.95f;

struct Chart {
    std::vector<std::uint32_t> vertices;
    std::vector<std::pair<float, glm::vec2>> edges; ///< squared length, vector; the longest ones
};

/// The vector in a plane whose x axis runs along `axis`, unit.
glm::vec2 turned(glm::vec2 v, glm::vec2 axis) {
    return {glm::dot(v, axis), axis.x * v.y - axis.y * v.x};
}

struct Box {
    glm::vec2 lower{1e30f}, upper{-1e30f};
    float area() const { return (upper.x - lower.x) * (upper.y - lower.y); }
};

Box boxAlong(const MeshCharts& charts, const Chart& chart, glm::vec2 axis) {
    Box box;
    for (const std::uint32_t v : chart.vertices) {
        const glm::vec2 p = turned(charts.chartUv[v], axis);
        box.lower = glm::min(box.lower, p);
        box.upper = glm::max(box.upper, p);
    }
    return box;
}

void addEdge(Chart& chart, glm::vec2 way) {
    const auto isLonger = [](const auto& a, const auto& b) { return a.first > b.first; };
    chart.edges.emplace_back(glm::dot(way, way), way);
    std::ranges::push_heap(chart.edges, isLonger); // the shortest in front
    if (chart.edges.size() > kMaxEdges) {
        std::ranges::pop_heap(chart.edges, isLonger);
        chart.edges.pop_back();
    }
}

} // namespace

void straightenCharts(MeshCharts& charts) {
    std::vector<Chart> all(charts.chartSize.size());
    std::vector<bool> isKnown(charts.chartUv.size(), false);
    for (std::size_t i = 0; i < charts.indices.size(); ++i) {
        Chart& chart = all[charts.chartOfTriangle[i / 3]];
        const std::uint32_t a = charts.indices[i], b = charts.indices[i % 3 == 2 ? i - 2 : i + 1];
        addEdge(chart, charts.chartUv[b] - charts.chartUv[a]);
        if (!isKnown[a])
            chart.vertices.push_back(a);
        isKnown[a] = true;
    }
    for (std::size_t c = 0; c < all.size(); ++c) {
        glm::vec2 best(1, 0);
        Box box = boxAlong(charts, all[c], best);
        for (const auto& [squared, way] : all[c].edges) {
            if (!(squared > 0))
                continue;
            const glm::vec2 axis = way / std::sqrt(squared);
            const Box other = boxAlong(charts, all[c], axis);
            if (other.area() < kWorth * box.area()) {
                box = other;
                best = axis;
            }
        }
        if (best == glm::vec2(1, 0))
            continue;
        for (const std::uint32_t v : all[c].vertices)
            charts.chartUv[v] = glm::max(turned(charts.chartUv[v], best) - box.lower, glm::vec2(0));
        charts.chartSize[c] = box.upper - box.lower;
    }
}

} // namespace limn
