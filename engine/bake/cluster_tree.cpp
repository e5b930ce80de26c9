// SPDX-License-Identifier: MIT
#include "engine/bake/cluster_tree.h"

#include "engine/bake/median_split.h"
#include "engine/core/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr float kNormalWeight = 0.1f; // C_n of the paper

constexpr std::uint32_t kSkyBands = 16, kSkySectors = 16;
static_assert(kSkyBands * kSkySectors == kSkyCells);

using Point6 = std::array<float, 6>;

Point6 clusterCoordinates(glm::vec3 position, glm::vec3 normal, float extent) {
    const glm::vec3 x = position / extent, m = normal * std::sqrt(kNormalWeight / 2);
    return {x.x, x.y, x.z, m.x, m.y, m.z};
}

/// Inner nodes of a tree over `count` items. Child < count: an item; else count + index of an inner
/// node. Children come before parents. Empty for a single item.
struct LocalTree {
    std::vector<std::uint32_t> left, right;
};

class MedianSplit {
public:
    explicit MedianSplit(const std::vector<Point6>& points)
        : m_points(points), m_order(points.size()) {
        std::iota(m_order.begin(), m_order.end(), 0U);
        if (points.size() > 1)
            split(0, std::uint32_t(points.size()));
    }
    LocalTree tree;

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

    const std::vector<Point6>& m_points;
    std::vector<std::uint32_t> m_order;
};

LocalTree meshTree(const MeshSurfels& surfels) {
    glm::vec3 lower(1e30f), upper(-1e30f);
    for (const glm::vec3 p : surfels.position) {
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
    }
    const float extent = std::max(glm::length(upper - lower), 1e-20f);
    std::vector<Point6> points(surfels.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        points[i] = clusterCoordinates(surfels.position[i] - lower, surfels.normal[i], extent);
    return MedianSplit(points).tree;
}

/// A subtree already in the ClusterTree, seen as one item of the tree above it.
struct Root {
    std::uint32_t node;
    glm::vec3 centre, normal;
};

/// Appends `local`, whose items are the nodes `item(i)`; returns its root node.
template <class Item>
std::uint32_t append(const LocalTree& local, std::uint32_t items, Item item, ClusterTree& tree) {
    const std::uint32_t base = tree.size();
    const auto node = [&](std::uint32_t i) { return i < items ? item(i) : base + (i - items); };
    for (std::size_t k = 0; k < local.left.size(); ++k) {
        tree.left.push_back(node(local.left[k]));
        tree.right.push_back(node(local.right[k]));
    }
    return local.left.empty() ? item(0) : tree.size() - 1;
}

Root instanceRoot(const Surfels& surfels, std::uint32_t begin, std::uint32_t end,
                  std::uint32_t node) {
    glm::vec3 centre{0}, normal{0};
    float area = 0;
    for (std::uint32_t i = begin; i < end; ++i) {
        centre += surfels.position[i] * surfels.area[i];
        normal += surfels.normal[i] * surfels.area[i];
        area += surfels.area[i];
    }
    return {node, centre / area, normal / area};
}

/// Joins the roots of the instances and, last, that of the sky.
void joinRoots(const std::vector<Root>& roots, const Bounds& bounds, std::uint32_t sky,
               ClusterTree& tree) {
    if (!roots.empty()) {
        const float extent = std::max(glm::length(bounds.size()), 1e-20f);
        std::vector<Point6> points;
        for (const Root& r : roots)
            points.push_back(clusterCoordinates(r.centre - bounds.lower, r.normal, extent));
        const std::uint32_t top = append(
            MedianSplit(points).tree, std::uint32_t(roots.size()),
            [&](std::uint32_t i) { return roots[i].node; }, tree);
        tree.left.push_back(top);
        tree.right.push_back(sky);
    }
}

void fillWeightsAndParents(const Surfels& surfels, ClusterTree& tree) {
    // Sky cells have no area. Any equal weight serves: nothing but the root joins them with
    // surfels.
    std::vector<double> area(tree.size(), 1.0);
    std::copy(surfels.area.begin(), surfels.area.end(), area.begin());
    tree.parent.assign(tree.size(), ~0U);
    for (std::size_t k = 0; k < tree.left.size(); ++k) {
        const std::uint32_t l = tree.left[k], r = tree.right[k],
                            node = tree.leaves() + std::uint32_t(k);
        area[node] = area[l] + area[r];
        tree.leftWeight.push_back(float(area[l] / area[node]));
        tree.parent[l] = tree.parent[r] = node;
    }
}

} // namespace

std::uint32_t skyCellOf(glm::vec3 d) {
    const float turn = std::atan2(d.z, d.x) / (2 * std::numbers::pi_v<float>)+0.5f;
    const float height = (d.y + 1) / 2; // equal heights are equal solid angles
    const auto cell = [](float x, std::uint32_t n) {
        return std::min(std::uint32_t(std::max(x, 0.f) * float(n)), n - 1);
    };
    return cell(height, kSkyBands) * kSkySectors + cell(turn, kSkySectors);
}

ClusterTree buildClusterTree(const Scene& scene, const SurfelSet& set) {
    ClusterTree tree;
    tree.surfels = std::uint32_t(set.surfels.size());
    tree.skyCells = kSkyCells;
    std::vector<LocalTree> meshes(set.meshes.size());
    parallelRanges(meshes.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t m = begin; m < end; ++m)
            if (set.meshes[m].size() > 0)
                meshes[m] = meshTree(set.meshes[m]);
    });
    std::vector<Root> roots;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const std::uint32_t begin = set.instanceBegin[i], end = set.instanceBegin[i + 1];
        if (begin == end)
            continue;
        const std::uint32_t node = append(
            meshes[scene.instances[i].mesh], end - begin,
            [&](std::uint32_t k) { return begin + k; }, tree);
        roots.push_back(instanceRoot(set.surfels, begin, end, node));
    }
    std::vector<Point6> sky;
    for (std::uint32_t c = 0; c < kSkyCells; ++c) {
        const float height = (float(c / kSkySectors) + 0.5f) / kSkyBands * 2 - 1;
        const float angle =
            ((float(c % kSkySectors) + 0.5f) / kSkySectors - 0.5f) * 2 * std::numbers::pi_v<float>;
        const float r = std::sqrt(1 - height * height);
        tree.skyDirection.emplace_back(r * std::cos(angle), height, r * std::sin(angle));
        sky.push_back(clusterCoordinates(tree.skyDirection.back(), glm::vec3(0), 1));
    }
    const std::uint32_t skyRoot = append(
        MedianSplit(sky).tree, kSkyCells, [&](std::uint32_t c) { return tree.surfels + c; }, tree);
    joinRoots(roots, scene.bounds, skyRoot, tree);
    fillWeightsAndParents(set.surfels, tree);
    return tree;
}

} // namespace limn
