// SPDX-License-Identifier: MIT
#include "engine/bake/cut.h"

#include "engine/core/parallel.h"
#include "engine/math/cone.h"
#include "engine/math/packing.h"
#include "engine/math/sh.h"

#include <algorithm>
#include <numbers>

#include <tbb/enumerable_thread_specific.h>

namespace limn {

namespace {

/// A link before packing.
struct Cone {
    std::uint32_t node;
    glm::vec3 direction; ///< unit
    float u;             ///< 1 - cos(half-angle)
    float transport;     ///< visible solid angle / pi
    float irradiance; ///< exact, at unit radiosity: the rays' sum of solid angle / pi times cosine
};

Link pack(const Cone& cone) {
    const Oct16 d = packOct(cone.direction);
    return {cone.node, d.x, d.y, floatToHalf(cone.u), floatToHalf(cone.transport)};
}

/// Sums over the part of the tree that one cache sees. Dense over all nodes; only touched ones are
/// reset.
class VisibleTree {
public:
    explicit VisibleTree(const ClusterTree& tree)
        : m_tree(tree), m_weight(tree.size()), m_cosine(tree.size()), m_moment(tree.size()) {}

    /// `weight`: solid angle / pi seen along `direction`, at `cosTheta` to the surface that sees
    /// it.
    void add(std::uint32_t leaf, float weight, float cosTheta, glm::vec3 direction) {
        if (m_weight[leaf] == 0)
            m_touched.push_back(leaf);
        m_weight[leaf] += weight;
        m_cosine[leaf] += weight * cosTheta;
        m_moment[leaf] += direction * weight;
    }

    /// Carries the leaves' sums up to the root: children come before parents.
    void pull() {
        const std::size_t leaves = m_touched.size();
        for (std::size_t i = 0; i < leaves; ++i)
            for (std::uint32_t node = m_tree.parent[m_touched[i]];
                 node != ~0U && m_weight[node] == 0; node = m_tree.parent[node]) {
                m_weight[node] = kMarked;
                m_touched.push_back(node);
            }
        std::sort(m_touched.begin(), m_touched.end());
        for (const std::uint32_t node : m_touched)
            if (const std::uint32_t parent = m_tree.parent[node]; parent != ~0U) {
                m_weight[parent] += m_weight[node];
                m_cosine[parent] += m_cosine[node];
                m_moment[parent] += m_moment[node];
            }
    }

    void clear() {
        for (const std::uint32_t node : m_touched) {
            m_weight[node] = m_cosine[node] = 0;
            m_moment[node] = glm::vec3(0);
        }
        m_touched.clear();
    }

    void cut(std::uint32_t maxLinks, float rayWeight, std::vector<Cone>& cones);

private:
    /// Far below any ray's weight, far above 0: says that an inner node was reached.
    static constexpr float kMarked = 1e-20f;

    Cone makeCone(std::uint32_t node, float rayWeight) const {
        const float weight = m_weight[node], length = glm::length(m_moment[node]);
        // The mean cosine of a cone is 1 - u/2, so this cone has the sum's first two bands; a
        // single ray has its own solid angle: rayWeight pi = 2 pi u.
        const float u = std::clamp(2 * (1 - length / weight), std::min(rayWeight / 2, 2.f), 2.f);
        return {node, length > 0 ? m_moment[node] / length : glm::vec3(0, 0, 1), u, weight,
                m_cosine[node]};
    }

