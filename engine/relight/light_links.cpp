// SPDX-License-Identifier: MIT
// Compiled once for each kind of vector unit; the best one is chosen when the program runs.
#include "engine/relight/light_links.h"

#include "engine/math/sh_basis.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/relight/light_links.cpp"
// Besides plain code, AVX2 and AVX-512 are enough.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL)
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace limn {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using V = hn::Vec<Floats>;

/// Links whose light and basis wait side by side in the nearest cache, before they are summed.
constexpr std::size_t kBlock = 128;
constexpr std::size_t kMostLanes = HWY_MAX_BYTES / sizeof(float);

/// The light that comes over a block's links: red, green, blue, or luma and two chrominances.
struct BlockLight {
    alignas(HWY_MAX_BYTES) float colour[3][kBlock];
};

HWY_INLINE void toLuma(Floats d, V& r, V& g, V& b) {
    const V sides = hn::Mul(hn::Add(r, b), hn::Set(d, 0.25f)),
            middle = hn::Mul(g, hn::Set(d, 0.5f));
    const V co = hn::Mul(hn::Sub(r, b), hn::Set(d, 0.5f));
    r = hn::Add(middle, sides);
    g = co;
    b = hn::Sub(middle, sides);
}

/// `count` is a multiple of the lanes.
template <bool Luma>
HWY_INLINE void readLight(const Link* links, std::size_t count, const glm::vec4* radiosity,
                          BlockLight& out) {
    const Floats d;
    alignas(HWY_MAX_BYTES) float rgbw[4 * kBlock];
    for (std::size_t k = 0; k < count; ++k)
        std::memcpy(rgbw + 4 * k, &radiosity[links[k].node], sizeof(glm::vec4));
    for (std::size_t k = 0; k < count; k += hn::Lanes(d)) {
        V r, g, b, unused;
        hn::LoadInterleaved4(d, rgbw + 4 * k, r, g, b, unused);
        if (Luma)
            toLuma(d, r, g, b);
        hn::Store(r, d, out.colour[0] + k);
        hn::Store(g, d, out.colour[1] + k);
        hn::Store(b, d, out.colour[2] + k);
    }
}

/// Factors of the bands for cones of u = 1 - cos(half-angle), times `transport`: as coneFactors.
template <int Bands>
HWY_INLINE void coneBands(Floats d, V u, V transport, V* factor) {
    const V x = hn::Sub(hn::Set(d, 1.f), u), rest = hn::Mul(hn::Sub(hn::Set(d, 2.f), u), transport);
    factor[0] = transport;
    V d2 = hn::Zero(d), d1 = hn::Zero(d);
    for (int l = 1; l < Bands; ++l) {
        V p = hn::Set(d, 1.f);
        if (l > 1)
            p = hn::Sub(hn::Mul(hn::Mul(hn::Set(d, float(2 * l - 1) / float(l - 1)), x), d1),
                        hn::Mul(hn::Set(d, float(l) / float(l - 1)), d2));
        factor[l] = hn::Mul(hn::Mul(rest, p), hn::Set(d, 1.f / float(l * (l + 1))));
        d2 = d1;
        d1 = p;
    }
}

/// Spherical harmonics of unit directions, each band times its factor: as shBasisFixed. Coefficient
/// i goes to out[i * kBlock].
template <int Bands>
HWY_INLINE void storeBasis(Floats d, V x, V y, V z, const V* factor, float* out) {
    V c = hn::Set(d, 1.f), s = hn::Zero(d);
    float qmm = 1;
    for (int m = 0; m < Bands; ++m) {
        V q2 = hn::Zero(d), q1 = hn::Zero(d);
        for (int l = m; l < Bands; ++l) {
            V q = hn::Set(d, qmm);
            if (l > m)
                q = hn::Sub(hn::Mul(hn::Mul(hn::Set(d, float(2 * l - 1) / float(l - m)), z), q1),
                            hn::Mul(hn::Set(d, float(l + m - 1) / float(l - m)), q2));
            const float k = sh_detail::kNormalisation[std::size_t(l * (l + 1) / 2 + m)];
            const V kq = hn::Mul(hn::Mul(hn::Set(d, k), q), factor[l]);
            hn::Store(hn::Mul(kq, c), d, out + std::size_t(l * (l + 1) + m) * kBlock);
            if (m > 0)
                hn::Store(hn::Mul(kq, s), d, out + std::size_t(l * (l + 1) - m) * kBlock);
            q2 = q1;
            q1 = q;
        }
        const V cNext = hn::Sub(hn::Mul(c, x), hn::Mul(s, y));
        s = hn::Add(hn::Mul(s, x), hn::Mul(c, y));
        c = cNext;
        qmm *= float(2 * m + 1);
    }
}

/// 16-bit snorm of the lower or upper half of each lane.
HWY_INLINE V snorm(Floats d, hn::Vec<hn::RebindToSigned<Floats>> shifted) {
    return hn::Mul(hn::ConvertTo(d, hn::ShiftRight<16>(shifted)), hn::Set(d, 1 / 32767.f));
}

template <int Bands>
HWY_INLINE void expandCones(const Link* links, std::size_t count, float* basis) {
    const Floats d;
    const hn::RebindToUnsigned<Floats> du;
    const hn::RebindToSigned<Floats> di;
    const hn::Rebind<hwy::float16_t, Floats> dh;
    const hn::Rebind<std::uint16_t, Floats> dh16;
    for (std::size_t k = 0; k < count; k += hn::Lanes(d)) {
        hn::Vec<decltype(du)> node, oct, cone;
        hn::LoadInterleaved3(du, reinterpret_cast<const std::uint32_t*>(links + k), node, oct,
                             cone);
        V x = snorm(d, hn::BitCast(di, hn::ShiftLeft<16>(oct))), y = snorm(d, hn::BitCast(di, oct));
        const V z = hn::Sub(hn::Sub(hn::Set(d, 1.f), hn::Abs(x)), hn::Abs(y));
        const V fold = hn::Max(hn::Neg(z), hn::Zero(d));
        x = hn::Sub(x, hn::CopySignToAbs(fold, x));
        y = hn::Sub(y, hn::CopySignToAbs(fold, y));
        const V square = hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
        const V inverse = hn::Div(hn::Set(d, 1.f), hn::Sqrt(square));
        const V u = hn::PromoteTo(
            d, hn::BitCast(dh, hn::TruncateTo(dh16, hn::And(cone, hn::Set(du, 0xffffU)))));
        const V transport =
            hn::PromoteTo(d, hn::BitCast(dh, hn::TruncateTo(dh16, hn::ShiftRight<16>(cone))));
        V factor[Bands];
        coneBands<Bands>(d, u, transport, factor);
        storeBasis<Bands>(d, hn::Mul(x, inverse), hn::Mul(y, inverse), hn::Mul(z, inverse), factor,
                          basis + k);
    }
}

/// sums[(coefficient * 3 + colour) * kMostLanes …] += basis * light over the block, lane by lane.
template <int Coefficients, int Colours>
HWY_INLINE void addBlock(const float* basis, const BlockLight& light, std::size_t count,
                         float* sums) {
    const Floats d;
    V sum[Coefficients][Colours];
    for (int i = 0; i < Coefficients; ++i)
        for (int k = 0; k < Colours; ++k)
            sum[i][k] = hn::Load(d, sums + std::size_t(i * 3 + k) * kMostLanes);
    for (std::size_t n = 0; n < count; n += hn::Lanes(d)) {
        V colour[Colours];
        for (int k = 0; k < Colours; ++k)
            colour[k] = hn::Load(d, light.colour[k] + n);
        for (int i = 0; i < Coefficients; ++i) {
            const V b = hn::Load(d, basis + std::size_t(i) * kBlock + n);
            for (int k = 0; k < Colours; ++k)
                sum[i][k] = hn::MulAdd(b, colour[k], sum[i][k]);
        }
    }
    for (int i = 0; i < Coefficients; ++i)
        for (int k = 0; k < Colours; ++k)
            hn::Store(sum[i][k], d, sums + std::size_t(i * 3 + k) * kMostLanes);
}

/// Of `coefficients` in a row, with as many sums at once as there are registers for.
template <int Colours>
HWY_INLINE void addBlocks(int coefficients, const float* basis, const BlockLight& light,
                          std::size_t count, float* sums) {
    constexpr int kAtOnce = 12 / Colours;
    for (int i = 0; i < coefficients / kAtOnce; ++i) {
        addBlock<kAtOnce, Colours>(basis, light, count, sums);
        basis += kAtOnce * kBlock;
        sums += kAtOnce * 3 * kMostLanes;
    }
    for (int i = 0; i < coefficients % kAtOnce; ++i) {
        addBlock<1, Colours>(basis, light, count, sums);
        basis += kBlock;
        sums += 3 * kMostLanes;
    }
}

/// Scales and writes a cache's sums; with Luma those are luma and, below `chroma`, chrominance.
template <bool Luma>
HWY_INLINE void writeRgb(const float* r, const float* g, const float* b, std::size_t stride,
                         int count, int chroma, float scale, glm::vec3* out) {
    for (int i = 0; i < count; ++i) {
        const std::size_t at = std::size_t(i) * stride;
        if (!Luma) {
            out[i] = glm::vec3(r[at], g[at], b[at]) * scale;
            continue;
        }
        const float luma = r[at], co = i < chroma ? g[at] : 0, cg = i < chroma ? b[at] : 0;
        out[i] = glm::vec3(luma + co - cg, luma + cg, luma - co - cg) * scale;
    }
}

float scaleOf(const Caches& caches, std::uint32_t c) {
    return std::ldexp(1.f, -caches.linkExponent[c]);
}

template <int Bands, bool Luma>
void lightCones(const Caches& caches, LinkEnds ends, const glm::vec4* radiosity, int chroma,
                std::uint32_t begin, std::uint32_t end, glm::vec3* sh) {
    constexpr int kCount = Bands * Bands;
    const Floats d;
    const std::size_t lanes = hn::Lanes(d);
    alignas(HWY_MAX_BYTES) float basis[kCount * kBlock];
    alignas(HWY_MAX_BYTES) float sums[kCount * 3 * kMostLanes];
    BlockLight light;
    Link padded[kBlock];
    for (std::uint32_t c = begin; c < end; ++c) {
        std::fill(std::begin(sums), std::end(sums), 0.f);
        for (std::size_t k = caches.linkBegin[c]; k < ends[c]; k += kBlock) {
            const Link* links = caches.links.data() + k;
            const std::size_t own = std::min(kBlock, ends[c] - k);
            const std::size_t count = (own + lanes - 1) / lanes * lanes;
            if (count != own) { // links of no transport fill the last vector
                std::memcpy(padded, links, own * sizeof(Link));
                std::fill(padded + own, padded + count, Link{});
                links = padded;
            }
            readLight<Luma>(links, count, radiosity, light);
            expandCones<Bands>(links, count, basis);
            const int coloured = Luma ? chroma : kCount;
            addBlocks<3>(coloured, basis, light, count, sums);
            if (Luma)
                addBlocks<1>(kCount - coloured, basis + std::size_t(coloured) * kBlock, light,
                             count, sums + std::size_t(coloured) * 3 * kMostLanes);
        }
        float total[kCount * 3];
        for (int i = 0; i < kCount * 3; ++i)
            total[i] =
                hn::GetLane(hn::SumOfLanes(d, hn::Load(d, sums + std::size_t(i) * kMostLanes)));
        writeRgb<Luma>(total, total + 1, total + 2, 3, kCount, chroma, scaleOf(caches, c),
                       sh + std::size_t(c) * kCount);
    }
}

/// Adds the links [begin, end) of one cache; `halfs` are theirs, `stored` for each, of which the
/// first Bands^2 are read, with a vector's worth more behind.
template <int Bands, int Chroma>
HWY_INLINE void addHarmonics(const std::uint32_t* nodes, const std::uint16_t* halfs,
                             std::size_t stored, std::size_t links, const glm::vec4* radiosity,
                             float* sums) {
    constexpr int kCount = Bands * Bands;
    const Floats d;
    const hn::Rebind<hwy::float16_t, Floats> dh;
    const hn::Rebind<std::uint16_t, Floats> dh16;
    constexpr int kLanes = int(hn::MaxLanes(Floats()));
    constexpr int kVectors = (kCount + kLanes - 1) / kLanes;
    constexpr int kChroma = (Chroma * Chroma + kLanes - 1) / kLanes;
    constexpr bool kLuma = Chroma < Bands;
    V r[kVectors], g[kChroma], b[kChroma];
    for (V& v : r)
        v = hn::Zero(d);
    for (int i = 0; i < kChroma; ++i)
        g[i] = b[i] = hn::Zero(d);
    for (std::size_t k = 0; k < links; ++k) {
        const glm::vec4 from = radiosity[nodes[k]];
        float c[3] = {from.x, from.y, from.z};
        if (kLuma) {
            const float sides = (from.x + from.z) * 0.25f, middle = from.y * 0.5f;
            c[0] = middle + sides, c[1] = (from.x - from.z) * 0.5f, c[2] = middle - sides;
        }
        const V red = hn::Set(d, c[0]), green = hn::Set(d, c[1]), blue = hn::Set(d, c[2]);
        for (int i = 0; i < kVectors; ++i) {
            const V basis =
                hn::PromoteTo(d, hn::BitCast(dh, hn::LoadU(dh16, halfs + k * stored + i * kLanes)));
            r[i] = hn::MulAdd(basis, red, r[i]);
            if (i < kChroma) {
                g[i] = hn::MulAdd(basis, green, g[i]);
                b[i] = hn::MulAdd(basis, blue, b[i]);
            }
        }
    }
    for (int i = 0; i < kVectors; ++i)
        hn::Store(r[i], d, sums + i * kLanes);
    for (int i = 0; i < kChroma; ++i) {
        hn::Store(g[i], d, sums + (kVectors + i) * kLanes);
        hn::Store(b[i], d, sums + (2 * kVectors + i) * kLanes);
    }
}

template <int Bands, int Chroma>
void lightHarmonics(const Caches& caches, LinkEnds ends, const glm::vec4* radiosity, LinkHalfs all,
                    std::uint32_t begin, std::uint32_t end, glm::vec3* sh) {
    constexpr std::size_t kCount = Bands * Bands;
    constexpr std::size_t kLanes = hn::MaxLanes(Floats());
    constexpr std::size_t kSums = (kCount + kLanes - 1) / kLanes * kLanes;
    alignas(HWY_MAX_BYTES) float sums[3 * kSums] = {};
    const std::size_t stored = all.size() / caches.shNode.size();
    std::vector<std::uint16_t> padded;
    for (std::uint32_t c = begin; c < end; ++c) {
        const std::size_t first = caches.linkBegin[c], last = ends[c];
        const std::uint16_t* halfs = all.data() + first * stored;
        if (last * stored + kLanes > all.size()) { // the array's end
            padded.assign(halfs, halfs + (last - first) * stored);
            padded.resize(padded.size() + kLanes, 0);
            halfs = padded.data();
        }
        addHarmonics<Bands, Chroma>(caches.shNode.data() + first, halfs, stored, last - first,
                                    radiosity, sums);
        writeRgb<(Chroma < Bands)>(sums, sums + kSums, sums + 2 * kSums, 1, int(kCount),
                                   Chroma * Chroma, scaleOf(caches, c), sh + c * kCount);
    }
}

template <int Bands, int Chroma>
void lightHarmonicsFrom(const Caches& caches, LinkEnds ends, const glm::vec4* radiosity, int chroma,
                        LinkHalfs halfs, std::uint32_t begin, std::uint32_t end, glm::vec3* sh) {
    if constexpr (Chroma > 1)
        if (chroma < Chroma)
            return lightHarmonicsFrom<Bands, Chroma - 1>(caches, ends, radiosity, chroma, halfs,
                                                         begin, end, sh);
    lightHarmonics<Bands, Chroma>(caches, ends, radiosity, halfs, begin, end, sh);
}

template <int Bands>
void lightBands(const Caches& caches, LinkEnds ends, const glm::vec4* radiosity, int chroma,
                LinkHalfs halfs, std::uint32_t begin, std::uint32_t end, glm::vec3* sh) {
    if (!caches.shNode.empty())
        lightHarmonicsFrom<Bands, Bands>(caches, ends, radiosity, chroma, halfs, begin, end, sh);
    else if (chroma < Bands)
        lightCones<Bands, true>(caches, ends, radiosity, chroma * chroma, begin, end, sh);
    else
        lightCones<Bands, false>(caches, ends, radiosity, Bands * Bands, begin, end, sh);
}

void lightLinks(const Caches& caches, LinkEnds ends, const glm::vec4* radiosity, LightBands bands,
                LinkHalfs halfs, std::uint32_t begin, std::uint32_t end, glm::vec3* sh) {
    using Light = void (*)(const Caches&, LinkEnds, const glm::vec4*, int, LinkHalfs, std::uint32_t,
                           std::uint32_t, glm::vec3*);
    constexpr Light kLight[] = {lightBands<2>, lightBands<3>, lightBands<4>, lightBands<5>,
                                lightBands<6>, lightBands<7>, lightBands<8>};
    kLight[bands.luma - 2](caches, ends, radiosity, bands.chroma, halfs, begin, end, sh);
}

} // namespace HWY_NAMESPACE
} // namespace limn
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limn {

HWY_EXPORT(lightLinks);

void lightLinks(const Caches& caches, LinkEnds ends, const std::vector<glm::vec4>& radiosity,
                LightBands bands, LinkHalfs halfs, std::uint32_t begin, std::uint32_t end,
                glm::vec3* sh) {
    HWY_DYNAMIC_DISPATCH(lightLinks)
    (caches, ends, radiosity.data(), bands,
     halfs.empty() ? LinkHalfs(caches.shCoefficients) : halfs, begin, end, sh);
}

} // namespace limn
#endif
