// SPDX-License-Identifier: MIT
#include "engine/relight/surfel_read.h"

#include "engine/core/parallel.h"
#include "engine/math/sh_basis.h"

#include <glm/common.hpp>

namespace limn {

namespace {

/// Sum over coefficients [Begin, End) of factor[i] * (the four caches' mean of coefficient i).
template <int Begin, int End>
glm::vec3 addSpan(const glm::vec3* const caches[4], glm::vec4 weight, const float* factor) {
    constexpr int kFloats = (End - Begin) * 3;
    const float* const c[4] = {&caches[0][Begin].x, &caches[1][Begin].x, &caches[2][Begin].x,
                               &caches[3][Begin].x};
    float mixed[kFloats];
    for (int j = 0; j < kFloats; ++j)
        mixed[j] =
            (c[0][j] * weight.x + c[1][j] * weight.y) + (c[2][j] * weight.z + c[3][j] * weight.w);
    glm::vec3 sum(0);
    for (int i = 0; i < End - Begin; ++i)
        sum += factor[Begin + i] * glm::vec3(mixed[3 * i], mixed[3 * i + 1], mixed[3 * i + 2]);
    return sum;
}

template <int Bands>
void readRange(const Surfels& s, const glm::vec3* sh, std::size_t begin, std::size_t end,
               glm::vec3* irradiance) {
    constexpr int kRead = Bands < 5 ? (Bands < 3 ? Bands : 3) : (Bands < 7 ? 5 : 7);
    static const std::array<float, kMaxBands> band = irradianceFactors();
    float factor[kRead * kRead];
    for (std::size_t i = begin; i < end; ++i) {
        shBasisFixed<kRead>(s.normal[i], factor);
        for (int l = 0, k = 0; l < kRead; ++l)
            for (; k < (l + 1) * (l + 1); ++k)
                factor[k] *= band[std::size_t(l)];
        const glm::vec3* caches[4];
        for (int k = 0; k < 4; ++k) // a missing one has no weight
            caches[k] = sh + std::size_t(s.cache[i][k] == ~0U ? 0 : s.cache[i][k]) * Bands * Bands;
        // Bands 0 to 2, then 4, then 6.
        glm::vec3 e = addSpan < 0,
                  kRead < 3 ? kRead * kRead : 9 > (caches, s.cacheWeight[i], factor);
        if constexpr (kRead >= 5)
            e += addSpan<16, 25>(caches, s.cacheWeight[i], factor);
        if constexpr (kRead >= 7)
            e += addSpan<36, 49>(caches, s.cacheWeight[i], factor);
        irradiance[i] = glm::max(e, glm::vec3(0));
    }
}

} // namespace

void readCaches(const Surfels& surfels, const std::vector<glm::vec3>& sh, int bands,
                std::vector<glm::vec3>& irradiance) {
    if (sh.empty())
        return;
    parallelRanges(surfels.size(), 256, [&](std::size_t begin, std::size_t end) {
        withBands(bands, [&]<int Bands>() {
            readRange<Bands>(surfels, sh.data(), begin, end, irradiance.data());
        });
    });
}

} // namespace limn
