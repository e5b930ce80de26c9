// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/links/surfel_gain.h"

#include "engine/core/parallel.h"
#include "engine/math/horizon.h"
#include "engine/math/sh.h"
#include "engine/math/sh_basis.h"
#include "engine/techniques/illuminance/format/link_storage.h"

#include <algorithm>
#include <array>

namespace limn {

namespace {

using IrradianceSh = std::array<float, kIrradianceBands * kIrradianceBands>;

/// The SH of a valid cache c when every node has a radiosity of 1, below its surface too.
IrradianceSh sumOfLinks(const Caches& caches, std::uint32_t c, int bands) {
    IrradianceSh sum{}, link{};
    for (std::uint32_t k = caches.linkBegin[c]; k < caches.linkBegin[c + 1]; ++k) {
        expandLink(caches, c, k, bands, link.data());
        for (std::size_t i = 0; i < sum.size(); ++i)
            sum[i] += link[i];
    }
    continueBelow(caches.normal[c], sum.data());
    return sum;
}

/// The same for each lightmap cache; invalid caches take theirs from their sources.
std::vector<IrradianceSh> furnaceSh(const Caches& caches, int bands) {
    std::vector<IrradianceSh> sh(caches.lightmapCount);
    parallelRanges(sh.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c)
            sh[c] = sumOfLinks(caches, std::uint32_t(c), bands);
    });
    for (std::size_t c = 0; c < sh.size(); ++c)
        for (std::uint32_t k = caches.fillBegin[c]; k < caches.fillBegin[c + 1]; ++k)
            for (std::size_t i = 0; i < sh[c].size(); ++i)
                sh[c][i] += caches.fillWeight[k] * sh[caches.fillSource[k]][i];
    return sh;
}

} // namespace

std::vector<float> furnaceIrradiance(const Surfels& surfels, const Caches& caches, int bands) {
    bands = std::min(bands, kIrradianceBands);
    const std::vector<IrradianceSh> sh = furnaceSh(caches, bands);
    const std::array<float, kMaxBands> factor = irradianceFactors();
    std::vector<float> irradiance(surfels.size());
    parallelRanges(surfels.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t s = begin; s < end; ++s) {
            IrradianceSh basis{};
            shBasis(bands, surfels.normal[s], basis.data());
            for (int k = 0; k < 4; ++k)
                if (const std::uint32_t c = surfels.cache[s][k]; c != ~0U)
                    for (int l = 0, i = 0; l < bands; ++l)
                        for (; i < (l + 1) * (l + 1); ++i)
                            irradiance[s] += surfels.cacheWeight[s][k] * factor[std::size_t(l)] *
                                             basis[std::size_t(i)] * sh[c][std::size_t(i)];
        }
    });
    return irradiance;
}

void limitGain(const Caches& caches, int bands, Surfels& surfels) {
    const std::vector<float> irradiance = furnaceIrradiance(surfels, caches, bands);
    for (std::size_t s = 0; s < surfels.size(); ++s)
        if (irradiance[s] > 1)
            surfels.cacheWeight[s] /= irradiance[s];
}

} // namespace limn
