// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/relight/caches/cache_light.h"

#include "engine/core/parallel.h"
#include "engine/math/horizon.h"
#include "engine/techniques/illuminance/format/sky_cells.h"

#include <algorithm>
#include <atomic>

namespace limn {

void pullRadiosity(const ClusterTree& tree, std::vector<glm::vec4>& radiosity) {
    const std::uint32_t leaves = tree.leaves();
    for (std::size_t k = 0; k < tree.left.size(); ++k) {
        const glm::vec4 l = radiosity[tree.left[k]], r = radiosity[tree.right[k]];
        // Not r + (l - r) w, which would leave the rounding of a lamp in r of weight 0 in a dark l.
        radiosity[leaves + k] = l * tree.leftWeight[k] + r * (1 - tree.leftWeight[k]);
    }
}

std::vector<std::uint32_t> allLinks(const Caches& caches) {
    return {caches.linkBegin.begin() + 1, caches.linkBegin.end()};
}

std::vector<std::uint32_t> linksBeforeSky(const Caches& caches, const ClusterTree& tree) {
    const std::vector<bool> sky = skyNodes(tree);
    const auto nodeOf = [&](std::uint32_t k) {
        return caches.shNode.empty() ? caches.links[k].node : caches.shNode[k];
    };
    std::vector<std::uint32_t> ends = allLinks(caches);
    for (std::size_t c = 0; c < caches.size(); ++c)
        while (ends[c] > caches.linkBegin[c] && sky[nodeOf(ends[c] - 1)])
            --ends[c];
    return ends;
}

template <class Body>
static void forEachCache(const CacheRuns& runs, const Body& body) {
    parallelRanges(runs.size(), 4, [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k)
            for (std::size_t c = runs[k].begin; c < runs[k].end; ++c)
                body(c);
    });
}

LinkCounts lightCaches(const Caches& caches, LinkEnds ends, const std::vector<glm::vec4>& radiosity,
                       LightBands bands, const CacheRuns& runs, std::vector<glm::vec3>& sh,
                       LinkHalfs halfs) {
    if (halfs.empty())
        halfs = caches.shCoefficients;
    std::atomic<std::uint64_t> skipped = 0;
    parallelRanges(runs.size(), 1, [&](std::size_t first, std::size_t last) {
        std::uint64_t over = 0;
        for (std::size_t k = first; k < last; ++k) {
            const auto [begin, end] = runs[k];
            if (caches.shNode.empty())
                over += lightCones(caches, ends, radiosity, bands, begin, end, sh.data());
            else
                lightHarmonics(caches, ends, radiosity, bands, halfs, begin, end, sh.data());
            for (std::uint32_t c = begin; c < end; ++c)
                over += caches.linkBegin[c + 1] - ends[c];
        }
        skipped += over;
    });
    std::uint64_t links = 0;
    for (const CacheRun& run : runs)
        links += caches.linkBegin[run.end] - caches.linkBegin[run.begin];
    return {links, skipped};
}

void placeCache(const Caches& caches, const std::vector<glm::vec3>& sh, std::size_t c,
                std::size_t coefficients, std::size_t stride, std::vector<glm::vec4>& out) {
    for (std::size_t i = 0; i < coefficients; ++i)
        out[i * stride + caches.texel[c]] = glm::vec4(sh[c * coefficients + i], 0);
}

void continueCaches(const Caches& caches, int bands, const CacheRuns& runs,
                    std::vector<glm::vec3>& sh) {
    const auto coefficients = std::size_t(bands * bands);
    forEachCache(runs, [&](std::size_t c) {
        if (c < caches.lightmapCount)
            continueBelow(caches.normal[c], sh.data() + c * coefficients);
    });
}

std::vector<std::uint16_t> firstHalfs(const Caches& caches, int bands) {
    const std::size_t links = caches.shNode.size(), kept = std::size_t(bands * bands);
    if (links == 0)
        return {};
    const std::size_t stored = caches.shCoefficients.size() / links;
    std::vector<std::uint16_t> halfs(links * kept);
    parallelRanges(links, 1 << 16, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k)
            std::copy_n(caches.shCoefficients.begin() + std::ptrdiff_t(k * stored), kept,
                        halfs.begin() + std::ptrdiff_t(k * kept));
    });
    return halfs;
}

void dropChroma(LightBands bands, const CacheRuns& runs, std::vector<glm::vec3>& sh) {
    const auto coefficients = std::size_t(bands.luma * bands.luma),
               kept = std::size_t(bands.chroma * bands.chroma);
    forEachCache(runs, [&](std::size_t c) {
        for (std::size_t i = kept; i < coefficients; ++i)
            sh[c * coefficients + i] = glm::vec3(toYCoCg(sh[c * coefficients + i]).y);
    });
}

void fillInvalidCaches(const Caches& caches, int bands, const CacheRuns& runs,
                       std::vector<glm::vec3>& sh) {
    const auto coefficients = std::size_t(bands * bands);
    forEachCache(runs, [&](std::size_t c) {
        if (caches.fillBegin[c] == caches.fillBegin[c + 1])
            return;
        glm::vec3* out = sh.data() + c * coefficients;
        std::fill(out, out + coefficients, glm::vec3(0));
        for (std::uint32_t k = caches.fillBegin[c]; k < caches.fillBegin[c + 1]; ++k) {
            const glm::vec3* source = sh.data() + std::size_t(caches.fillSource[k]) * coefficients;
            for (std::size_t i = 0; i < coefficients; ++i)
                out[i] += source[i] * caches.fillWeight[k];
        }
    });
}

} // namespace limn
