// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/gpu/tree_levels.h"

#include <gtest/gtest.h>

#include <random>

namespace limn::tree_levels_test {
namespace {

/// Joins two random nodes that have no parent yet, or the newest with the oldest where `chain`.
ClusterTree randomTree(std::uint32_t leaves, bool chain) {
    ClusterTree tree;
    tree.surfels = leaves;
    std::mt19937 rng(3);
    std::vector<std::uint32_t> roots(leaves);
    for (std::uint32_t i = 0; i < leaves; ++i)
        roots[i] = i;
    while (roots.size() > 1) {
        const auto take = [&](std::size_t i) {
            const std::uint32_t node = roots[i];
            roots.erase(roots.begin() + std::ptrdiff_t(i));
            return node;
        };
        tree.left.push_back(take(chain ? roots.size() - 1 : rng() % roots.size()));
        tree.right.push_back(take(chain ? 0 : rng() % roots.size()));
        tree.leftWeight.push_back(float(rng() % 100) / 100);
        roots.push_back(tree.leaves() + std::uint32_t(tree.left.size()) - 1);
    }
    return tree;
}

void expectChildrenFirst(const ClusterTree& tree, const TreeLevels& levels) {
    std::vector<bool> done(tree.size(), false);
    std::fill_n(done.begin(), tree.leaves(), true);
    std::size_t nodes = 0;
    for (std::uint32_t level = 0; level < levels.count(); ++level) {
        for (std::uint32_t k = levels.begin[level]; k < levels.begin[level + 1]; ++k, ++nodes) {
            const shared::GpuInnerNode& n = levels.nodes[k];
            EXPECT_TRUE(done[n.left] && done[n.right]) << "level " << level;
            const std::uint32_t inner = n.node - tree.leaves();
            EXPECT_EQ(n.left, tree.left[inner]);
            EXPECT_EQ(n.right, tree.right[inner]);
            EXPECT_EQ(n.leftWeight, tree.leftWeight[inner]);
        }
        for (std::uint32_t k = levels.begin[level]; k < levels.begin[level + 1]; ++k) {
            EXPECT_FALSE(done[levels.nodes[k].node]) << "level " << level;
            done[levels.nodes[k].node] = true;
        }
    }
    EXPECT_EQ(nodes, tree.left.size());
    EXPECT_EQ(std::count(done.begin(), done.end(), false), 0);
}

TEST(TreeLevels, HoldEveryInnerNodeOnceAfterItsChildren) {
    for (const std::uint32_t leaves : {1U, 2U, 3U, 500U}) {
        const ClusterTree tree = randomTree(leaves, false);
        expectChildrenFirst(tree, treeLevels(tree));
    }
}

TEST(TreeLevels, AreAsManyAsTheTreeIsHigh) {
    const ClusterTree chain = randomTree(20, true);
    const TreeLevels levels = treeLevels(chain);
    expectChildrenFirst(chain, levels);
    EXPECT_EQ(levels.count(), 19U);
    ClusterTree balanced;
    balanced.surfels = 4;
    balanced.left = {0, 2, 4};
    balanced.right = {1, 3, 5};
    balanced.leftWeight = {0.5f, 0.5f, 0.5f};
    EXPECT_EQ(treeLevels(balanced).begin, (std::vector<std::uint32_t>{0, 2, 3}));
}

} // namespace
} // namespace limn::tree_levels_test
