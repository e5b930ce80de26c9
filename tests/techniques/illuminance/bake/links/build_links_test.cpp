// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/links/build_links.h"

#include "engine/techniques/illuminance/bake/cut/refinement_priority.h"
#include "engine/techniques/illuminance/format/link_storage.h"
#include "tests/techniques/illuminance/bake/traced_room.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace limn::cut_test {
namespace {

using namespace simple;

Scene roomWithBlock() {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(box(glm::vec3(0), glm::vec3(2, 2, 3), true));
    b.add(box(glm::vec3(0.6f, 0.2f, 0.6f), glm::vec3(1, 1, 1.2f), false));
    return b.build();
}

/// A bake up to its links.
struct Fixture : TracedRoom {
    TrainingLight training;

    Fixture() : TracedRoom(roomWithBlock()) {
        const std::vector<float> importance =
            leafImportance(set.surfels, hits, points, caches, tree);
        weighByImportance(importance, tree);
        training = trainingLight(scene, set.surfels, tree, importance,
                                 traceTraining(trace, set.surfels, nullptr, {}));
    }
    Caches cut(CutCriterion criterion, std::uint32_t links) const {
        Caches result = caches;
        buildLinks(set.surfels, tree, hits, points, training, {criterion, links, 3}, {}, result);
        return result;
    }
};

const Fixture& fixture() {
    static const Fixture f;
    return f;
}

bool isBelow(const ClusterTree& tree, std::uint32_t node, std::uint32_t above) {
    while (node != ~0U && node != above)
        node = tree.parent[node];
    return node == above;
}

TEST(SenderOrder, FindsTheLowestNodeAboveTwoLeaves) {
    const ClusterTree& tree = fixture().tree;
    const SenderOrder order(tree);
    std::mt19937 rng(3);
    for (int i = 0; i < 2000; ++i) {
        std::uint32_t a = std::uint32_t(rng()) % tree.leaves(),
                      b = std::uint32_t(rng()) % tree.leaves();
        if (a == b)
            continue;
        EXPECT_EQ(order.leafAt(order.rank(a)), a);
        std::uint32_t lowest = tree.parent[a];
        while (!isBelow(tree, b, lowest))
            lowest = tree.parent[lowest];
        const auto [first, second] = std::minmax({order.rank(a), order.rank(b)});
        EXPECT_EQ(order.ancestor(first, second), lowest);
    }
}

/// What a random cache might see.
void addRandomLeaves(std::mt19937& rng, const ClusterTree& tree, std::uint32_t senders,
                     VisibleTree& seen) {
    std::uniform_real_distribution<float> unit(0, 1);
    for (std::uint32_t k = 0; k < senders; ++k) {
        const float weight = unit(rng);
        seen.add(std::uint32_t(rng()) % tree.leaves(),
                 {weight, weight * unit(rng), glm::vec3(unit(rng), unit(rng), unit(rng))});
    }
    seen.build();
}

TEST(VisibleTree, JoinsWhatIsSeenAtItsLowestCommonNodes) {
    const ClusterTree& tree = fixture().tree;
    const SenderOrder order(tree);
    VisibleTree seen(order);
    std::mt19937 rng(4);
    for (int i = 0; i < 50; ++i) {
        addRandomLeaves(rng, tree, 1 + std::uint32_t(rng()) % 60, seen);
        ASSERT_EQ(seen.size(), 2 * seen.leaves() - 1);
        for (std::uint32_t n = seen.leaves(); n < seen.size(); ++n) {
            const std::uint32_t l = seen.child(n, 0), r = seen.child(n, 1);
            ASSERT_LT(l, n);
            ASSERT_LT(r, n);
            const std::uint32_t inner = seen.node[n] - tree.leaves();
            EXPECT_TRUE(isBelow(tree, seen.node[l], tree.left[inner]));
            EXPECT_TRUE(isBelow(tree, seen.node[r], tree.right[inner]));
            EXPECT_NEAR(seen.formFactor[n].solidAngle,
                        seen.formFactor[l].solidAngle + seen.formFactor[r].solidAngle, 1e-5);
        }
    }
}

/// Most of gain - bound * refinements that any cut of the subtree can have.
double bestCut(const VisibleTree& seen, const std::vector<double>& gain, std::uint32_t node,
               double bound) {
    if (node < seen.leaves())
        return 0;
    const double below = bestCut(seen, gain, seen.child(node, 0), bound) +
                         bestCut(seen, gain, seen.child(node, 1), bound);
    return std::max(0.0, gain[node] - bound + below);
}

/// By the definition: 1 / (r^2 + 0.01^2), r being the irradiance of a lighting over what is usual
/// in it; the last one is the prior's, whose senders are of radiosity 1.
std::array<double, TrainingLight::kCount + 1> errorWeights(const VisibleTree& seen,
                                                           const TrainingLight& training) {
    std::array<double, TrainingLight::kCount + 1> E{}, weight;
    for (std::uint32_t n = 0; n < seen.leaves(); ++n) {
        const double formFactor = double(seen.formFactor[n].irradiance);
        for (std::uint32_t t = 0; t < TrainingLight::kCount; ++t)
            E[t] += formFactor * double(training.row(seen.node[n])[t]) /
                    double(TrainingLight::strength(t));
        E.back() += formFactor;
    }
    for (std::size_t t = 0; t < E.size(); ++t)
        weight[t] = 1 / (E[t] * E[t] + 1e-4);
    return weight;
}

/// What a link to node `n` of `seen` reads.
struct Read {
    std::uint32_t node; ///< of the ClusterTree
    double seen;        ///< irradiance that the cache gets from it at a radiosity of 1
};
Read readOf(const VisibleTree& seen, const CutChoices& choices, std::uint32_t n,
            Representative choice) {
    if (n < seen.leaves() || choice == Representative::Cluster)
        return {seen.node[n], double(seen.formFactor[n].irradiance)};
    const std::uint32_t child = seen.child(n, choice == Representative::Right);
    return readOf(seen, choices, child,
                  child < seen.leaves() ? Representative::Cluster
                                        : choices.representative[child - seen.leaves()]);
}
Read readOf(const VisibleTree& seen, const CutChoices& choices, std::uint32_t n) {
    return readOf(seen, choices, n,
                  n < seen.leaves() ? Representative::Cluster
                                    : choices.representative[n - seen.leaves()]);
}

/// What the senders below each node of `seen` contribute in each lighting.
using Contributions = std::vector<std::array<double, TrainingLight::kCount>>;
Contributions contributionsOf(const VisibleTree& seen, const TrainingLight& training) {
    Contributions contribution(seen.size());
    for (std::uint32_t n = 0; n < seen.size(); ++n)
        for (std::uint32_t t = 0; t < TrainingLight::kCount; ++t)
            contribution[n][t] =
                n < seen.leaves()
                    ? double(seen.formFactor[n].irradiance) * double(training.row(seen.node[n])[t])
                    : contribution[seen.child(n, 0)][t] + contribution[seen.child(n, 1)][t];
    return contribution;
}

/// What RefinementPriority finds for a random cache, and errors of its links by the definition, in
/// doubles.
struct Weighed {
    const VisibleTree& seen;
    const TrainingLight& training;
    const CutChoices& choices;
    std::array<double, TrainingLight::kCount + 1> weight = errorWeights(seen, training);
    Contributions contribution = contributionsOf(seen, training);

