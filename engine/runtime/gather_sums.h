// SPDX-License-Identifier: MIT
// Sums of harmonics times light. See gather_range.h.
#pragma once

#include "engine/runtime/gather_kernel.h"

namespace limn::runtime {
namespace {

/// Writes red, green, blue and luma of the nodes of kLanes links.
LIMNRT_INLINE void writeLight(const Link* links, const F4* radiosity, Floats* light) {
    F4 rows[4][kLanes / 4];
#pragma GCC unroll 4
    for (int k = 0; k < kLanes / 4; ++k, links += 4) {
        const F4 a = radiosity[links[0].node], b = radiosity[links[1].node],
                 c = radiosity[links[2].node], d = radiosity[links[3].node];
        const F4 ab = __builtin_shufflevector(a, b, 0, 4, 1, 5),
                 abHigh = __builtin_shufflevector(a, b, 2, 6, 3, 7),
                 cd = __builtin_shufflevector(c, d, 0, 4, 1, 5),
                 cdHigh = __builtin_shufflevector(c, d, 2, 6, 3, 7);
        rows[0][k] = __builtin_shufflevector(ab, cd, 0, 1, 4, 5);
        rows[1][k] = __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
        rows[2][k] = __builtin_shufflevector(abHigh, cdHigh, 0, 1, 4, 5);
        rows[3][k] = __builtin_shufflevector(abHigh, cdHigh, 2, 3, 6, 7);
    }
    for (int i = 0; i < 4; ++i)
        light[i] = joined(rows[i]);
}

/// sums[i * Colours + k] += basis i times light k, lane by lane, over `vectors`.
template <int Count, int Colours>
LIMNRT_INLINE void addBlock(const Floats* basis, std::size_t stride, const Floats* light,
                            std::size_t vectors, Floats* sums) {
    Floats sum[Count * Colours]; // in registers, once all loops over it are unrolled
#pragma GCC unroll 32
    for (int i = 0; i < Count * Colours; ++i)
        sum[i] = sums[i];
    for (std::size_t n = 0; n < vectors; ++n, basis += stride, light += 4)
#pragma GCC unroll 32
        for (int i = 0; i < Count; ++i)
#pragma GCC unroll 4
            for (int k = 0; k < Colours; ++k)
                sum[i * Colours + k] += basis[i] * light[k];
#pragma GCC unroll 32
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

    LIMNRT_INLINE void add(const Link* links, std::uint32_t count, const F4* radiosity) {
        Cones<Bands> cones;
        readCones(links, count, cones);
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

} // namespace
} // namespace limn::runtime
