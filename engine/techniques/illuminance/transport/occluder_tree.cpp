// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/transport/occluder_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include <glm/common.hpp>

namespace limn {

namespace {

constexpr std::size_t kMaxLeaf = 4;

/// A node before the order of nodes is known.
struct Split {
    Bounds bounds = kNoBounds;
    std::uint32_t begin = 0, end = 0; ///< of the triangles in order
    std::uint32_t depth = 0;
};

double halfArea(const Bounds& b) {
    if (isEmpty(b))
        return 0;
    const glm::dvec3 size(b.size());
    return size.x * size.y + size.y * size.z + size.z * size.x;
}

/// Divides triangles, known by their boxes.
class Splitter {
public:
    explicit Splitter(const std::vector<OccluderTriangle>& triangles)
        : m_order(triangles.size()), m_boxes(triangles.size(), kNoBounds) {
        std::iota(m_order.begin(), m_order.end(), 0U);
        for (std::size_t k = 0; k < triangles.size(); ++k)
            for (const glm::vec3 corner : triangles[k])
                extend(m_boxes[k], corner);
    }

    Split rootOf() const { return bounded(0, std::uint32_t(m_order.size()), 0); }
    const std::vector<std::uint32_t>& order() const { return m_order; }

    /// Whether the node is divided, and if so into which two.
    bool divide(const Split& node, Split& left, Split& right) {
        if (node.end - node.begin <= kMaxLeaf)
            return false;
        // A median halves what is left, so that no depth is exceeded by however odd a scene.
        const bool deep = node.depth >= kMaxOccluderDepth - 33;
        std::uint32_t middle = deep ? node.begin : cheapest(node);
        if (middle == node.begin || middle == node.end)
            middle = median(node);
        left = bounded(node.begin, middle, node.depth + 1);
        right = bounded(middle, node.end, node.depth + 1);
        return true;
    }

private:
    struct Bin {
        Bounds bounds = kNoBounds;
        std::uint32_t count = 0;
    };
    static constexpr std::size_t kBins = 16;

    glm::vec3 centre(std::uint32_t triangle) const { return m_boxes[triangle].centre(); }
    auto at(std::uint32_t k) { return m_order.begin() + std::ptrdiff_t(k); }

    Split bounded(std::uint32_t begin, std::uint32_t end, std::uint32_t depth) const {
        Split split{kNoBounds, begin, end, depth};
        for (std::uint32_t k = begin; k < end; ++k)
            extend(split.bounds, m_boxes[m_order[k]]);
        return split;
    }
    Bounds centresOf(const Split& node) const {
        Bounds b = kNoBounds;
        for (std::uint32_t k = node.begin; k < node.end; ++k)
            extend(b, centre(m_order[k]));
        return b;
    }
    static std::size_t binOf(float x, float lower, float extent) {
        return std::min(std::size_t((x - lower) / extent * float(kBins)), kBins - 1);
    }

    /// Partitions at the best border between bins of any axis; node.begin where none divides.
    std::uint32_t cheapest(const Split& node) {
        const Bounds centres = centresOf(node);
        double best = std::numeric_limits<double>::infinity();
        int bestAxis = -1;
        std::size_t bestBin = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const float lower = centres.lower[axis], extent = centres.size()[axis];
            if (!(extent > 0) || !std::isfinite(float(kBins) / extent))
                continue;
            std::array<Bin, kBins> bins;
            for (std::uint32_t k = node.begin; k < node.end; ++k) {
                Bin& bin = bins[binOf(centre(m_order[k])[axis], lower, extent)];
                extend(bin.bounds, m_boxes[m_order[k]]);
                ++bin.count;
            }
            std::array<double, kBins> after{};
            Bin sum;
            for (std::size_t k = kBins - 1; k > 0; --k) {
                extend(sum.bounds, bins[k].bounds);
                sum.count += bins[k].count;
                after[k] = halfArea(sum.bounds) * sum.count;
            }
            sum = {};
            for (std::size_t k = 0; k + 1 < kBins; ++k) {
                extend(sum.bounds, bins[k].bounds);
                sum.count += bins[k].count;
                const double cost = halfArea(sum.bounds) * sum.count + after[k + 1];
                if (sum.count > 0 && sum.count < node.end - node.begin && cost < best)
                    best = cost, bestAxis = axis, bestBin = k;
            }
        }
        if (bestAxis < 0)
            return node.begin;
        const float lower = centres.lower[bestAxis], extent = centres.size()[bestAxis];
        const auto middle =
            std::stable_partition(at(node.begin), at(node.end), [&](std::uint32_t t) {
                return binOf(centre(t)[bestAxis], lower, extent) <= bestBin;
            });
        return std::uint32_t(middle - m_order.begin());
    }
    std::uint32_t median(const Split& node) {
        const glm::vec3 size = centresOf(node).size();
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const std::uint32_t middle = node.begin + (node.end - node.begin) / 2;
        std::nth_element(at(node.begin), at(middle), at(node.end),
                         [&](std::uint32_t a, std::uint32_t b) {
                             const float x = centre(a)[axis], y = centre(b)[axis];
                             return x < y || (x == y && a < b);
                         });
        return middle;
    }

    std::vector<std::uint32_t> m_order;
    std::vector<Bounds> m_boxes;
};

bool isFinite(const OccluderTriangle& t) {
    return std::ranges::all_of(t, [](glm::vec3 p) {
        return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    });
}

} // namespace

OccluderTree buildOccluderTree(const std::vector<OccluderTriangle>& triangles,
                               const std::vector<std::uint32_t>& cutout) {
    OccluderTree tree;
    if (triangles.empty())
        return tree;
    Splitter splitter(triangles);
    std::vector<Split> nodes = {splitter.rootOf()};
    for (std::size_t k = 0; k < nodes.size(); ++k) { // it grows by children, which makes it
        const Split node = nodes[k];                 // breadth-first
        OccluderBox box{node.bounds.lower, std::uint32_t(nodes.size()), node.bounds.upper, 0};
        Split left, right;
        if (splitter.divide(node, left, right)) {
            nodes.push_back(left);
            nodes.push_back(right);
        } else {
            box.count = node.end - node.begin;
            box.first = std::uint32_t(tree.triangles.size());
            for (std::uint32_t i = node.begin; i < node.end; ++i) {
                tree.triangles.push_back(triangles[splitter.order()[i]]);
                tree.cutout.push_back(cutout[splitter.order()[i]]);
            }
        }
        tree.boxes.push_back(box);
    }
    return tree;
}

OccluderTree occluderTree(const Scene& scene) {
    std::vector<OccluderTriangle> triangles;
    std::vector<std::uint32_t> cutout;
    CutoutCollector collector(scene);
    for (const Instance& instance : scene.instances) {
        if (instance.dynamic || isGlassSheet(scene.materialOf(instance)))
            continue;
        const Mesh& mesh = scene.meshOf(instance);
        collector.begin(instance);
        for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t) {
            const std::array<std::uint32_t, 3> corner = mesh.triangle(t);
            OccluderTriangle world;
            for (std::size_t k = 0; k < 3; ++k)
                world[k] = glm::vec3(instance.toWorld * glm::vec4(mesh.positions[corner[k]], 1));
            if (!isFinite(world))
                continue;
            if (const std::optional<std::uint32_t> number = collector.add(t)) {
                triangles.push_back(world);
                cutout.push_back(*number);
            }
        }
    }
    OccluderTree tree = buildOccluderTree(triangles, cutout);
    tree.cutouts = collector.take();
    return tree;
}

} // namespace limn
