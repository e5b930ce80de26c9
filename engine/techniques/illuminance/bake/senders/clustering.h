// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/progress.h"
#include "engine/scene/bake_settings.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// A sender, or a cluster of senders, as the clustering sees it.
struct ClusterItem {
    glm::vec3 position; ///< area-weighted mean
    glm::vec3 normal;   ///< area-weighted mean; length <= 1
    float area;         ///< sum, > 0; only ratios matter
};

/// Inner nodes of a binary tree over `count` items, depth first: a subtree's nodes are contiguous
/// and children come before parents. A child < count is an item; any other is count + the index of
/// an inner node. Empty for a single item.
struct MergeTree {
    std::vector<std::uint32_t> left, right;
    bool operator==(const MergeTree&) const = default;
};

/// Weights of the metric between clusters,
/// d(a,b) = |x_a - x_b|^2 / extent^2 + C_n (1 - m_a . m_b) + C_b |A_a - A_b| / max(A_a, A_b).
/// Jendersie et al. Real-Time Global Illumination Using Precomputed Illuminance Composition with
/// Chrominance Compression. 2016
struct ClusterMetric {
    float extent = 1;            ///< length that counts as 1 [the items' unit], > 0
    float normalWeight = 0.1f;   ///< C_n >= 0
    float balanceWeight = 0.02f; ///< C_b >= 0
};

/// Maps an item to six coordinates in which the squared distance is the first two terms of the
/// metric for unit normals: x / extent and sqrt(C_n / 2) m, within +-1e9. Non-finite values become
/// 0.
std::array<float, 6> metricCoordinates(const ClusterItem& item, const ClusterMetric& metric);

/// Repeatedly joins the two clusters of least d(a,b). Ties go to the pair whose later member has
/// the lower number, then the earlier one; clusters are numbered after the items, as they are made.
/// Exact: each choice is the one that a search through all pairs would make. Implements the generic
/// algorithm of Müllner. Modern Hierarchical, Agglomerative Clustering Algorithms. 2011, with
/// nearest neighbours from a tree of boxes. Without nodes when cancelled.
MergeTree clusterAgglomerative(std::span<const ClusterItem> items, const ClusterMetric& metric,
                               const Progress& progress = {});

/// Splits at the median of the widest of metricCoordinates(). The balance term is not used, since
/// splitting at the median balances the tree.
MergeTree clusterByMedian(std::span<const ClusterItem> items, const ClusterMetric& metric);

/// Calls the function that `how` chooses of the two above.
MergeTree clusterItems(Clustering how, std::span<const ClusterItem> items,
                       const ClusterMetric& metric, const Progress& progress = {});

} // namespace limn