    const ClusterTree& m_tree;
    std::vector<float> m_weight, m_cosine;
    std::vector<glm::vec3> m_moment;
    std::vector<std::uint32_t> m_touched;
    std::vector<std::pair<float, std::uint32_t>> m_heap;
};

void VisibleTree::cut(std::uint32_t maxLinks, float rayWeight, std::vector<Cone>& cones) {
    cones.clear();
    m_heap.clear();
    const std::uint32_t root = m_tree.size() - 1;
    std::uint32_t count = 0;
    const auto put = [&](std::uint32_t node) {
        if (m_weight[node] == 0)
            return;
        ++count;
        if (node < m_tree.leaves()) {
            cones.push_back(makeCone(node, rayWeight));
            return;
        }
        m_heap.emplace_back(m_weight[node], ~node); // equal weights: the lower node first
        std::push_heap(m_heap.begin(), m_heap.end());
    };
    put(root);
    while (!m_heap.empty()) {
        std::pop_heap(m_heap.begin(), m_heap.end());
        const std::uint32_t node = ~m_heap.back().second, inner = node - m_tree.leaves();
        m_heap.pop_back();
        const std::uint32_t l = m_tree.left[inner], r = m_tree.right[inner];
        const std::uint32_t children = (m_weight[l] > 0) + (m_weight[r] > 0);
        if (count - 1 + children > maxLinks) {
            cones.push_back(makeCone(node, rayWeight));
            continue;
        }
        --count;
        put(l);
        put(r);
    }
    std::sort(cones.begin(), cones.end(),
              [](const Cone& a, const Cone& b) { return a.node < b.node; });
}

/// Scales each link of a surface cache so that its sender brings, through the SH, exactly the
/// cosine-weighted irradiance of its rays to a surface of the cache's own normal. Three bands of
/// the clamped cosine are 6 % too strong for light along the normal, 8 % too weak at 60 degrees and
/// leave 9 % at 90, and a round cone is too tall for a cluster seen along the surface. Without this
/// a wall lit from the side comes out up to a tenth too bright. The factor differs from 1 by no
/// more than those errors of the truncated series; radiance seen by other normals changes as much.
void matchIrradiance(int bands, glm::vec3 normal, std::vector<Cone>& cones) {
    const auto factors = irradianceFactors();
    float axis[kMaxCoefficients], y[kMaxCoefficients], g[kMaxBands];
    shBasis(bands, normal, axis);
    for (Cone& cone : cones) {
        shBasis(bands, cone.direction, y);
        coneFactors(bands, cone.u, g);
        float series = 0;
        for (int l = 0, i = 0; l < bands; ++l) {
            float band = 0;
            for (; i < (l + 1) * (l + 1); ++i)
                band += y[i] * axis[i];
            series += factors[std::size_t(l)] * g[l] * band;
        }
        constexpr float kMostGain = 2; // where the series is near zero along the surface
        cone.transport *=
            series > 0 ? std::min(cone.irradiance / (cone.transport * series), kMostGain) : 1;
    }
}

/// One thread's working space for linking caches.
struct Linker {
    const ClusterTree& tree;
    const GatherHits& hits;
    const CachePoints& points;
    std::uint32_t maxLinks;
    int bands;
    VisibleTree seen{tree};
    std::vector<Cone> cones;

