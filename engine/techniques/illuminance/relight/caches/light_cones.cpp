// SPDX-License-Identifier: MIT
// Compiled once for each kind of vector unit; the best one is chosen when the program runs.
#include "engine/techniques/illuminance/relight/caches/light_links.h"

#include "engine/core/vector_targets.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/techniques/illuminance/relight/caches/light_cones.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/techniques/illuminance/relight/caches/cone_lanes.h"

HWY_BEFORE_NAMESPACE();
namespace limn {
namespace HWY_NAMESPACE {

/// 32 vector registers instead of 16.
constexpr bool kManyRegisters = HWY_TARGET == HWY_AVX3;

#if HWY_TARGET != HWY_SCALAR

/// Loads the light of every fourth link, in one block of four lanes each.
template <class D>
HWY_INLINE hn::Vec<D> blocksOf(D d, const Link* links, const glm::vec4* radiosity) {
    if constexpr (hn::MaxLanes(D()) == 4) {
        return hn::LoadU(d, &radiosity[links->node].x);
    } else {
        const hn::Half<D> half;
        return hn::Combine(d, blocksOf(half, links + hn::MaxLanes(half), radiosity),
                           blocksOf(half, links, radiosity));
    }
}

/// The sum of the blocks of four lanes.
template <class D>
HWY_INLINE hn::Vec<hn::Full128<float>> sumBlocks(D, hn::Vec<D> v) {
    if constexpr (hn::MaxLanes(D()) == 4) {
        return v;
    } else {
        const hn::Half<D> half;
        return sumBlocks(half, hn::Add(hn::LowerHalf(half, v), hn::UpperHalf(half, v)));
    }
}

#endif

/// Loads red, green, blue and luma of the nodes of one link per lane.
HWY_INLINE void gatherLight(Floats d, const Link* links, const glm::vec4* radiosity, V* light) {
#if HWY_TARGET == HWY_SCALAR
    for (int k = 0; k < 4; ++k)
        light[k] = hn::Set(d, radiosity[links->node][k]);
#else
    // Block k of v[j] is the light of link 4 k + j; each four by four block is then transposed.
    V v[4];
    for (std::size_t j = 0; j < 4; ++j)
        v[j] = blocksOf(d, links + j, radiosity);
    const hn::Repartition<double, Floats> pairs;
    for (int k = 0; k < 2; ++k) {
        const V a = k == 0 ? hn::InterleaveLower(d, v[0], v[1])
                           : hn::InterleaveUpper(d, v[0], v[1]),
                b = k == 0 ? hn::InterleaveLower(d, v[2], v[3])
                           : hn::InterleaveUpper(d, v[2], v[3]);
        light[2 * k] = hn::BitCast(
            d, hn::InterleaveLower(pairs, hn::BitCast(pairs, a), hn::BitCast(pairs, b)));
        light[2 * k + 1] = hn::BitCast(
            d, hn::InterleaveUpper(pairs, hn::BitCast(pairs, a), hn::BitCast(pairs, b)));
    }
#endif
}

/// Writes the sums of the lanes of four vectors.
HWY_INLINE void sumLanes(V a, V b, V c, V e, float* out) {
#if HWY_TARGET == HWY_SCALAR
    out[0] = hn::GetLane(a), out[1] = hn::GetLane(b);
    out[2] = hn::GetLane(c), out[3] = hn::GetLane(e);
#else
    const Floats d;
    const hn::Repartition<double, Floats> pairs;
    const auto ab = hn::BitCast(
                   pairs, hn::Add(hn::InterleaveLower(d, a, b), hn::InterleaveUpper(d, a, b))),
               ce = hn::BitCast(
                   pairs, hn::Add(hn::InterleaveLower(d, c, e), hn::InterleaveUpper(d, c, e)));
    const V all = hn::Add(hn::BitCast(d, hn::InterleaveLower(pairs, ab, ce)),
                          hn::BitCast(d, hn::InterleaveUpper(pairs, ab, ce)));
    hn::StoreU(sumBlocks(d, all), hn::Full128<float>(), out);
#endif
}

/// Prefetch distance in links: light is fetched this many links before its use where there are many
/// nodes.
constexpr std::size_t kAhead = 32;

/// Number of links beyond those of a cache that are also read; their values are discarded.
constexpr std::size_t kReadBehind = kAhead + hn::MaxLanes(Floats());

/// Same as gatherLight(), but lanes from `count` on are black.
HWY_INLINE void lightOf(Floats d, const Link* links, std::size_t count, const glm::vec4* radiosity,
                        V* light) {
    gatherLight(d, links, radiosity, light);
    if (count < hn::Lanes(d)) {
        const auto mask = hn::FirstN(d, count);
        for (int k = 0; k < 4; ++k)
            light[k] = hn::IfThenElseZero(mask, light[k]);
    }
}

/// Whether links of this light add nothing at all.
HWY_INLINE bool isBlack(Floats d, const V* light) {
    // Luma decides nearly always, in one test where all is lit.
    const V zero = hn::Zero(d), any = hn::Or(hn::Or(light[0], light[1]), light[2]);
    return hn::AllTrue(d, hn::Eq(light[3], zero)) && hn::AllTrue(d, hn::Eq(any, zero));
}

/// Indices of a cache's sums that belong to the orders Of. The sums are 3 colours of Chroma^2
/// coefficients, then luma of the others.
template <int Bands, int Chroma, Orders Of>
constexpr auto sumsOf() {
    struct {
        int index[3 * Bands * Bands] = {}, count = 0;
    } sums;
    for (int l = 0; l < Bands; ++l)
        for (int m = -l; m <= l; ++m) {
            const int i = l * (l + 1) + m, colours = l < Chroma ? 3 : 1;
            for (int k = 0; contains(Of, m) && k < colours; ++k)
                sums.index[sums.count++] = l < Chroma ? 3 * i + k : 2 * Chroma * Chroma + i;
        }
    return sums;
}

template <int Bands, int Chroma, Orders Of>
HWY_INLINE void addCones(Floats d, const Cones<Bands>& cones, const V* light, V* sum) {
    constexpr int kColoured = Chroma * Chroma;
    basisOf<Bands, Of>(
        d, cones.x, cones.y, cones.z, cones.factor, [&](auto i, V basis) LIMN_UNROLLED {
            if constexpr (i < kColoured)
                unrolled<0, 3>([&](auto j) LIMN_UNROLLED {
                    sum[3 * i + j] = hn::MulAdd(basis, light[j], sum[3 * i + j]);
                });
            else
                sum[2 * kColoured + i] = hn::MulAdd(basis, light[3], sum[2 * kColoured + i]);
        });
}

/// Adds up the lanes of each sum.
template <int Bands, int Chroma, Orders Of>
HWY_INLINE void addTotals(const V* sum, float* total) {
    static constexpr auto kSums =
        sumsOf<Bands, Chroma, Of>(); // as a member: clang refuses it in a lambda
    constexpr int kFours = (kSums.count + 3) / 4;
    float out[4 * kFours];
    unrolled<0, kFours>([&](auto k) LIMN_UNROLLED {
        constexpr auto kAt = [](int i) { return kSums.index[std::min(i, kSums.count - 1)]; };
        sumLanes(sum[kAt(4 * k)], sum[kAt(4 * k + 1)], sum[kAt(4 * k + 2)], sum[kAt(4 * k + 3)],
                 out + 4 * k);
    });
    for (int i = 0; i < kSums.count; ++i)
        total[kSums.index[i]] += out[i];
}

/// Adds the sums of some links, all in registers: of the orders First at once, then of the orders
/// Second, if any, for which cones and light of a block of links wait in the nearest cache. Returns
/// the number of links skipped.
template <int Bands, int Chroma, Orders First, Orders Second>
HWY_INLINE std::size_t sumCones(const Link* links, std::size_t count, const glm::vec4* radiosity,
                                float* total) {
    constexpr std::size_t kLanes = hn::MaxLanes(Floats()), kBlock = 256; // links
    constexpr int kSums = 3 * Bands * Bands;
    struct Waiting {
        Cones<Bands> cones;
        V light[4];
    } waiting[Second != 0 ? kBlock / kLanes : 1];
    const Floats d;
    V sum[kSums];
    const auto clear = [&]() LIMN_UNROLLED {
        unrolled<0, kSums>([&](auto i) LIMN_UNROLLED { sum[i] = hn::Zero(d); });
    };
    std::size_t skipped = 0;
    for (std::size_t k = 0; k < count; k += kBlock) {
        const std::size_t end = std::min(k + kBlock, count);
        std::size_t vectors = 0;
        clear();
        for (std::size_t n = k; n < end; n += kLanes) {
            for (std::size_t j = n + kAhead; j < n + kAhead + kLanes; ++j)
                hwy::Prefetch(&radiosity[links[j].node]);
            V light[4];
            lightOf(d, links + n, end - n, radiosity, light);
            if (isBlack(d, light)) {
                skipped += std::min(kLanes, end - n);
                continue;
            }
            Cones<Bands> cones;
            readCones(d, links + n, cones);
            if constexpr (Second != 0) {
                waiting[vectors].cones = cones;
                std::copy_n(light, 4, waiting[vectors].light);
            }
            addCones<Bands, Chroma, First>(d, cones, light, sum);
            ++vectors;
        }
        if (vectors == 0)
            continue;
        addTotals<Bands, Chroma, First>(sum, total);
        if constexpr (Second != 0) {
            clear();
            for (std::size_t n = 0; n < vectors; ++n)
                addCones<Bands, Chroma, Second>(d, waiting[n].cones, waiting[n].light, sum);
            addTotals<Bands, Chroma, Second>(sum, total);
        }
    }
    return skipped;
}

/// sums[i * Colours + k] += basis i * light k, lane by lane, over `vectors`, each of which has
/// `stride` floats of basis and `lights` of light.
template <int Coefficients, int Colours>
HWY_INLINE void addBlock(const float* basis, std::size_t stride, const float* light,
                         std::size_t lights, std::size_t vectors, float* sums) {
    const Floats d;
    const std::size_t lanes = hn::Lanes(d);
    V sum[Coefficients * Colours];
    unrolled<0, Coefficients * Colours>(
        [&](auto i) LIMN_UNROLLED { sum[i] = hn::Load(d, sums + i * lanes); });
    for (std::size_t n = 0; n < vectors; ++n, basis += stride, light += lights) {
        V colour[Colours];
        unrolled<0, Colours>([&](auto k)
                                 LIMN_UNROLLED { colour[k] = hn::Load(d, light + k * lanes); });
        unrolled<0, Coefficients>([&](auto i) LIMN_UNROLLED {
            const V b = hn::Load(d, basis + i * lanes);
            unrolled<0, Colours>([&](auto k) LIMN_UNROLLED {
                sum[i * Colours + k] = hn::MulAdd(b, colour[k], sum[i * Colours + k]);
            });
        });
    }
    unrolled<0, Coefficients * Colours>(
        [&](auto i) LIMN_UNROLLED { hn::Store(sum[i], d, sums + i * lanes); });
}

/// Adds `coefficients` sums in a row, as many at once as there are registers for.
template <int Colours>
HWY_INLINE void addBlocks(int coefficients, const float* basis, std::size_t stride,
                          const float* light, std::size_t lights, std::size_t vectors,
                          float* sums) {
    constexpr int kAtOnce = (kManyRegisters ? 24 : 12) / Colours;
    const std::size_t lanes = hn::Lanes(Floats());
    for (; coefficients >= kAtOnce; coefficients -= kAtOnce) {
        addBlock<kAtOnce, Colours>(basis, stride, light, lights, vectors, sums);
        basis += kAtOnce * lanes;
        sums += kAtOnce * Colours * lanes;
    }
    for (; coefficients > 0; --coefficients) {
        addBlock<1, Colours>(basis, stride, light, lights, vectors, sums);
        basis += lanes;
        sums += Colours * lanes;
    }
}

/// Same as sumCones, for more sums than there are registers: basis and light of a block of links
/// wait
/// in the nearest cache.
template <int Bands>
HWY_INLINE std::size_t sumBlocksOfCones(const Link* links, std::size_t count,
                                        const glm::vec4* radiosity, int coloured, float* total) {
    constexpr int kCount = Bands * Bands;
    constexpr std::size_t kLanes = hn::MaxLanes(Floats());
    constexpr std::size_t kBlock = 4096 / kCount / 16 * 16; // links, of a basis of 16 KiB
    alignas(HWY_MAX_BYTES) float basis[kCount * kBlock], light[4 * kBlock],
        sums[(kCount * 3 + 3) * kLanes];
    const Floats d;
    const int all = 2 * coloured + kCount;
    std::fill_n(sums, std::size_t(all + 3) * kLanes, 0.f);
    std::size_t skipped = 0;
    for (std::size_t k = 0; k < count; k += kBlock) {
        const std::size_t end = std::min(k + kBlock, count);
        std::size_t vectors = 0;
        for (std::size_t n = k; n < end; n += kLanes) {
            for (std::size_t j = n + kAhead; j < n + kAhead + kLanes; ++j)
                hwy::Prefetch(&radiosity[links[j].node]);
            V colour[4];
            lightOf(d, links + n, end - n, radiosity, colour);
            if (isBlack(d, colour)) {
                skipped += std::min(kLanes, end - n);
                continue;
            }
            unrolled<0, 4>([&](auto j) LIMN_UNROLLED {
                hn::Store(colour[j], d, light + (vectors * 4 + j) * kLanes);
            });
            Cones<Bands> cones;
            readCones(d, links + n, cones);
            basisOf<Bands>(d, cones.x, cones.y, cones.z, cones.factor,
                           [&](auto i, V value) LIMN_UNROLLED {
                               hn::Store(value, d, basis + (vectors * kCount + i) * kLanes);
                           });
            ++vectors;
        }
        addBlocks<3>(coloured, basis, kCount * kLanes, light, 4 * kLanes, vectors, sums);
        addBlocks<1>(kCount - coloured, basis + std::size_t(coloured) * kLanes, kCount * kLanes,
                     light + 3 * kLanes, 4 * kLanes, vectors,
                     sums + std::size_t(3 * coloured) * kLanes);
    }
    const auto sum = [&](int i)
                         LIMN_UNROLLED { return hn::Load(d, sums + std::size_t(i) * kLanes); };
    for (int i = 0; i < all; i += 4) {
        float out[4];
        sumLanes(sum(i), sum(i + 1), sum(i + 2), sum(i + 3), out);
        for (int j = 0; j < 4; ++j)
            total[i + j] += out[j];
    }
    return skipped;
}

/// Not inlined: it is called from two places and takes long to compile.
template <int Bands>
HWY_NOINLINE std::size_t sumLinks(const Link* links, std::size_t count, const glm::vec4* radiosity,
                                  int chroma, float* total) {
    if constexpr (Bands == 2 || (Bands <= 4 && kManyRegisters)) {
        constexpr Orders kFirst = Bands < 4 ? kEveryOrder : kEvenOrders,
                         kSecond = Bands < 4 ? 0 : kOddOrders;
        std::size_t skipped = 0;
        unrolled<1, Bands + 1>([&](auto k) LIMN_UNROLLED {
            if (k == chroma)
                skipped = sumCones<Bands, k, kFirst, kSecond>(links, count, radiosity, total);
        });
        return skipped;
    } else
        return sumBlocksOfCones<Bands>(links, count, radiosity, chroma * chroma, total);
}

/// Number of links copied at once near the end of the array.
constexpr std::size_t kCopied = 1024;

/// Computes the sums of a cache over its links [first, last). Returns the number of links skipped.
template <int Bands>
HWY_INLINE std::size_t sumCache(const std::vector<Link>& links, std::size_t first, std::size_t last,
                                const glm::vec4* radiosity, int chroma, float* total) {
    std::fill_n(total, 3 * Bands * Bands, 0.f);
    if (last + kReadBehind <= links.size())
        return sumLinks<Bands>(links.data() + first, last - first, radiosity, chroma, total);
    std::size_t skipped = 0;
    for (std::size_t count; first < last; first += count) {
        Link copies[kCopied + kReadBehind] = {};
        count = std::min(kCopied, last - first);
        std::copy_n(links.begin() + std::ptrdiff_t(first), count, copies);
        skipped += sumLinks<Bands>(copies, count, radiosity, chroma, total);
    }
    return skipped;
}

template <int Bands>
std::size_t lightBands(const Caches& caches, LinkEnds ends, const glm::vec4* radiosity, int chroma,
                       std::uint32_t begin, std::uint32_t end, glm::vec3* sh) {
    constexpr int kCount = Bands * Bands;
    const int coloured = chroma * chroma;
    float total[3 * kCount + 3] = {};
    std::size_t skipped = 0;
    for (std::uint32_t c = begin; c < end; ++c) {
        skipped +=
            sumCache<Bands>(caches.links, caches.linkBegin[c], ends[c], radiosity, chroma, total);
        const float scale = linkScale(caches, c);
        glm::vec3* out = sh + std::size_t(c) * kCount;
        for (int i = 0; i < coloured; ++i)
            out[i] = glm::vec3(total[3 * i], total[3 * i + 1], total[3 * i + 2]) *
                     (kMonicScale[std::size_t(i)] * scale);
        for (int i = coloured; i < kCount; ++i)
            out[i] = glm::vec3(total[2 * coloured + i] * (kMonicScale[std::size_t(i)] * scale));
    }
    return skipped;
}

std::size_t lightCones(const Caches& caches, LinkEnds ends, const glm::vec4* radiosity,
                       LightBands bands, std::uint32_t begin, std::uint32_t end, glm::vec3* sh) {
    using Light = std::size_t (*)(const Caches&, LinkEnds, const glm::vec4*, int, std::uint32_t,
                                  std::uint32_t, glm::vec3*);
    constexpr Light kLight[] = {lightBands<2>, lightBands<3>, lightBands<4>, lightBands<5>,
                                lightBands<6>, lightBands<7>, lightBands<8>};
    return kLight[bands.luma - 2](caches, ends, radiosity, bands.chroma, begin, end, sh);
}

} // namespace HWY_NAMESPACE
} // namespace limn
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limn {

HWY_EXPORT(lightCones);

std::size_t lightCones(const Caches& caches, LinkEnds ends, const std::vector<glm::vec4>& radiosity,
                       LightBands bands, std::uint32_t begin, std::uint32_t end, glm::vec3* sh) {
    return HWY_DYNAMIC_DISPATCH(lightCones)(caches, ends, radiosity.data(), bands, begin, end, sh);
}

} // namespace limn
#endif
