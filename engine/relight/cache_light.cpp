// SPDX-License-Identifier: MIT
#include "engine/relight/cache_light.h"

#include "engine/core/parallel.h"
#include "engine/math/cone.h"
#include "engine/math/packing.h"
#include "engine/math/sh_basis.h"

#include <algorithm>
#include <cmath>

namespace limn {

void pullRadiosity(const ClusterTree& tree, std::vector<glm::vec3>& radiosity) {
    const std::uint32_t leaves = tree.leaves();
    for (std::size_t k = 0; k < tree.left.size(); ++k) {
        const glm::vec3 l = radiosity[tree.left[k]], r = radiosity[tree.right[k]];
        radiosity[leaves + k] = r + (l - r) * tree.leftWeight[k];
    }
}

namespace {

/// Adds what one link brings to the planar sums r, g, b.
template <int Bands>
inline void addLink(const Link& link, glm::vec3 radiosity, float* __restrict r, float* __restrict g,
                    float* __restrict b) {
    glm::vec3 d = unpackOctUnnormalised(link.octX, link.octY);
    d *= 1 / std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
    float y[Bands * Bands], cone[Bands];
    shBasisFixed<Bands>(d, y);
    coneFactors(Bands, halfToFloat(link.u), cone);
    const glm::vec3 flux = radiosity * halfToFloat(link.transport);
    for (int l = 0, i = 0; l < Bands; ++l)
        for (; i < (l + 1) * (l + 1); ++i) {
            const float basis = cone[l] * y[i];
            r[i] += flux.x * basis;
            g[i] += flux.y * basis;
            b[i] += flux.z * basis;
        }
}

template <int Bands>
void lightCache(const Caches& caches, const std::vector<glm::vec3>& radiosity, std::uint32_t c,
                glm::vec3* out) {
    float r[Bands * Bands] = {}, g[Bands * Bands] = {}, b[Bands * Bands] = {};
    for (std::uint32_t k = caches.linkBegin[c]; k < caches.linkBegin[c + 1]; ++k)
        addLink<Bands>(caches.links[k], radiosity[caches.links[k].node], r, g, b);
    for (int i = 0; i < Bands * Bands; ++i)
        out[i] = {r[i], g[i], b[i]};
}

} // namespace

void lightCaches(const Caches& caches, const std::vector<glm::vec3>& radiosity, int bands,
                 std::uint32_t begin, std::uint32_t end, std::vector<glm::vec3>& sh) {
    const auto coefficients = std::size_t(bands * bands);
    parallelRanges(end - begin, 64, [&](std::size_t first, std::size_t last) {
        withBands(bands, [&]<int Bands>() {
            for (std::size_t c = begin + first; c < begin + last; ++c)
                lightCache<Bands>(caches, radiosity, std::uint32_t(c),
                                  sh.data() + c * coefficients);
        });
    });
}

void fillInvalidCaches(const Caches& caches, int bands, std::uint32_t begin, std::uint32_t end,
                       std::vector<glm::vec3>& sh) {
    const auto coefficients = std::size_t(bands * bands);
    for (std::size_t c = begin; c < end; ++c) {
        if (caches.fillBegin[c] == caches.fillBegin[c + 1])
            continue;
        glm::vec3* out = sh.data() + c * coefficients;
        std::fill(out, out + coefficients, glm::vec3(0));
        for (std::uint32_t k = caches.fillBegin[c]; k < caches.fillBegin[c + 1]; ++k) {
            const glm::vec3* source = sh.data() + std::size_t(caches.fillSource[k]) * coefficients;
            for (std::size_t i = 0; i < coefficients; ++i)
                out[i] += source[i] * caches.fillWeight[k];
        }
    }
}

} // namespace limn
