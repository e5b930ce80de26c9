// SPDX-License-Identifier: MIT
#include "engine/relight/cache_light.h"

#include "engine/core/parallel.h"
#include "engine/math/cone.h"
#include "engine/math/packing.h"
#include "engine/math/sh_basis.h"
#include "engine/math/ycocg.h"

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

/// Kept inner loops a multiple of this long, so that they fill vector registers.
constexpr int kLanes = 4;

/// What radiosity 1 of link k adds to its cache's SH, times the cache's scale. Returns its node.
template <int Bands>
inline std::uint32_t expandCone(const Caches& caches, std::uint32_t k, float* __restrict basis) {
    const Link& link = caches.links[k];
    glm::vec3 d = unpackOctUnnormalised(link.octX, link.octY);
    d *= 1 / std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z);
    float cone[Bands];
    shBasisFixed<Bands>(d, basis);
    coneFactors(Bands, halfToFloat(link.u), cone);
    const float transport = halfToFloat(link.transport);
    for (int l = 0, i = 0; l < Bands; ++l)
        for (; i < (l + 1) * (l + 1); ++i)
            basis[i] *= transport * cone[l];
    return link.node;
}

template <int Bands>
inline std::uint32_t readHarmonics(const Caches& caches, std::uint32_t k, float* __restrict basis) {
    constexpr std::size_t kCount = Bands * Bands;
    const std::uint16_t* __restrict halfs = caches.shCoefficients.data() + k * kCount;
    for (std::size_t i = 0; i < kCount; ++i)
        basis[i] = halfToFloat(halfs[i]);
    return caches.shNode[k];
}

template <int Bands, LinkStorage Storage>
inline std::uint32_t linkBasis(const Caches& caches, std::uint32_t k, float* __restrict basis) {
    if constexpr (Storage == LinkStorage::Rtp)
        return expandCone<Bands>(caches, k, basis);
    else
        return readHarmonics<Bands>(caches, k, basis);
}

// One colour after the other: loops over three arrays at once are not vectorised.
template <int Count>
inline void addScaled(float factor, const float* __restrict values, float* __restrict sums) {
    for (int i = 0; i < Count; ++i)
        sums[i] += factor * values[i];
}

// Not inlined: the compiler would take the sums apart by coefficient and give up on vectors.
[[gnu::noinline]] void writeRgb(int count, const float* r, const float* g, const float* b,
                                float scale, glm::vec3* out) {
    for (int i = 0; i < count; ++i)
        out[i] = glm::vec3(r[i], g[i], b[i]) * scale;
}

/// All of a cache's bands in three colours.
template <int Bands, LinkStorage Storage>
void lightCache(const Caches& caches, const std::vector<glm::vec3>& radiosity, std::uint32_t c,
                glm::vec3* out) {
    constexpr int kCount = Bands * Bands;
    float r[kCount] = {}, g[kCount] = {}, b[kCount] = {}, basis[kCount];
    for (std::uint32_t k = caches.linkBegin[c]; k < caches.linkBegin[c + 1]; ++k) {
        const glm::vec3 from = radiosity[linkBasis<Bands, Storage>(caches, k, basis)];
        addScaled<kCount>(from.x, basis, r);
        addScaled<kCount>(from.y, basis, g);
        addScaled<kCount>(from.z, basis, b);
    }
    writeRgb(kCount, r, g, b, std::ldexp(1.f, -caches.linkExponent[c]), out);
}

/// All of a cache's bands of luma, the first `chroma` coefficients of chrominance.
template <int Bands, LinkStorage Storage>
void lightCacheYCoCg(const Caches& caches, const std::vector<glm::vec3>& radiosity, std::uint32_t c,
                     int chroma, glm::vec3* out) {
    constexpr int kCount = Bands * Bands;
    // Rounded up to whole lanes, `chroma` stays within them: it is at most (Bands - 1)^2.
    float y[kCount] = {}, co[kCount] = {}, cg[kCount] = {}, basis[kCount];
    for (std::uint32_t k = caches.linkBegin[c]; k < caches.linkBegin[c + 1]; ++k) {
        const YCoCg from = toYCoCg(radiosity[linkBasis<Bands, Storage>(caches, k, basis)]);
        addScaled<kCount>(from.y, basis, y);
        for (int i = 0; i < chroma; i += kLanes) {
            addScaled<kLanes>(from.co, basis + i, co + i);
            addScaled<kLanes>(from.cg, basis + i, cg + i);
        }
    }
    std::fill(co + chroma, co + kCount, 0.f);
    std::fill(cg + chroma, cg + kCount, 0.f);
    for (int i = 0; i < kCount; ++i) {
        const glm::vec3 rgb = toRgb({y[i], co[i], cg[i]});
        y[i] = rgb.x, co[i] = rgb.y, cg[i] = rgb.z;
    }
    writeRgb(kCount, y, co, cg, std::ldexp(1.f, -caches.linkExponent[c]), out);
}

} // namespace

void lightCaches(const Caches& caches, const std::vector<glm::vec3>& radiosity, LightBands bands,
                 std::uint32_t begin, std::uint32_t end, std::vector<glm::vec3>& sh) {
    const auto coefficients = std::size_t(bands.luma * bands.luma);
    const auto light = [&]<int Bands, LinkStorage Storage>(std::uint32_t c) {
        glm::vec3* out = sh.data() + c * coefficients;
        if constexpr (Bands > 1)
            if (bands.chroma < Bands)
                return lightCacheYCoCg<Bands, Storage>(caches, radiosity, c,
                                                       bands.chroma * bands.chroma, out);
        lightCache<Bands, Storage>(caches, radiosity, c, out);
    };
    parallelRanges(end - begin, 64, [&](std::size_t first, std::size_t last) {
        withBands(bands.luma, [&]<int Bands>() {
            for (std::size_t c = begin + first; c < begin + last; ++c)
                if (caches.shNode.empty())
                    light.template operator()<Bands, LinkStorage::Rtp>(std::uint32_t(c));
                else
                    light.template operator()<Bands, LinkStorage::Sh>(std::uint32_t(c));
        });
    });
}

void dropChroma(LightBands bands, std::uint32_t begin, std::uint32_t end,
                std::vector<glm::vec3>& sh) {
    const auto coefficients = std::size_t(bands.luma * bands.luma),
               kept = std::size_t(bands.chroma * bands.chroma);
    for (std::size_t c = begin; c < end; ++c)
        for (std::size_t i = kept; i < coefficients; ++i)
            sh[c * coefficients + i] = glm::vec3(toYCoCg(sh[c * coefficients + i]).y);
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