    /// Weighted mean squared error of the link to node `n` of `seen` if it reads `node`.
    double errorOf(std::uint32_t n, std::uint32_t node) const {
        double sum = 0;
        for (std::uint32_t t = 0; t < TrainingLight::kCount; ++t) {
            const double d = contribution[n][t] -
                             double(seen.formFactor[n].irradiance) * double(training.row(node)[t]);
            sum += weight[t] * d * d;
        }
        return sum / TrainingLight::kCount;
    }
};

template <class Visit>
void forEachWeighed(unsigned seed, const Visit& visit) {
    const Fixture& f = fixture();
    const SenderOrder order(f.tree);
    VisibleTree seen(order);
    RefinementPriority priority;
    std::mt19937 rng(seed);
    for (int i = 0; i < 30; ++i) {
        addRandomLeaves(rng, f.tree, 80, seen);
        priority.byDetail(seen, f.training);
        visit(Weighed{seen, f.training, priority.choices()});
    }
}

TEST(RefinementPriority, EveryBoundGivesTheCutOfLeastErrorForItsLinks) {
    forEachWeighed(5, [](const Weighed& w) {
        const VisibleTree& seen = w.seen;
        std::vector<double> error, gain(seen.size());
        for (std::uint32_t n = 0; n < seen.size(); ++n)
            error.push_back(w.errorOf(n, readOf(seen, w.choices, n).node));
        double all = 0;
        for (std::uint32_t n = seen.leaves(); n < seen.size(); ++n) {
            const std::uint32_t l = seen.child(n, 0), r = seen.child(n, 1);
            gain[n] = error[n] - error[l] - error[r] +
                      0.03 * w.weight.back() * double(seen.formFactor[l].irradiance) *
                          double(seen.formFactor[r].irradiance);
            all += std::abs(gain[n]);
        }
        for (const float bound : w.choices.priority) {
            double reached = 0;
            for (std::uint32_t n = seen.leaves(); n < seen.size(); ++n)
                if (w.choices.priority[n - seen.leaves()] > bound)
                    reached += gain[n] - double(bound);
            EXPECT_NEAR(reached, bestCut(seen, gain, seen.size() - 1, double(bound)), 1e-5 * all);
        }
    });
}

TEST(RefinementPriority, ALinkReadsTheNodeOfLeastExpectedError) {
    int represented = 0;
    forEachWeighed(7, [&](const Weighed& w) {
        const VisibleTree& seen = w.seen;
        for (std::uint32_t n = seen.leaves(); n < seen.size(); ++n) {
            const auto expected = [&](Representative choice) {
                const Read read = readOf(seen, w.choices, n, choice);
                const auto formFactor = double(seen.formFactor[n].irradiance);
                return w.errorOf(n, read.node) + w.weight.back() * 0.03 / 2 * formFactor *
                                                     (formFactor - 2 * read.seen) *
                                                     double(w.training.squaredWeights[read.node]);
            };
            const double clusterError = expected(Representative::Cluster),
                         left = expected(Representative::Left),
                         right = expected(Representative::Right);
            const Representative choice = w.choices.representative[n - seen.leaves()];
            represented += choice != Representative::Cluster;
            const double scale = std::abs(clusterError) + std::abs(left) + std::abs(right);
            EXPECT_NEAR(expected(choice), std::min({clusterError, left, right}), 1e-5 * scale);
        }
    });
    EXPECT_GT(represented, 100); // of some two thousand
}

TEST(RefinementPriority, WhatIsUnseenAndDarkDoesNotDimWhatIsSeenAndBright) {
    // Leaves 0 to 3, clusters 4 = (0, 1), 5 = (2, 3), 6 = all. The cache sees leaves 0 and 2, which
    // a lighting makes bright, and not the others, which are dark, as the sides of two columns.
    ClusterTree tree;
    tree.surfels = 4;
    tree.left = {0, 2, 4};
    tree.right = {1, 3, 5};
    tree.leftWeight = {0.5f, 0.5f, 0.5f};
    TrainingLight training;
    training.radiosity.assign(std::size_t(7) * TrainingLight::kCount, 0);
    const float radiosity[7] = {1, 0, 1, 0, 0.5f, 0.5f, 0.5f};
    for (std::size_t n = 0; n < 7; ++n)
        training.radiosity[n * TrainingLight::kCount] = radiosity[n];
    training.squaredWeights = {1, 1, 1, 1, 0.5f, 0.5f, 0.25f};
    const SenderOrder order(tree);
    VisibleTree seen(order);
    seen.add(0, {0.5f, 0.5f, {}});
    seen.add(2, {0.4f, 0.4f, {}});
    seen.build();
    ASSERT_EQ(seen.size(), 3U);
    ASSERT_EQ(seen.node[2], 6U);
    RefinementPriority priority;
    priority.byDetail(seen, training);
    EXPECT_EQ(readOf(seen, priority.choices(), 2).node, 0U); // the greater of two that are exact
    for (std::size_t n = 0; n < 7; ++n) // with a lighting that nothing hides, all nodes are exact
        training.radiosity[n * TrainingLight::kCount] = 1;
    priority.byDetail(seen, training);
    EXPECT_EQ(readOf(seen, priority.choices(), 2).node, 6U); // the mean of most senders
    priority.bySolidAngle(seen);
    EXPECT_EQ(readOf(seen, priority.choices(), 2).node, 6U);
}

TEST(RefinementPriority, NeverFallsTowardsTheRoot) {
    const Fixture& f = fixture();
    const SenderOrder order(f.tree);
    VisibleTree seen(order);
    RefinementPriority priority;
    std::mt19937 rng(6);
    for (int i = 0; i < 50; ++i) {
        addRandomLeaves(rng, f.tree, 200, seen);
        for (const bool detail : {false, true}) {
            detail ? priority.byDetail(seen, f.training) : priority.bySolidAngle(seen);
            for (std::uint32_t n = seen.leaves(); n < seen.size(); ++n)
                for (int side = 0; side < 2; ++side)
                    if (const std::uint32_t c = seen.child(n, side); c >= seen.leaves()) {
                        EXPECT_GE(priority.choices().priority[n - seen.leaves()],
                                  priority.choices().priority[c - seen.leaves()]);
                    }
        }
    }
}

/// Marks the leaves below every link of a cache; fails where one is marked twice.
std::vector<bool> covered(const ClusterTree& tree, const Caches& caches, std::uint32_t cache) {
    std::vector<bool> mark(tree.leaves());
    for (std::uint32_t k = caches.linkBegin[cache]; k < caches.linkBegin[cache + 1]; ++k) {
        std::vector<std::uint32_t> stack = {caches.links[k].node};
        while (!stack.empty()) {
            const std::uint32_t n = stack.back();
            stack.pop_back();
            if (n >= tree.leaves()) {
                stack.push_back(tree.left[n - tree.leaves()]);
                stack.push_back(tree.right[n - tree.leaves()]);
                continue;
            }
            EXPECT_FALSE(mark[n]) << "cache " << cache << ", leaf " << n;
            mark[n] = true;
        }
    }
    return mark;
}

TEST(Cut, CoversEverySenderInSightOnceAndKeepsToItsBudget) {
    for (const std::uint32_t links : {1U, 2U, 10U, 50U}) {
        const Fixture& f = fixture();
        const std::size_t budget = f.cut(CutCriterion::SolidAngle, links).links.size();
        for (const CutCriterion criterion : {CutCriterion::SolidAngle, CutCriterion::Detail}) {
            const Caches caches = f.cut(criterion, links);
            EXPECT_LE(caches.links.size(), budget);
            EXPECT_GT(caches.links.size(), budget * 97 / 100);
            for (std::uint32_t c = 0; c < caches.size(); ++c) {
                const std::uint32_t linkCount = caches.linkBegin[c + 1] - caches.linkBegin[c];
                EXPECT_LE(linkCount, criterion == CutCriterion::Detail ? 16 * links : links);
                const std::vector<bool> mark = covered(f.tree, caches, c);
                if (criterion == CutCriterion::Detail)
                    continue; // a link may read one sender for several
                for (std::uint32_t r = 0; linkCount > 0 && r < f.hits.rays; ++r)
                    if (const std::uint32_t s = f.hits.sender[c * f.hits.rays + r];
                        s < GatherHits::kFirstMark) {
                        EXPECT_TRUE(mark[s]);
                    }
            }
        }
    }
}

TEST(Cut, OfAsManyLinksAsSendersIsTheSendersThemselves) {
    const Fixture& f = fixture();
    for (const CutCriterion criterion : {CutCriterion::SolidAngle, CutCriterion::Detail}) {
        for (const Link& l : f.cut(criterion, 4096).links)
            EXPECT_LT(l.node, f.tree.leaves());
    }
}

TEST(Cut, TransportSumsToTheSolidAngleOfAnEnclosure) {
    const Fixture& f = fixture();
    const Caches caches = f.cut(CutCriterion::Detail, 40);
    for (std::uint32_t c = caches.lightmapCount; c < caches.size(); ++c) {
        float sum = 0;
        for (std::uint32_t k = caches.linkBegin[c]; k < caches.linkBegin[c + 1]; ++k)
            sum += linkWeight(caches, c, k).transport;
        if (sum > 0) { // a cell of the grid in the open: all around, over pi
            EXPECT_NEAR(sum, 4, 4e-3);
        }
    }
}

TEST(TrainingLight, HasAMeanSquareOfOneOverWhatIsSeen) {
    const Fixture& f = fixture();
    const std::vector<float> importance =
        leafImportance(f.set.surfels, f.hits, f.points, f.caches, f.tree);
    double total = 0;
    std::vector<double> mean(TrainingLight::kCount), square(TrainingLight::kCount);
    for (std::uint32_t leaf = 0; leaf < f.tree.leaves(); ++leaf) {
        total += double(importance[leaf]);
        for (std::uint32_t t = 0; t < TrainingLight::kCount; ++t) {
            const auto b = double(f.training.row(leaf)[t]);
            mean[t] += double(importance[leaf]) * b;
            square[t] += double(importance[leaf]) * b * b;
        }
    }
    int lit = 0;
    for (std::uint32_t t = 0; t < TrainingLight::kCount; ++t) {
        lit += mean[t] > 0;
        if (mean[t] > 0) {
            EXPECT_NEAR(square[t] / total, 1, 1e-3);
            // The root's weights are the leaves' importance, so its radiosity is the mean.
            EXPECT_NEAR(f.training.row(f.tree.size() - 1)[t], mean[t] / total, 1e-2);
        }
    }
    double squares = 0; // of these weights
    for (const float s : importance)
        squares += double(s) * double(s) / (total * total);
    EXPECT_NEAR(f.training.squaredWeights.back(), squares, 1e-3 * squares);
    EXPECT_GE(lit, 32); // a closed room: every lamp, no sun, no sky
}

TEST(WeighByLinks, CountsThoseAloneThatReadTheMean) {
    ClusterTree tree; // leaves 0 to 2; 3 = (0, 1), 4 = (3, 2)
    tree.surfels = 3;
    tree.left = {0, 3};
    tree.right = {1, 2};
    tree.leftWeight = {0.9f, 0.9f};
    ASSERT_EQ(tree.leaves(), 3U);
    // One cache is linked to leaf 0, 2 of the 3 that are seen of it, one to all of the tree, one to
    // leaf 2 and the cluster of the others.
    const std::vector<float> importance = {3, 4, 7};
    const std::vector<double> linked = {2, 0, 5, 2, 5};
    weighByLinks(importance, linked, tree);
    EXPECT_FLOAT_EQ(tree.leftWeight[0], 1 / 5.f);
    EXPECT_FLOAT_EQ(tree.leftWeight[1], 3 / 5.f);
    weighByLinks(importance, {3, 4, 7, 0, 0}, tree); // nobody reads a mean
    EXPECT_FLOAT_EQ(tree.leftWeight[0], 1 / 5.f);
    EXPECT_FLOAT_EQ(tree.leftWeight[1], 3 / 5.f);
}

TEST(WeighByLinks, LinksKeepTheEnergyOfWhatTheyStandFor) {
    const Fixture& f = fixture();
    const std::vector<float> importance =
        leafImportance(f.set.surfels, f.hits, f.points, f.caches, f.tree);
    for (const std::uint32_t links : {8U, 16U, 32U}) {
        Caches caches = f.caches;
        std::vector<double> linked;
        buildLinks(f.set.surfels, f.tree, f.hits, f.points, f.training,
                   {CutCriterion::Detail, links, 3}, {}, caches, &linked);
        ClusterTree tree = f.tree;
        weighByLinks(importance, linked, tree);
        // Over all caches, bright towards one side.
        double before = 0, after = 0;
        for (int axis = 0; axis < 6; ++axis) {
            std::vector<double> was(f.tree.size()), is;
            double exact = 0;
            for (std::uint32_t s = 0; s < f.tree.surfels; ++s) {
                const float x = f.set.surfels.position[s][axis / 2];
                was[s] = std::exp(axis % 2 ? -3.0 * double(x) : 3.0 * double(x) - 6);
                exact += was[s] * double(importance[s]);
            }
            is = was;
            double sumWas = 0, sumIs = 0;
            for (std::uint32_t n = 0; n < f.tree.size(); ++n) {
                if (n >= f.tree.leaves()) {
                    const std::uint32_t k = n - f.tree.leaves();
                    const auto pull = [&](const ClusterTree& t, std::vector<double>& v) {
                        const double w = double(t.leftWeight[k]);
                        v[n] = w * v[t.left[k]] + (1 - w) * v[t.right[k]];
                    };
                    pull(f.tree, was);
                    pull(tree, is);
                }
                sumWas += linked[n] * was[n];
                sumIs += linked[n] * is[n];
            }
            before += std::abs(sumWas / exact - 1);
            after += std::abs(sumIs / exact - 1);
        }
        EXPECT_LT(after, before / 2) << links;
        EXPECT_LT(after / 6, 0.01) << links;
    }
}

} // namespace
} // namespace limn::cut_test