    void link(const Caches& caches, std::uint32_t cache, std::vector<Link>& links) {
        const std::uint32_t* sender = hits.sender.data() + std::size_t(cache) * hits.rays;
        const auto kept =
            hits.rays - std::uint32_t(std::count(sender, sender + hits.rays, GatherHits::kLeftOut));
        if (kept == 0)
            return;
        const CacheRays rays = raysOf(caches, points, cache, hits.rays);
        const float weight =
            rays.local.solidAngle() / std::numbers::pi_v<float> * (float(hits.rays) / float(kept));
        for (std::uint32_t r = 0; r < hits.rays; ++r)
            if (sender[r] < GatherHits::kFirstMark) {
                const glm::vec3 local = rays.local[r];
                seen.add(sender[r], weight, local.z, rays.toWorld[r % rays.points] * local);
            }
        for (std::uint32_t k = hits.aimedBegin[cache]; k < hits.aimedBegin[cache + 1]; ++k) {
            const AimedSample& a = hits.aimed[k];
            seen.add(a.sender, a.transport, a.cosTheta, a.direction);
        }
        seen.pull();
        seen.cut(maxLinks, weight, cones);
        seen.clear();
        if (caches.kind[cache] == CacheKind::Hemisphere)
            matchIrradiance(bands, caches.normal[cache], cones);
        for (const Cone& cone : cones)
            links.push_back(pack(cone));
    }
};

} // namespace

void weighBySight(const GatherHits& hits, ClusterTree& tree) {
    std::vector<double> seen(tree.size());
    for (const std::uint32_t sender : hits.sender)
        if (sender < GatherHits::kFirstMark)
            seen[sender] +=
                2.0 / hits.rays; // a hemisphere's ray; a sphere's weighs twice that, near enough
    for (const AimedSample& a : hits.aimed)
        seen[a.sender] += double(a.transport);
    for (std::size_t k = 0; k < tree.left.size(); ++k) {
        const double l = seen[tree.left[k]], r = seen[tree.right[k]];
        seen[tree.leaves() + k] = l + r;
        if (l + r > 0)
            tree.leftWeight[k] = float(l / (l + r));
    }
}

bool buildLinks(const ClusterTree& tree, const GatherHits& hits, const CachePoints& points,
                std::uint32_t maxLinks, int bands, const Progress& progress, Caches& caches) {
    std::vector<std::vector<Link>> links(caches.size());
    tbb::enumerable_thread_specific<Linker> scratch([&] {
        return Linker{tree, hits, points, maxLinks, bands};
    });
    const bool done =
        parallelRanges(caches.size(), 8, progress, "cut", [&](std::size_t begin, std::size_t end) {
            Linker& linker = scratch.local();
            for (std::size_t c = begin; c < end; ++c)
                linker.link(caches, std::uint32_t(c), links[c]);
        });
    if (!done)
        return false;
    caches.linkBegin = {0};
    caches.links.clear();
    for (const std::vector<Link>& l : links) {
        caches.links.insert(caches.links.end(), l.begin(), l.end());
        caches.linkBegin.push_back(std::uint32_t(caches.links.size()));
    }
    return true;
}

std::uint32_t fillInvalid(Caches& caches) {
    constexpr std::size_t kSources = 4;
    std::uint32_t invalid = 0;
    const auto valid = [&](std::uint32_t c) {
        return caches.linkBegin[c] < caches.linkBegin[c + 1];
    };
    std::vector<std::uint32_t> candidates;
    for (std::uint32_t c = 0; c < caches.size(); ++c)
        if (valid(c))
            candidates.push_back(c);
    std::vector<std::vector<std::pair<float, std::uint32_t>>> sources(caches.size());
    parallelRanges(caches.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c) {
            if (valid(std::uint32_t(c)))
                continue;
            auto& best = sources[c];
            for (const std::uint32_t other : candidates) {
                if ((caches.kind[other] == CacheKind::Grid) != (caches.kind[c] == CacheKind::Grid))
                    continue;
                const glm::vec3 d = caches.position[other] - caches.position[c];
                // Normals apart count as a longer way: eight times at right angles and beyond.
                const float agree =
                    caches.kind[c] == CacheKind::Grid
                        ? 1.f
                        : std::max(glm::dot(caches.normal[other], caches.normal[c]), 1.f / 64);
                const std::pair<float, std::uint32_t> entry{glm::dot(d, d) / agree, other};
                if (best.size() == kSources && !(entry < best.back()))
                    continue;
                best.insert(std::upper_bound(best.begin(), best.end(), entry), entry);
                if (best.size() > kSources)
                    best.pop_back();
            }
        }
    });
    caches.fillBegin = {0};
    for (std::uint32_t c = 0; c < caches.size(); ++c) {
        invalid += valid(c) ? 0 : 1;
        double sum = 0;
        const double nearest = sources[c].empty() ? 1 : std::max(sources[c][0].first, 1e-30f);
        for (const auto& [distance2, source] : sources[c])
            sum += nearest / std::max(double(distance2), nearest);
        for (const auto& [distance2, source] : sources[c]) {
            caches.fillSource.push_back(source);
            caches.fillWeight.push_back(
                float(nearest / std::max(double(distance2), nearest) / sum));
        }
        caches.fillBegin.push_back(std::uint32_t(caches.fillSource.size()));
    }
    return invalid;
}

} // namespace limn
