// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/relight/adjoint.h"

#include "engine/core/parallel.h"
#include "engine/math/cone.h"
#include "engine/math/horizon.h"
#include "engine/math/packing.h"
#include "engine/math/sh_basis.h"
#include "engine/techniques/illuminance/relight/caches/weigh_links.h"

#include <algorithm>
#include <map>

#include <glm/geometric.hpp>

namespace limn {

namespace {

/// Parts into which caches are split. Each part sums its weights on its own, so that sums do not
/// depend on the number of threads.
constexpr std::size_t kParts = 16;

/// What a radiosity of 1 at link k adds to the SH of its cache, divided by linkScale().
template <int Bands>
void expandHalfs(const RelightState& s, std::uint32_t k, float* coefficients) {
    if (!s.links.shNode.empty()) {
        const std::size_t stored = s.halfs.size() / s.links.shNode.size();
        for (std::size_t i = 0; i < std::size_t(Bands * Bands); ++i)
            coefficients[i] = halfToFloat(s.halfs[k * stored + i]);
        return;
    }
    const Link& link = s.links.links[k];
    float g[Bands];
    const glm::vec3 d = unpackOctUnnormalised(link.octX, link.octY);
    shBasisFixed<Bands>(d * glm::inversesqrt(glm::dot(d, d)), coefficients);
    coneFactors(Bands, halfToFloat(link.u), g);
    const float transport = halfToFloat(link.transport);
    for (int l = 0, i = 0; l < Bands; ++l)
        for (const float factor = transport * g[l]; i < (l + 1) * (l + 1); ++i)
            coefficients[i] *= factor;
}

/// Adds a cache's weights to those of the nodes that it links.
template <int Bands>
void addLinks(const RelightState& s, std::uint32_t c, const glm::vec3* weight,
              std::vector<glm::vec3>& nodes) {
    constexpr int kCount = Bands * Bands;
    const float scale = linkScale(s.links, c);
    glm::vec3 scaled[kCount];
    for (int i = 0; i < kCount; ++i)
        scaled[i] = weight[i] * scale;
    const bool cones = s.links.shNode.empty();
    for (std::uint32_t k = s.links.linkBegin[c]; k < s.ends[c]; ++k) {
        float coefficients[kCount];
        expandHalfs<Bands>(s, k, coefficients);
        glm::vec3 sum(0);
        for (int i = 0; i < kCount; ++i)
            sum += scaled[i] * coefficients[i];
        nodes[cones ? s.links.links[k].node : s.links.shNode[k]] += sum;
    }
}

/// Transpose of continueCaches() for one cache: turns weights of its light into weights of what its
/// links bring.
void weighLinked(const Caches& caches, std::uint32_t c, glm::vec3* weight) {
    if (c < caches.lightmapCount)
        weighContinued(caches.normal[c], weight);
}

/// The same as addLinks() for a cache that surfels read.
void addInnerLinks(const RelightState& s, std::uint32_t c, const glm::vec3* weight,
                   std::vector<glm::vec3>& nodes) {
    if (s.links.shNode.empty())
        weighCones(s.links, s.ends, c, {weight, std::size_t(s.inner.luma * s.inner.luma)}, nodes);
    else if (s.inner.luma < kIrradianceBands)
        addLinks<2>(s, c, weight, nodes);
    else
        addLinks<kIrradianceBands>(s, c, weight, nodes);
}

} // namespace

std::vector<CacheWeight> validCaches(const Caches& caches, std::span<const CacheWeight> weights) {
    std::map<std::uint32_t, CacheWeight> found;
    const auto add = [&](std::uint32_t cache, const CacheWeight& from, float share) {
        CacheWeight& to = found.try_emplace(cache, CacheWeight{.cache = cache}).first->second;
        for (std::size_t i = 0; i < to.coefficient.size(); ++i)
            to.coefficient[i] += from.coefficient[i] * share;
    };
    for (const CacheWeight& w : weights) {
        const std::uint32_t begin = caches.fillBegin[w.cache], end = caches.fillBegin[w.cache + 1];
        if (begin == end)
            add(w.cache, w, 1);
        for (std::uint32_t k = begin; k < end; ++k)
            add(caches.fillSource[k], w, caches.fillWeight[k]);
    }
    std::vector<CacheWeight> valid;
    for (const auto& [cache, weight] : found)
        valid.push_back(weight);
    return valid;
}

void weighGrey(int bands, int chroma, std::span<glm::vec3> coefficients) {
    const glm::vec3 luma(0.25f, 0.5f, 0.25f); // toYCoCg()
    for (int i = chroma * chroma; i < bands * bands; ++i) {
        glm::vec3& c = coefficients[std::size_t(i)];
        c = luma * (c.x + c.y + c.z);
    }
}

std::vector<glm::vec3> linkedNodes(const RelightState& state,
                                   std::span<const CacheWeight> weights) {
    std::vector<glm::vec3> nodes(state.radiosity.size(), glm::vec3(0));
    withBands(state.bands, [&]<int Bands>() {
        for (CacheWeight w : weights) {
            weighLinked(state.bake.caches, w.cache, w.coefficient.data());
            addLinks<Bands>(state, w.cache, w.coefficient.data(), nodes);
        }
    });
    return nodes;
}

void pushWeights(const ClusterTree& tree, std::vector<glm::vec3>& nodes) {
    for (std::size_t k = tree.left.size(); k-- > 0;) {
        const glm::vec3 w = nodes[tree.leaves() + k];
        nodes[tree.left[k]] += w * tree.leftWeight[k];
        nodes[tree.right[k]] += w * (1 - tree.leftWeight[k]);
    }
}

BounceAdjoint::BounceAdjoint(const RelightState& state) : m_state(state) {
    const Surfels& surfels = state.bake.surfels;
    const Caches& caches = state.bake.caches;
    const auto forEachRead = [&](const auto& f) {
        for (std::uint32_t s = 0; s < surfels.size(); ++s)
            for (int k = 0; k < 4; ++k) {
                const std::uint32_t c = surfels.cache[s][k];
                const float weight = surfels.cacheWeight[s][k];
                if (c == ~0U || !(weight > 0))
                    continue;
                if (caches.fillBegin[c] == caches.fillBegin[c + 1])
                    f(c, Reader{s, weight});
                for (std::uint32_t i = caches.fillBegin[c]; i < caches.fillBegin[c + 1]; ++i)
                    f(caches.fillSource[i], Reader{s, weight * caches.fillWeight[i]});
            }
    };
    m_begin.assign(caches.size() + 1, 0);
    forEachRead([&](std::uint32_t c, Reader) { ++m_begin[c + 1]; });
    for (std::size_t c = 0; c < caches.size(); ++c)
        m_begin[c + 1] += m_begin[c];
    m_readers.resize(m_begin.back());
    std::vector<std::uint32_t> next(m_begin.begin(), m_begin.end() - 1);
    forEachRead([&](std::uint32_t c, Reader reader) { m_readers[next[c]++] = reader; });

    const std::array<float, kMaxBands> band = irradianceFactors();
    m_factors.resize(surfels.size());
    parallelRanges(surfels.size(), 512, [&](std::size_t begin, std::size_t end) {
        for (std::size_t s = begin; s < end; ++s) {
            shBasisFixed<kIrradianceBands>(surfels.normal[s], m_factors[s].data());
            for (int l = 0, i = 0; l < kIrradianceBands; ++l)
                for (; i < (l + 1) * (l + 1); ++i)
                    m_factors[s][std::size_t(i)] *= l < state.inner.luma ? band[std::size_t(l)] : 0;
        }
    });
}

std::vector<glm::vec3> BounceAdjoint::operator()(std::span<const glm::vec3> irradiance) const {
    const RelightState& state = m_state;
    const std::size_t caches = state.bake.caches.size(), nodes = state.radiosity.size();
    std::vector<std::vector<glm::vec3>> parts(kParts);
    parallelRanges(kParts, 1, [&](std::size_t first, std::size_t last) {
        for (std::size_t part = first; part < last; ++part) {
            std::vector<glm::vec3>& mine = parts[part];
            mine.assign(nodes, glm::vec3(0));
            for (std::size_t c = part * caches / kParts; c < (part + 1) * caches / kParts; ++c) {
                if (m_begin[c] == m_begin[c + 1])
                    continue;
                glm::vec3 weight[kCoefficients] = {};
                for (std::uint32_t k = m_begin[c]; k < m_begin[c + 1]; ++k) {
                    const Reader reader = m_readers[k];
                    const glm::vec3 w = irradiance[reader.surfel] * reader.weight;
                    for (std::size_t i = 0; i < kCoefficients; ++i)
                        weight[i] += w * m_factors[reader.surfel][i];
                }
                weighGrey(state.inner.luma, state.inner.chroma, weight);
                weighLinked(state.bake.caches, std::uint32_t(c), weight);
                addInnerLinks(state, std::uint32_t(c), weight, mine);
            }
        }
    });
    std::vector<glm::vec3> sum(nodes, glm::vec3(0));
    parallelRanges(nodes, 4096, [&](std::size_t begin, std::size_t end) {
        for (const std::vector<glm::vec3>& part : parts)
            for (std::size_t n = begin; n < end; ++n)
                sum[n] += part[n];
    });
    pushWeights(state.bake.tree, sum);
    sum.resize(state.bake.tree.leaves());
    return sum;
}

} // namespace limn
