// SPDX-License-Identifier: MIT
// The sums over links. Included once by each source that defines LIMNRT_LANES, within the
// instructions that these lanes need.
#pragma once

#include "engine/runtime/gather_kernel.h"
#include "engine/runtime/monic_scale.h"

namespace limn::runtime {
namespace {

/// Writes red, green, blue and luma of the nodes of kLanes links.
LIMNRT_INLINE void writeLight(const Link* links, const F4* radiosity, Floats* light) {
    for (int k = 0; k < kLanes; k += 4) {
        const F4 a = radiosity[links[k].node], b = radiosity[links[k + 1].node],
                 c = radiosity[links[k + 2].node], d = radiosity[links[k + 3].node];
        const F4 ab = __builtin_shufflevector(a, b, 0, 4, 1, 5),
                 abHigh = __builtin_shufflevector(a, b, 2, 6, 3, 7),
                 cd = __builtin_shufflevector(c, d, 0, 4, 1, 5),
                 cdHigh = __builtin_shufflevector(c, d, 2, 6, 3, 7);
        const F4 rows[4] = {__builtin_shufflevector(ab, cd, 0, 1, 4, 5),
                            __builtin_shufflevector(ab, cd, 2, 3, 6, 7),
                            __builtin_shufflevector(abHigh, cdHigh, 0, 1, 4, 5),
                            __builtin_shufflevector(abHigh, cdHigh, 2, 3, 6, 7)};
        for (int i = 0; i < 4; ++i)
            std::memcpy(reinterpret_cast<float*>(&light[i]) + k, &rows[i], sizeof rows[i]);
    }
}

/// sums[i * Colours + k] += basis i times light k, lane by lane, over `vectors`.
template <int Count, int Colours>
LIMNRT_INLINE void addBlock(const Floats* basis, std::size_t stride, const Floats* light,
                            std::size_t vectors, Floats* sums) {
    Floats sum[Count * Colours];
    for (int i = 0; i < Count * Colours; ++i)
        sum[i] = sums[i];
    for (std::size_t n = 0; n < vectors; ++n, basis += stride, light += 4)
        for (int i = 0; i < Count; ++i)
            for (int k = 0; k < Colours; ++k)
                sum[i * Colours + k] += basis[i] * light[k];
    for (int i = 0; i < Count * Colours; ++i)
        sums[i] = sum[i];
}

/// Adds `count` coefficients in a row, as many at once as there are registers for.
template <int Colours>
LIMNRT_INLINE void addBlocks(int count, const Floats* basis, std::size_t stride,
                             const Floats* light, std::size_t vectors, Floats* sums) {
    constexpr int kAtOnce = (kLanes == 16 ? 27 : 12) / Colours;
    for (; count >= kAtOnce; count -= kAtOnce, basis += kAtOnce, sums += kAtOnce * Colours)
        addBlock<kAtOnce, Colours>(basis, stride, light, vectors, sums);
    for (; count > 0; --count, ++basis, sums += Colours)
        addBlock<1, Colours>(basis, stride, light, vectors, sums);
}

/// The sums of the lanes of three vectors.
LIMNRT_INLINE F4 sumLanes(const Floats* v) {
    F4 part[3];
    for (int i = 0; i < 3; ++i) {
        part[i] = F4{};
        for (int k = 0; k < kLanes / 4; ++k) {
            F4 quarter;
            std::memcpy(&quarter, reinterpret_cast<const float*>(&v[i]) + 4 * k, sizeof quarter);
            part[i] += quarter;
        }
    }
    const F4 rg = __builtin_shufflevector(part[0], part[1], 0, 4, 1, 5) +
                  __builtin_shufflevector(part[0], part[1], 2, 6, 3, 7),
             b = __builtin_shufflevector(part[2], F4{}, 0, 4, 1, 5) +
                 __builtin_shufflevector(part[2], F4{}, 2, 6, 3, 7);
    return __builtin_shufflevector(rg, b, 0, 1, 4, 5) + __builtin_shufflevector(rg, b, 2, 3, 6, 7);
}

/// A block of links whose basis and light wait in the nearest cache.
template <int Bands>
struct Block {
    static constexpr int kCount = Bands * Bands;
    static constexpr std::size_t kVectors = 4096 / (kCount * kLanes) > 1 ? 4096 / (kCount * kLanes)
                                                                         : 1;
    Floats basis[kVectors * kCount], light[4 * kVectors];
    std::size_t vectors = 0;

    LIMNRT_INLINE void add(const Link* links, const F4* radiosity) {
        Cones<Bands> cones;
        readCones(links, cones);
        writeBasis(cones, basis + vectors * kCount);
        writeLight(links, radiosity, light + 4 * vectors);
        ++vectors;
    }
    LIMNRT_INLINE void addTo(Floats* sums, int coloured) {
        addBlocks<3>(coloured, basis, kCount, light, vectors, sums);
        addBlocks<1>(kCount - coloured, basis + coloured, kCount, light + 3, vectors,
                     sums + 3 * coloured);
        vectors = 0;
    }
};

template <int Bands>
void gatherBands(const Gather& g, std::uint32_t begin, std::uint32_t end) {
    constexpr int kCount = Bands * Bands;
    const int coloured = int(g.chroma * g.chroma);
    const MonicScale scale;
    Block<Bands> block;
    for (std::uint32_t c = begin; c < end; ++c) {
        Floats sums[3 * kCount + 2] = {}; // grey ones are read in threes
        const Link* links = g.view.links + g.view.linkBegin[c];
        std::uint32_t count = g.linkEnd[c] - g.view.linkBegin[c];
        for (; count >= std::uint32_t(kLanes); links += kLanes, count -= kLanes) {
            block.add(links, g.radiosity);
            if (block.vectors == Block<Bands>::kVectors)
                block.addTo(sums, coloured);
        }
        if (count > 0) {
            Link rest[kLanes] = {}; // without transport
            std::memcpy(rest, links, count * sizeof(Link));
            block.add(rest, g.radiosity);
        }
        block.addTo(sums, coloured);
        F4* out = g.sh + std::size_t(c) * g.stride;
        const float unscaled = __builtin_ldexpf(1, -g.view.linkExponent[c]);
        for (int i = 0; i < coloured; ++i)
            out[i] = sumLanes(sums + 3 * i) * (scale.at[i] * unscaled);
        for (int i = coloured; i < kCount; ++i) {
            const F4 grey = sumLanes(sums + 2 * coloured + i) * (scale.at[i] * unscaled);
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
