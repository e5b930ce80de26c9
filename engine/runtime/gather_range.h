// SPDX-License-Identifier: MIT
// The sums over links. Included once by each source that defines LIMNRT_LANES, within the
// instructions that these lanes need.
#pragma once

#include "engine/runtime/gather_sums.h"
#include "engine/runtime/monic_scale.h"

namespace limn::runtime {
namespace {

template <int Bands>
void gatherBands(const Gather& g, std::uint32_t begin, std::uint32_t end) {
    constexpr int kCount = Bands * Bands;
    const int coloured = int(g.chroma * g.chroma);
    const MonicScale scale;
    Block<Bands> block;
    // Light is fetched this many links before its use, that of the next cache too.
    constexpr std::uint32_t kAhead = 32;
    const std::uint32_t total = g.view.dims.links;
    const std::uint32_t ahead = total > kAhead + kLanes ? total - kAhead - kLanes : 0;
    for (std::uint32_t c = begin; c < end; ++c) {
        Floats sums[3 * kCount + 2] = {}; // grey ones are read in threes
        const std::uint32_t last = g.linkEnd[c];
        std::uint32_t first = g.view.linkBegin[c];
        for (; first < last; first += kLanes) {
            const Link* links = g.view.links + first;
            Link copies[kLanes];
            if (total - first < std::uint32_t(kLanes)) { // else the next cache's are read as well
                std::memset(copies, 0, sizeof copies);
                std::memcpy(copies, links, (total - first) * sizeof(Link));
                links = copies;
            }
            for (int k = 0; first < ahead && k < kLanes; ++k)
                __builtin_prefetch(&g.radiosity[links[kAhead + k].node]);
            block.add(links, last - first, g.radiosity);
            if (block.vectors == Block<Bands>::kVectors)
                block.addTo(sums, coloured);
        }
        block.addTo(sums, coloured);
        F4* out = g.sh + std::size_t(c) * g.stride;
        const float unscaled = __builtin_ldexpf(1, -g.view.linkExponent[c]);
        for (int i = 0; i < coloured; ++i)
            out[i] = sumLanes(sums + 3 * i) * (scale.factor[i] * unscaled);
        for (int i = coloured; i < kCount; ++i) {
            const F4 grey = sumLanes(sums + 2 * coloured + i) * (scale.factor[i] * unscaled);
            out[i] = F4{grey[0], grey[0], grey[0], 0};
        }
    }
}

void gatherRange(const Gather& g, std::uint32_t begin, std::uint32_t end) {
    switch (g.bands) {
    case 2:
        return gatherBands<2>(g, begin, end);
    case 3:
        return gatherBands<3>(g, begin, end);
    case 4:
        return gatherBands<4>(g, begin, end);
    case 5:
        return gatherBands<5>(g, begin, end);
    case 6:
        return gatherBands<6>(g, begin, end);
    case 7:
        return gatherBands<7>(g, begin, end);
    default:
        return gatherBands<8>(g, begin, end);
    }
}

} // namespace
} // namespace limn::runtime
