// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/senders/clustering.h"

#include "engine/core/parallel.h"
#include "engine/math/median_split.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <tuple>

#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr std::uint32_t kNone = ~0U;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// A cluster in the metric's coordinates. 1 - m_a . m_b = |m_a - m_b|^2 / 2 + (1 - |m_a|^2) / 2 +
/// (1 - |m_b|^2) / 2, free of cancellation where normals agree.
struct Cluster {
    std::array<float, 6> coordinates; ///< metricCoordinates
    float spread;                     ///< C_n (1 - |m|^2) / 2, >= 0
    float area;
};

Cluster merged(const Cluster& a, const Cluster& b, float normalWeight) {
    Cluster c;
    c.area = a.area + b.area;
    const float w = b.area / c.area;
    float m2 = 0;
    for (std::size_t k = 0; k < 6; ++k) {
        c.coordinates[k] = a.coordinates[k] +
                           (b.coordinates[k] - a.coordinates[k]) * w; // exact where both are equal
        m2 += k < 3 ? 0 : c.coordinates[k] * c.coordinates[k];
    }
    c.spread = std::max(normalWeight / 2 - m2, 0.f);
    return c;
}

/// Bounding box of some clusters. bound() is rounded as distance() is, step by step, so it never
/// exceeds the distance to any of them.
struct Box {
    std::array<float, 6> lower, upper;
    float minSpread = kInfinity, minArea = kInfinity, maxArea = 0;
    std::uint32_t minNumber = kNone;

    Box() {
        lower.fill(kInfinity);
        upper.fill(-kInfinity);
    }
    void add(const Cluster& c, std::uint32_t number) {
        for (std::size_t k = 0; k < 6; ++k) {
            lower[k] = std::min(lower[k], c.coordinates[k]);
            upper[k] = std::max(upper[k], c.coordinates[k]);
        }
        minSpread = std::min(minSpread, c.spread);
        minArea = std::min(minArea, c.area);
        maxArea = std::max(maxArea, c.area);
        minNumber = std::min(minNumber, number);
    }
    void add(const Box& b) {
        for (std::size_t k = 0; k < 6; ++k) {
            lower[k] = std::min(lower[k], b.lower[k]);
            upper[k] = std::max(upper[k], b.upper[k]);
        }
        minSpread = std::min(minSpread, b.minSpread);
        minArea = std::min(minArea, b.minArea);
        maxArea = std::max(maxArea, b.maxArea);
        minNumber = std::min(minNumber, b.minNumber);
    }
    bool operator==(const Box&) const = default;
};

float distance(const Cluster& a, const Cluster& b, float balanceWeight) {
    float d = 0;
    for (std::size_t k = 0; k < 6; ++k) {
        const float e = a.coordinates[k] - b.coordinates[k];
        d += e * e;
    }
    d += a.spread + b.spread;
    return d + balanceWeight * (1 - std::min(a.area, b.area) / std::max(a.area, b.area));
}

float bound(const Cluster& a, const Box& b, float balanceWeight) {
    float d = 0;
    for (std::size_t k = 0; k < 6; ++k) {
        const float e =
            std::max(std::max(b.lower[k] - a.coordinates[k], a.coordinates[k] - b.upper[k]), 0.f);
        d += e * e;
    }
    d += a.spread + b.minSpread;
    const float nearest = std::min(std::max(a.area, b.minArea), b.maxArea);
    return d + balanceWeight * (1 - std::min(a.area, nearest) / std::max(a.area, nearest));
}

struct Nearest {
    float distance = kInfinity;
    std::uint32_t number = kNone;

    bool operator<(const Nearest& o) const {
        return distance != o.distance ? distance < o.distance : number < o.number;
    }
};

/// The remaining clusters, in a complete binary tree of boxes over slots.
class ClusterIndex {
public:
    ClusterIndex(const std::vector<Cluster>& clusters, float balanceWeight)
        : m_clusters(clusters), m_balanceWeight(balanceWeight) {}

    void build(std::vector<std::uint32_t> numbers) {
        m_slots = std::move(numbers);
        m_leaves = std::bit_ceil(std::max<std::size_t>(m_slots.size() / kPerLeaf, 1));
        m_boxes.assign(2 * m_leaves - 1, {});
        m_slotBegin.assign(m_leaves + 1, std::uint32_t(m_slots.size()));
        m_leafOf.resize(m_clusters.capacity());
        split(0, 0, std::uint32_t(m_slots.size()));
    }

    /// The cluster nearest to `number` other than itself; among equals the lowest.
    Nearest nearest(std::uint32_t number) const;

    /// Puts `c` into the slot of `a` and empties the slot of `b`.
    void replace(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        m_leafOf[c] = m_leafOf[a];
        *find(a) = c;
        refit(m_leafOf[a]);
        *find(b) = kNone;
        refit(m_leafOf[b]);
    }

