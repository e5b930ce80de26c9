// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/senders/clustering.h"

#include "engine/math/median_split.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace limn {

namespace {

class MedianTree {
public:
    explicit MedianTree(const std::vector<std::array<float, 6>>& points)
        : m_points(points), m_order(points.size()) {
        std::iota(m_order.begin(), m_order.end(), 0U);
        if (points.size() > 1)
            split(0, std::uint32_t(points.size()));
    }
    MergeTree tree;

private:
    std::uint32_t split(std::uint32_t begin, std::uint32_t end) {
        if (end - begin == 1)
            return m_order[begin];
        const std::uint32_t middle = begin + (end - begin) / 2;
        medianSplit<6>(std::span(m_order).subspan(begin, end - begin),
                       [&](std::uint32_t i, std::size_t k) { return m_points[i][k]; });
        const std::uint32_t l = split(begin, middle), r = split(middle, end);
        tree.left.push_back(l);
        tree.right.push_back(r);
        return std::uint32_t(m_points.size() + tree.left.size() - 1);
    }

    const std::vector<std::array<float, 6>>& m_points;
    std::vector<std::uint32_t> m_order;
};

} // namespace

std::array<float, 6> metricCoordinates(const ClusterItem& item, const ClusterMetric& metric) {
    const glm::vec3 x = item.position / metric.extent,
                    m = item.normal * std::sqrt(metric.normalWeight / 2);
    std::array<float, 6> scaled = {x.x, x.y, x.z, m.x, m.y, m.z};
    for (float& v : scaled)
        v = std::isfinite(v) ? std::clamp(v, -1e9f, 1e9f) : 0;
    return scaled;
}

MergeTree clusterByMedian(std::span<const ClusterItem> items, const ClusterMetric& metric) {
    std::vector<std::array<float, 6>> points;
    points.reserve(items.size());
    for (const ClusterItem& item : items)
        points.push_back(metricCoordinates(item, metric));
    return MedianTree(points).tree;
}

MergeTree clusterItems(Clustering how, std::span<const ClusterItem> items,
                       const ClusterMetric& metric, const Progress& progress) {
    switch (how) {
    case Clustering::Agglomerative:
        return clusterAgglomerative(items, metric, progress);
    case Clustering::KdTree:
        return clusterByMedian(items, metric);
    }
    return {};
}

} // namespace limn
