// SPDX-License-Identifier: MIT
// Compiled once for each kind of vector unit; the best one is chosen when the program runs.
#include "engine/techniques/illuminance/relight/caches/light_links.h"

#include "engine/core/vector_targets.h"
#include "engine/math/ycocg.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/techniques/illuminance/relight/caches/light_harmonics.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace limn {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using V = hn::Vec<Floats>;

/// Number of vectors that the coefficients of `bands` bands fill.
constexpr int vectorsOf(int bands) {
    constexpr int kLanes = int(hn::MaxLanes(Floats()));
    return (bands * bands + kLanes - 1) / kLanes;
}

/// The next smaller number of vectors with colour for which a kernel is compiled; 0: there is none.
/// The time of more than four bands is that of reading their halfs, so that three kernels for each
/// are enough: for colour in two bands, in four, and in all.
constexpr int fewerColoured(int bands, int coloured) {
    if (bands <= 4)
        return coloured - 1;
    return coloured > vectorsOf(4) ? vectorsOf(4) : coloured > vectorsOf(2) ? vectorsOf(2) : 0;
}

/// Adds some links of one cache to its sums. `halfs` has `stored` halfs for each link, of which the
/// first vectorsOf(Bands) vectors are read. The sums are red of all coefficients, or luma where
/// there is no colour, and green and blue of the first `Coloured` vectors of them.
template <int Bands, int Coloured>
HWY_INLINE void addHarmonics(const std::uint32_t* nodes, const std::uint16_t* halfs,
                             std::size_t stored, std::size_t links, const glm::vec4* radiosity,
                             float* sums) {
    const Floats d;
    const hn::Rebind<hwy::float16_t, Floats> dh;
    const hn::Rebind<std::uint16_t, Floats> dh16;
    constexpr int kLanes = int(hn::MaxLanes(Floats()));
    constexpr int kVectors = vectorsOf(Bands);
    V r[kVectors], g[Coloured], b[Coloured];
    for (int i = 0; i < kVectors; ++i)
        r[i] = hn::Load(d, sums + i * kLanes);
    for (int i = 0; i < Coloured; ++i) {
        g[i] = hn::Load(d, sums + (kVectors + i) * kLanes);
        b[i] = hn::Load(d, sums + (2 * kVectors + i) * kLanes);
    }
    for (std::size_t k = 0; k < links; ++k) {
        const glm::vec4& from = radiosity[nodes[k]];
        const V red = hn::Set(d, from.x), green = hn::Set(d, from.y), blue = hn::Set(d, from.z),
                luma = hn::Set(d, from.w);
        for (int i = 0; i < kVectors; ++i) {
            const V basis =
                hn::PromoteTo(d, hn::BitCast(dh, hn::LoadU(dh16, halfs + k * stored + i * kLanes)));
            r[i] = hn::MulAdd(basis, i < Coloured ? red : luma, r[i]);
            if (i < Coloured) {
                g[i] = hn::MulAdd(basis, green, g[i]);
                b[i] = hn::MulAdd(basis, blue, b[i]);
            }
        }
    }
    for (int i = 0; i < kVectors; ++i)
        hn::Store(r[i], d, sums + i * kLanes);
    for (int i = 0; i < Coloured; ++i) {
        hn::Store(g[i], d, sums + (kVectors + i) * kLanes);
        hn::Store(b[i], d, sums + (2 * kVectors + i) * kLanes);
    }
}

template <int Bands, int Coloured>
void lightBands(const Caches& caches, LinkEnds ends, const glm::vec4* radiosity, int chroma,
                LinkHalfs all, std::uint32_t begin, std::uint32_t end, glm::vec3* sh) {
    // Where fewer bands of chrominance fill the same number of vectors, colour costs nothing until
    // the end.
    if constexpr (constexpr int fewer = fewerColoured(Bands, Coloured); fewer > 0)
        if (vectorsOf(chroma) <= fewer)
            return lightBands<Bands, fewer>(caches, ends, radiosity, chroma, all, begin, end, sh);
    constexpr std::size_t kCount = Bands * Bands;
    constexpr std::size_t kLanes = hn::MaxLanes(Floats());
    constexpr std::size_t kSums = vectorsOf(Bands) * kLanes, kColoured = Coloured * kLanes;
    const auto kept = std::size_t(chroma * chroma);
    alignas(HWY_MAX_BYTES) float sums[3 * kSums] = {};
    const float *const r = sums, *const g = sums + kSums, *const b = sums + 2 * kSums;
    const std::size_t stored = all.size() / caches.shNode.size();
    // From this link on vectors reach beyond the array's end. These are fewer halfs than kSums.
    const std::size_t behind = all.size() < kSums ? 0 : (all.size() - kSums) / stored + 1;
    std::uint16_t copies[2 * kSums] = {};
    if (ends[end - 1] > behind)
        std::copy(all.begin() + std::ptrdiff_t(behind * stored), all.end(), copies);
    const auto add = [&](std::size_t first, std::size_t last, const std::uint16_t* halfs) {
        addHarmonics<Bands, Coloured>(caches.shNode.data() + first, halfs, stored, last - first,
                                      radiosity, sums);
    };
    for (std::uint32_t c = begin; c < end; ++c) {
        const std::size_t first = caches.linkBegin[c], last = ends[c];
        const std::size_t middle = std::clamp(behind, first, last);
        std::fill(std::begin(sums), std::end(sums), 0.f);
        add(first, middle, all.data() + first * stored);
        if (middle < last)
            add(middle, last, copies + (middle - behind) * stored);
        const float scale = linkScale(caches, c);
        glm::vec3* out = sh + c * kCount;
        std::size_t i = 0;
        for (; i < kept; ++i)
            out[i] = glm::vec3(r[i], g[i], b[i]) * scale;
        for (; i < std::min(kColoured, kCount); ++i)
            out[i] = glm::vec3(toYCoCg({r[i], g[i], b[i]}).y * scale);
        for (; i < kCount; ++i)
            out[i] = glm::vec3(r[i] * scale);
    }
}

void lightHarmonics(const Caches& caches, LinkEnds ends, const glm::vec4* radiosity,
                    LightBands bands, LinkHalfs halfs, std::uint32_t begin, std::uint32_t end,
                    glm::vec3* sh) {
    using Light = void (*)(const Caches&, LinkEnds, const glm::vec4*, int, LinkHalfs, std::uint32_t,
                           std::uint32_t, glm::vec3*);
    constexpr Light kLight[] = {lightBands<2, vectorsOf(2)>, lightBands<3, vectorsOf(3)>,
                                lightBands<4, vectorsOf(4)>, lightBands<5, vectorsOf(5)>,
                                lightBands<6, vectorsOf(6)>, lightBands<7, vectorsOf(7)>,
                                lightBands<8, vectorsOf(8)>};
    kLight[bands.luma - 2](caches, ends, radiosity, bands.chroma, halfs, begin, end, sh);
}

} // namespace HWY_NAMESPACE
} // namespace limn
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limn {

HWY_EXPORT(lightHarmonics);

void lightHarmonics(const Caches& caches, LinkEnds ends, const std::vector<glm::vec4>& radiosity,
                    LightBands bands, LinkHalfs halfs, std::uint32_t begin, std::uint32_t end,
                    glm::vec3* sh) {
    HWY_DYNAMIC_DISPATCH(lightHarmonics)
    (caches, ends, radiosity.data(), bands, halfs, begin, end, sh);
}

} // namespace limn
#endif
