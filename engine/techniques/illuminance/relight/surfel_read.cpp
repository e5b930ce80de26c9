// SPDX-License-Identifier: MIT
// Compiled once for each kind of vector unit; the best one is chosen when the program runs.
#include "engine/techniques/illuminance/relight/surfel_read.h"

#include "engine/core/parallel.h"
#include "engine/core/vector_targets.h"
#include "engine/math/sh_basis.h"

#include <algorithm>
#include <array>

#include <glm/common.hpp>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/techniques/illuminance/relight/surfel_read.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace limn {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// The numbers of eight lanes. Fewer lanes than that read without vectors.
using Eight = hn::CappedTag<float, 8>;
inline constexpr bool kHasEight = hn::MaxLanes(Eight()) == 8;

/// Factors of the coefficients in a direction: the basis of shBasisFixed<3>() times `k`, which has
/// irradianceConstants(). As all of these functions, they are inlined into loops.
HWY_INLINE void factorsOf(glm::vec3 d, const float* k, float* factor) {
    factor[0] = k[0];
    factor[1] = k[1] * d.y;
    factor[2] = k[2] * d.z;
    factor[3] = k[3] * d.x;
    factor[4] = k[4] * (d.x * d.y);
    factor[5] = k[5] * (d.y * d.z);
    factor[6] = k[6] * (3 * d.z * d.z - 1);
    factor[7] = k[7] * (d.x * d.z);
    factor[8] = k[8] * (d.x * d.x - d.y * d.y);
}

/// Where the caches of a surfel begin, and their weights. A missing cache has no weight.
struct FourCaches {
    const float* cache[4];
    float weight[4];

    HWY_INLINE FourCaches(const Surfels& s, std::size_t i, const float* sh, std::size_t stride) {
        for (int k = 0; k < 4; ++k) {
            const std::uint32_t c = s.cache[i][k];
            cache[k] = sh + (c == ~0U ? 0 : c) * stride;
            weight[k] = s.cacheWeight[i][k];
        }
    }
    HWY_INLINE float mean(std::size_t j) const {
        return (cache[0][j] * weight[0] + cache[1][j] * weight[1]) +
               (cache[2][j] * weight[2] + cache[3][j] * weight[3]);
    }
};

template <std::size_t Count>
HWY_INLINE glm::vec3 read(const FourCaches& from, const float* factor) {
    glm::vec3 sum(0);
    for (std::size_t i = 0; i < Count; ++i)
        sum += factor[i] * glm::vec3(from.mean(3 * i), from.mean(3 * i + 1), from.mean(3 * i + 2));
    return sum;
}

#if HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
/// The same of nine coefficients: 24 numbers in three vectors, and the last three.
HWY_INLINE glm::vec3 readNine(const FourCaches& from, const float* factor) {
    const Eight d;
    const hn::RebindToSigned<Eight> indices;
    alignas(32) static constexpr std::int32_t kCoefficient[3][8] = {
        {0, 0, 0, 1, 1, 1, 2, 2}, {2, 3, 3, 3, 4, 4, 4, 5}, {5, 5, 6, 6, 6, 7, 7, 7}};
    const auto factors = hn::LoadU(d, factor);
    alignas(32) float product[24];
    for (std::size_t v = 0; v < 3; ++v) {
        auto mean = hn::Mul(hn::LoadU(d, from.cache[0] + 8 * v), hn::Set(d, from.weight[0]));
        for (int k = 1; k < 4; ++k)
            mean =
                hn::MulAdd(hn::LoadU(d, from.cache[k] + 8 * v), hn::Set(d, from.weight[k]), mean);
        const auto each = hn::TableLookupLanes(
            factors, hn::IndicesFromVec(d, hn::Load(indices, kCoefficient[v])));
        hn::Store(hn::Mul(mean, each), d, product + 8 * v);
    }
    glm::vec3 sum = factor[8] * glm::vec3(from.mean(24), from.mean(25), from.mean(26));
    for (std::size_t i = 0; i < 24; i += 3)
        sum += glm::vec3(product[i], product[i + 1], product[i + 2]);
    return sum;
}
#endif

void readCaches(const Surfels& s, const glm::vec3* sh, int bands, const float* constants,
                std::size_t begin, std::size_t end, glm::vec3* irradiance) {
    const auto stride = std::size_t(3 * bands * bands);
    float factor[9];
    for (std::size_t i = begin; i < end; ++i) {
        factorsOf(s.normal[i], constants, factor);
        const FourCaches from(s, i, &sh->x, stride);
        glm::vec3 e(0);
        if (bands < kIrradianceBands) {
            e = read<4>(from, factor);
        } else {
#if HWY_TARGET != HWY_SCALAR && HWY_TARGET != HWY_EMU128
            if constexpr (kHasEight)
                e = readNine(from, factor);
            else
#endif
                e = read<9>(from, factor);
        }
        irradiance[i] = glm::max(e, glm::vec3(0));
    }
}

} // namespace HWY_NAMESPACE
} // namespace limn
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace limn {

HWY_EXPORT(readCaches);

/// What the polynomials of factorsOf() are multiplied by for irradiance.
static std::array<float, 9> irradianceConstants() {
    const std::array<float, kMaxBands> band = irradianceFactors();
    std::array<float, 9> x, y, z, xyz;
    shBasisFixed<3>({1, 0, 0}, x.data());
    shBasisFixed<3>({0, 1, 0}, y.data());
    shBasisFixed<3>({0, 0, 1}, z.data());
    shBasisFixed<3>({1, 1, 1}, xyz.data());
    return {x[0] * band[0],     y[1] * band[1],   z[2] * band[1],
            x[3] * band[1],     xyz[4] * band[2], xyz[5] * band[2],
            z[6] / 2 * band[2], xyz[7] * band[2], x[8] * band[2]};
}

void readCaches(const Surfels& surfels, const std::vector<glm::vec3>& sh, int bands,
                std::vector<glm::vec3>& irradiance) {
    if (sh.empty())
        return;
    static const std::array<float, 9> constants = irradianceConstants();
    parallelRanges(surfels.size(), 256, [&](std::size_t begin, std::size_t end) {
        HWY_DYNAMIC_DISPATCH(readCaches)
        (surfels, sh.data(), bands, constants.data(), begin, end, irradiance.data());
    });
}

} // namespace limn
#endif