    /// All remaining clusters; empty slots hold kNone.
    const std::vector<std::uint32_t>& slots() const { return m_slots; }

private:
    static constexpr std::size_t kPerLeaf = 4;

    void split(std::size_t node, std::uint32_t begin, std::uint32_t end);
    void refit(std::size_t leaf);
    std::vector<std::uint32_t>::iterator find(std::uint32_t number) {
        return std::find(m_slots.begin() + m_slotBegin[m_leafOf[number]], m_slots.end(), number);
    }
    void fillLeaf(std::size_t leaf, Box& box) const {
        for (std::uint32_t s = m_slotBegin[leaf]; s < m_slotBegin[leaf + 1]; ++s)
            if (m_slots[s] != kNone)
                box.add(m_clusters[m_slots[s]], m_slots[s]);
    }

    const std::vector<Cluster>& m_clusters;
    float m_balanceWeight;
    std::size_t m_leaves = 0;
    std::vector<Box> m_boxes; ///< children of k: 2k + 1 and 2k + 2; the leaves come last
    std::vector<std::uint32_t> m_slots, m_slotBegin; ///< per leaf (+1)
    std::vector<std::uint32_t> m_leafOf;             ///< per cluster
};

void ClusterIndex::split(std::size_t node, std::uint32_t begin, std::uint32_t end) {
    if (node >= m_leaves - 1) {
        const std::size_t leaf = node - (m_leaves - 1);
        m_slotBegin[leaf] = begin;
        for (std::uint32_t s = begin; s < end; ++s) {
            m_leafOf[m_slots[s]] = std::uint32_t(leaf);
            m_boxes[node].add(m_clusters[m_slots[s]], m_slots[s]);
        }
        return;
    }
    // Areas in a ratio of two are C_b / 2 apart in the metric.
    const float octave = std::sqrt(m_balanceWeight / 2);
    medianSplit<7>(std::span(m_slots).subspan(begin, end - begin),
                   [&](std::uint32_t i, std::size_t k) {
                       const Cluster& c = m_clusters[i];
                       return k < 6 ? c.coordinates[k] : octave * float(std::ilogb(c.area));
                   });
    const std::uint32_t middle = begin + (end - begin) / 2;
    split(2 * node + 1, begin, middle);
    split(2 * node + 2, middle, end);
    m_boxes[node].add(m_boxes[2 * node + 1]);
    m_boxes[node].add(m_boxes[2 * node + 2]);
}

void ClusterIndex::refit(std::size_t leaf) {
    Box box;
    fillLeaf(leaf, box);
    for (std::size_t node = leaf + m_leaves - 1; !(m_boxes[node] == box);) {
        m_boxes[node] = box;
        if (node == 0)
            return;
        node = (node - 1) / 2;
        box = m_boxes[2 * node + 1];
        box.add(m_boxes[2 * node + 2]);
    }
}

Nearest ClusterIndex::nearest(std::uint32_t number) const {
    struct Visit {
        Nearest best; ///< lower bound for what the box may hold
        std::size_t node;
    };
    const Cluster& from = m_clusters[number];
    const auto visit = [&](std::size_t node) {
        const Box& box = m_boxes[node];
        return Visit{{bound(from, box, m_balanceWeight), box.minNumber}, node};
    };
    Nearest best;
    Visit stack[64]; // at most one for each level and one more
    int size = 0;
    stack[size++] = visit(0);
    while (size > 0) {
        const Visit v = stack[--size];
        if (!(v.best < best))
            continue;
        if (v.node < m_leaves - 1) {
            const Visit l = visit(2 * v.node + 1), r = visit(2 * v.node + 2);
            const bool leftFirst = l.best < r.best;
            stack[size++] = leftFirst ? r : l;
            stack[size++] = leftFirst ? l : r;
            continue;
        }
        const std::size_t leaf = v.node - (m_leaves - 1);
        for (std::uint32_t s = m_slotBegin[leaf]; s < m_slotBegin[leaf + 1]; ++s)
            if (const std::uint32_t other = m_slots[s]; other != kNone && other != number)
                best = std::min(best, {distance(from, m_clusters[other], m_balanceWeight), other});
    }
    return best;
}

/// The nearest neighbour of `owner` at the last query. `low` < `high` are the two.
struct Candidate {
    float distance;
    std::uint32_t low, high, owner;

    /// std heaps have the largest first. Of equal distances, the pair whose later cluster came
    /// first is preferred: with the earlier cluster instead, many points at one spot would all
    /// query again after each merge.
    bool operator<(const Candidate& o) const {
        return std::tie(distance, high, low) > std::tie(o.distance, o.high, o.low);
    }
};

Candidate candidate(std::uint32_t owner, const Nearest& n) {
    return {n.distance, std::min(owner, n.number), std::max(owner, n.number), owner};
}

