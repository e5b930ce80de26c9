// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/relight/surfel_read.h"

#include "engine/core/parallel.h"
#include "engine/math/sh_basis.h"

#include <glm/common.hpp>

namespace limn {

namespace {

/// Sum over coefficients of factor[i] * (the four caches' mean of coefficient i).
template <int Count>
glm::vec3 sumOf(const glm::vec3* const caches[4], glm::vec4 weight, const float* factor) {
    constexpr int kFloats = Count * 3;
    const float* const c[4] = {&caches[0]->x, &caches[1]->x, &caches[2]->x, &caches[3]->x};
    float mixed[kFloats];
    for (int j = 0; j < kFloats; ++j)
        mixed[j] =
            (c[0][j] * weight.x + c[1][j] * weight.y) + (c[2][j] * weight.z + c[3][j] * weight.w);
    glm::vec3 sum(0);
    for (int i = 0; i < Count; ++i)
        sum += factor[i] * glm::vec3(mixed[3 * i], mixed[3 * i + 1], mixed[3 * i + 2]);
    return sum;
}

/// `stride`: number of coefficients per cache.
template <int Bands>
void readRange(const Surfels& s, const glm::vec3* sh, std::size_t stride, std::size_t begin,
               std::size_t end, glm::vec3* irradiance) {
    static const std::array<float, kMaxBands> band = irradianceFactors();
    float factor[Bands * Bands];
    for (std::size_t i = begin; i < end; ++i) {
        shBasisFixed<Bands>(s.normal[i], factor);
        for (int l = 0, k = 0; l < Bands; ++l)
            for (; k < (l + 1) * (l + 1); ++k)
                factor[k] *= band[std::size_t(l)];
        const glm::vec3* caches[4];
        for (int k = 0; k < 4; ++k) // a missing cache has no weight
            caches[k] = sh + (s.cache[i][k] == ~0U ? 0 : s.cache[i][k]) * stride;
        irradiance[i] =
            glm::max(sumOf<Bands * Bands>(caches, s.cacheWeight[i], factor), glm::vec3(0));
    }
}

} // namespace

void readCaches(const Surfels& surfels, const std::vector<glm::vec3>& sh, int bands,
                std::vector<glm::vec3>& irradiance) {
    if (sh.empty())
        return;
    parallelRanges(surfels.size(), 256, [&](std::size_t begin, std::size_t end) {
        const auto read = bands < kIrradianceBands ? readRange<2> : readRange<kIrradianceBands>;
        read(surfels, sh.data(), std::size_t(bands * bands), begin, end, irradiance.data());
    });
}

} // namespace limn
