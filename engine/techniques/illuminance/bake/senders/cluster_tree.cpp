// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/senders/cluster_tree.h"

#include "engine/core/hash.h"
#include "engine/core/parallel.h"
#include "engine/lightmap/layout/layout_rules.h"
#include "engine/stages/stage_archive.h"
#include "engine/stages/stage_keys.h"
#include "engine/techniques/illuminance/bake/senders/clustering.h"
#include "engine/techniques/illuminance/format/tree_rules.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

ClusterMetric metricOf(const BakeSettings& settings, glm::vec3 size) {
    return {std::max(glm::length(size), 1e-20f), settings.clusterNormalWeight,
            settings.clusterBalanceWeight};
}

MergeTree meshTree(const MeshSurfels& surfels, const BakeSettings& settings,
                   const Progress& progress) {
    const Bounds box = boundsOf(surfels.position);
    std::vector<ClusterItem> items(surfels.size());
    for (std::size_t i = 0; i < items.size(); ++i)
        items[i] = {surfels.position[i] - box.lower, surfels.normal[i], 1};
    return clusterItems(settings.clustering, items, metricOf(settings, box.size()), progress);
}

MergeTree keptMeshTree(const MeshSurfels& surfels, const BakeSettings& settings,
                       const Progress& progress, StageStore* store) {
    std::uint64_t key = hashVector(surfels.position, hashVector(surfels.normal, 0));
    key = hashValue(settings.clusterNormalWeight, hashValue(settings.clusterBalanceWeight, key));
    key = hashValue(std::uint32_t(settings.clustering), key);
    constexpr std::size_t kWorthKeeping = 64; // smaller or median trees rebuild as fast
    const bool slow =
        settings.clustering == Clustering::Agglomerative && surfels.size() >= kWorthKeeping;
    return keptOrMade<MergeTree>(
        slow ? store : nullptr, stageKey(Stage::MeshTree, key), progress,
        [&surfels](auto& a, auto& t) {
            a("left", t.left, rule::any);
            a("right", t.right, rule::holds("no tree", [&](const auto& right) {
                  return isTree(t.left, right, std::uint32_t(surfels.size()));
              }));
        },
        [&] { return meshTree(surfels, settings, progress); });
}

/// A subtree already in the ClusterTree, seen as one item of the tree above it.
struct Root {
    std::uint32_t node;
    ClusterItem item;
};

/// Appends `local`, whose items are the nodes `item(i)`; returns its root node.
template <class Item>
std::uint32_t append(const MergeTree& local, std::uint32_t items, Item item, ClusterTree& tree) {
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
    return {node, {centre / area, normal / area, area}};
}

/// Joins the roots of the instances and, last, that of the sky.
void joinRoots(const std::vector<Root>& roots, const Scene& scene, std::uint32_t sky,
               const Progress& progress, ClusterTree& tree) {
    if (roots.empty())
        return;
    std::vector<ClusterItem> items;
    const Bounds bounds = staticBounds(scene);
    for (const Root& r : roots) {
        items.push_back(r.item);
        items.back().position -= bounds.lower;
    }
    const std::uint32_t top = append(
        clusterItems(scene.bake.clustering, items, metricOf(scene.bake, bounds.size()), progress),
        std::uint32_t(roots.size()), [&](std::uint32_t i) { return roots[i].node; }, tree);
    tree.left.push_back(top);
    tree.right.push_back(sky);
}

/// Appends the tree over the sky's cells and returns its root. It is always split at medians,
/// because the cells form a regular grid.
std::uint32_t appendSky(ClusterTree& tree) {
    std::vector<ClusterItem> items;
    for (std::uint32_t c = 0; c < kSkyCells; ++c) {
        tree.skyDirection.push_back(skyCellDirection(c));
        items.push_back({tree.skyDirection.back(), glm::vec3(0), 1});
    }
    return append(
        clusterByMedian(items, {}), kSkyCells, [&](std::uint32_t c) { return tree.surfels + c; },
        tree);
}

} // namespace

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

/// The surfels on the front of a two-sided mesh.
static MeshSurfels frontOf(const MeshSurfels& both) {
    MeshSurfels front = both;
    const std::size_t n = both.frontCount;
    front.position.resize(n);
    front.normal.resize(n);
    front.triangle.resize(n);
    front.barycentric.resize(n);
    if (!front.areas.empty())
        front.areas.resize(n);
    return front;
}

/// Whether an instance has surfels on its front only, while others of its mesh are two-sided.
static bool hasFrontOnly(const SurfelSet& set, const Instance& instance, std::size_t index) {
    const std::size_t n = set.instanceBegin[index + 1] - set.instanceBegin[index];
    return n > 0 && n < set.meshes[instance.mesh].size();
}

ClusterTree buildClusterTree(const Scene& scene, const SurfelSet& set, const Progress& progress,
                             StageStore* store) {
    ClusterTree tree;
    tree.surfels = std::uint32_t(set.surfels.size());
    tree.skyCells = kSkyCells;
    std::vector<MergeTree> meshes(set.meshes.size()), fronts(set.meshes.size());
    std::vector<bool> needsFront(set.meshes.size());
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
        if (hasFrontOnly(set, scene.instances[i], i))
            needsFront[scene.instances[i].mesh] = true;
    parallelRanges(meshes.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t m = begin; m < end; ++m) {
            if (set.meshes[m].size() > 0 && !progress.cancelled())
                meshes[m] = keptMeshTree(set.meshes[m], scene.bake, progress, store);
            if (needsFront[m] && !progress.cancelled())
                fronts[m] = keptMeshTree(frontOf(set.meshes[m]), scene.bake, progress, store);
        }
    });
    if (progress.cancelled())
        return {};
    std::vector<Root> roots;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const std::uint32_t begin = set.instanceBegin[i], end = set.instanceBegin[i + 1];
        if (begin == end)
            continue;
        const Instance& instance = scene.instances[i];
        const auto& trees = hasFrontOnly(set, instance, i) ? fronts : meshes;
        const std::uint32_t node = append(
            trees[instance.mesh], end - begin, [&](std::uint32_t k) { return begin + k; }, tree);
        roots.push_back(instanceRoot(set.surfels, begin, end, node));
    }
    joinRoots(roots, scene, appendSky(tree), progress, tree);
    fillWeightsAndParents(set.surfels, tree);
    return tree;
}

} // namespace limn
