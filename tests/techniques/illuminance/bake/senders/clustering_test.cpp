// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/senders/clustering.h"

#include "engine/core/parallel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <set>

#include <glm/geometric.hpp>

namespace limn::clustering_test {
namespace {

std::vector<ClusterItem> randomItems(std::size_t count, unsigned seed) {
    std::mt19937 rng(seed);
    std::uniform_real_distribution<float> unit(-1, 1);
    std::vector<ClusterItem> items;
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 x(unit(rng), unit(rng), unit(rng));
        const glm::vec3 n(unit(rng), unit(rng), 1.1f + unit(rng));
        items.push_back({x, glm::normalize(n), i % 3 == 0 ? 1 + std::abs(unit(rng)) : 1});
    }
    return items;
}

/// The leaves below each inner node.
std::set<std::set<std::uint32_t>> clustersOf(const MergeTree& tree, std::size_t count) {
    std::vector<std::set<std::uint32_t>> below(count + tree.left.size());
    for (std::uint32_t i = 0; i < count; ++i)
        below[i] = {i};
    for (std::size_t k = 0; k < tree.left.size(); ++k)
        for (const std::uint32_t child : {tree.left[k], tree.right[k]})
            below[count + k].insert(below[child].begin(), below[child].end());
    return {below.begin() + std::ptrdiff_t(count), below.end()};
}

/// By definition: all pairs, in doubles.
MergeTree searchAllPairs(const std::vector<ClusterItem>& items, const ClusterMetric& metric) {
    struct Sum {
        glm::dvec3 x, m;
        double area;
        std::uint32_t number;
    };
    std::vector<Sum> left;
    for (std::uint32_t i = 0; i < items.size(); ++i)
        left.push_back({items[i].position, items[i].normal, items[i].area, i});
    MergeTree tree;
    while (left.size() > 1) {
        double least = 1e30;
        std::size_t a = 0, b = 0;
        for (std::size_t i = 0; i < left.size(); ++i)
            for (std::size_t j = i + 1; j < left.size(); ++j) {
                const glm::dvec3 x = (left[i].x - left[j].x) / double(metric.extent);
                const double d =
                    glm::dot(x, x) +
                    double(metric.normalWeight) * (1 - glm::dot(left[i].m, left[j].m)) +
                    double(metric.balanceWeight) * std::abs(left[i].area - left[j].area) /
                        std::max(left[i].area, left[j].area);
                if (d < least)
                    least = d, a = i, b = j;
            }
        tree.left.push_back(left[a].number);
        tree.right.push_back(left[b].number);
        const double area = left[a].area + left[b].area;
        const auto mean = [&](glm::dvec3 p, glm::dvec3 q) {
            return (p * left[a].area + q * left[b].area) / area;
        };
        left[a] = {mean(left[a].x, left[b].x), mean(left[a].m, left[b].m), area,
                   std::uint32_t(items.size() + tree.left.size() - 1)};
        left.erase(left.begin() + std::ptrdiff_t(b));
    }
    return tree;
}

/// Edges from the root to the furthest item; checks that children come before parents.
std::uint32_t depthOf(const MergeTree& tree, std::size_t count) {
    std::vector<std::uint32_t> depth(count + tree.left.size());
    for (std::size_t k = tree.left.size(); k-- > 0;)
        for (const std::uint32_t child : {tree.left[k], tree.right[k]}) {
            EXPECT_LT(child, count + k);
            depth[child] = depth[count + k] + 1;
        }
    return *std::max_element(depth.begin(), depth.end());
}

TEST(Agglomerative, ChoosesWhatASearchOfAllPairsChooses) {
    for (const ClusterMetric metric : {ClusterMetric{2, 0.1f, 0.02f}, ClusterMetric{2, 0, 0},
                                       ClusterMetric{0.5f, 1, 0}, ClusterMetric{8, 0.1f, 1}}) {
        const std::vector<ClusterItem> items = randomItems(300, 5);
        const MergeTree tree = clusterAgglomerative(items, metric);
        EXPECT_EQ(clustersOf(tree, 300), clustersOf(searchAllPairs(items, metric), 300));
    }
}

TEST(Agglomerative, SubtreesStandTogetherAfterTheirChildren) {
    const MergeTree tree = clusterAgglomerative(randomItems(500, 2), {});
    ASSERT_EQ(tree.left.size(), 499U);
    depthOf(tree, 500);
    std::vector<std::uint32_t> size(tree.left.size(), 1), first(size.size());
    for (std::uint32_t k = 0; k < size.size(); ++k) {
        first[k] = k;
        for (const std::uint32_t child : {tree.left[k], tree.right[k]})
            if (child >= 500) {
                size[k] += size[child - 500];
                first[k] = std::min(first[k], first[child - 500]);
            }
        EXPECT_EQ(first[k] + size[k], k + 1);
    }
}

TEST(Agglomerative, IsTheSameAtAnyNumberOfThreads) {
    const std::vector<ClusterItem> items = randomItems(5000, 3);
    const MergeTree many = clusterAgglomerative(items, {});
    const ThreadLimit limit(1);
    EXPECT_EQ(clusterAgglomerative(items, {}), many);
}

TEST(Clustering, ScaleDoesNotMatter) {
    const std::vector<ClusterItem> items = randomItems(1000, 4);
    for (const Clustering how : {Clustering::Agglomerative, Clustering::KdTree}) {
        const MergeTree tree = clusterItems(how, items, {2});
        for (const float scale : {1e-3f, 1e4f, 0x1p-60f, 0x1p60f}) {
            std::vector<ClusterItem> scaled = items;
            for (ClusterItem& item : scaled)
                item.position *= scale;
            EXPECT_EQ(clusterItems(how, scaled, {2 * scale}), tree) << scale;
        }
    }
}

TEST(Clustering, FewItems) {
    for (const Clustering how : {Clustering::Agglomerative, Clustering::KdTree}) {
        EXPECT_TRUE(clusterItems(how, {}, {}).left.empty());
        EXPECT_TRUE(clusterItems(how, randomItems(1, 1), {}).left.empty());
        EXPECT_EQ(clusterItems(how, randomItems(2, 1), {}).left.size(), 1U);
    }
}

TEST(Clustering, ThousandsOfPointsAtOneSpotHalve) {
    const std::vector<ClusterItem> items(1 << 14, {{1, 2, 3}, {0, 1, 0}, 1});
    for (const Clustering how : {Clustering::Agglomerative, Clustering::KdTree})
        EXPECT_EQ(depthOf(clusterItems(how, items, {1e-20f}), items.size()), 14U);
}

TEST(Agglomerative, SpotsZeroNormalsAndExtremeAreasStaySafe) {
    std::vector<ClusterItem> items = randomItems(3000, 6);
    for (std::size_t i = 0; i < 1000; ++i)
        items[i].position = glm::vec3(float(i % 3));
    for (std::size_t i = 0; i < items.size(); i += 7) {
        items[i].normal = glm::vec3(0);
        items[i].area = i % 2 ? 1e-38f : 1e38f;
    }
    items[5].position = glm::vec3(3e38f, -3e38f, std::nanf(""));
    items[6].position = glm::vec3(-3e38f);
    const MergeTree tree = clusterAgglomerative(items, {});
    EXPECT_EQ(tree.left.size(), 2999U);
    depthOf(tree, 3000);
}

} // namespace
} // namespace limn::clustering_test