/// Generic clustering algorithm of Müllner (clustering.h); yields merges in the order they are
/// made.
class Agglomeration {
public:
    Agglomeration(std::span<const ClusterItem> items, const ClusterMetric& metric)
        : m_count(std::uint32_t(items.size())), m_normalWeight(metric.normalWeight),
          m_index(m_clusters, metric.balanceWeight), m_alive(2 * items.size() - 1) {
        m_clusters.reserve(2 * items.size() - 1);
        std::vector<std::uint32_t> numbers;
        for (const ClusterItem& item : items) {
            numbers.push_back(std::uint32_t(m_clusters.size()));
            const float m2 = std::min(glm::dot(item.normal, item.normal), 1.f);
            m_clusters.push_back({metricCoordinates(item, metric),
                                  metric.normalWeight * (1 - m2) / 2,
                                  std::clamp(item.area, 1e-30f, 1e30f)});
            m_alive[numbers.back()] = true;
        }
        m_index.build(std::move(numbers));
        m_heap.resize(items.size());
        parallelRanges(items.size(), 256, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                m_heap[i] = candidate(std::uint32_t(i), m_index.nearest(std::uint32_t(i)));
        });
        std::make_heap(m_heap.begin(), m_heap.end());
    }

    MergeTree run(const Progress& progress) {
        constexpr float kRebuildAt = 0.7f; // share of the clusters at the last rebuild
        MergeTree tree;
        std::uint32_t left = m_count, built = m_count;
        while (left > 1 && !(left % 1024 == 0 && progress.cancelled())) {
            const auto [a, b] = closestPair();
            const auto c = std::uint32_t(m_clusters.size());
            m_clusters.push_back(merged(m_clusters[a], m_clusters[b], m_normalWeight));
            m_alive[a] = m_alive[b] = false;
            m_alive[c] = true;
            tree.left.push_back(a);
            tree.right.push_back(b);
            m_index.replace(a, b, c);
            if (float(--left) < kRebuildAt * float(built)) {
                rebuild();
                built = left;
            }
            if (left > 1)
                push(c);
        }
        return tree;
    }

private:
    void push(std::uint32_t owner) {
        m_heap.push_back(candidate(owner, m_index.nearest(owner)));
        std::push_heap(m_heap.begin(), m_heap.end());
    }

    /// The one of two clusters that was queried last has a neighbour at most as far away as the
    /// other cluster. So the heap's top, if it still exists, is the closest pair of all; if its
    /// neighbour is gone, it queries again.
    std::pair<std::uint32_t, std::uint32_t> closestPair() {
        for (;;) {
            std::pop_heap(m_heap.begin(), m_heap.end());
            const Candidate top = m_heap.back();
            m_heap.pop_back();
            if (!m_alive[top.owner])
                continue;
            if (m_alive[top.low] && m_alive[top.high])
                return {top.low, top.high};
            push(top.owner);
        }
    }

    void rebuild() {
        std::vector<std::uint32_t> numbers = m_index.slots();
        std::erase(numbers, kNone);
        m_index.build(std::move(numbers));
    }

    std::uint32_t m_count;
    float m_normalWeight;
    std::vector<Cluster> m_clusters; ///< items, then merged ones
    ClusterIndex m_index;
    std::vector<bool> m_alive;
    std::vector<Candidate> m_heap; ///< one for each remaining cluster, and some of merged ones
};

/// The same tree with its inner nodes depth first.
MergeTree depthFirst(const MergeTree& tree, std::uint32_t count) {
    const auto inner = std::uint32_t(tree.left.size());
    // Parents before children and left before right, numbered from the end.
    std::vector<std::uint32_t> number(inner), stack = {inner - 1};
    for (std::uint32_t next = inner; !stack.empty();) {
        const std::uint32_t k = stack.back();
        stack.pop_back();
        number[k] = --next;
        for (const std::uint32_t child : {tree.left[k], tree.right[k]})
            if (child >= count)
                stack.push_back(child - count);
    }
    MergeTree result{std::vector<std::uint32_t>(inner), std::vector<std::uint32_t>(inner)};
    const auto renumbered = [&](std::uint32_t child) {
        return child < count ? child : count + number[child - count];
    };
    for (std::uint32_t k = 0; k < inner; ++k) {
        result.left[number[k]] = renumbered(tree.left[k]);
        result.right[number[k]] = renumbered(tree.right[k]);
    }
    return result;
}

} // namespace

MergeTree clusterAgglomerative(std::span<const ClusterItem> items, const ClusterMetric& metric,
                               const Progress& progress) {
    if (items.size() < 2)
        return {};
    const MergeTree tree = Agglomeration(items, metric).run(progress);
    return progress.cancelled() ? MergeTree() : depthFirst(tree, std::uint32_t(items.size()));
}

} // namespace limn
