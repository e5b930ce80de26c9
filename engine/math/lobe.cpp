// SPDX-License-Identifier: MIT
#include "engine/math/lobe.h"

#include "engine/math/sh_basis.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace limn {

/// Smallest t for a lobe without width, by number of bands.
static constexpr std::array<float, kMaxBands + 1> kMirrorBlur = {
    0, 0, 0.20273f, 0.12417f, 0.09887f, 0.02879f, 0.02643f, 0.01244f, 0.00910f};

std::array<float, kMaxBands> windowedFactors(const std::array<float, kMaxBands>& s, int bands) {
    assert(bands >= 2 && bands <= kMaxBands);
    // To first order a lobe is itself such a blur, with the t that yields its last band; the window
    // only adds the rest. Below 0.001 the last band is negligible and needs no window.
    const float last = std::max(s[std::size_t(bands - 1)], 1e-3f);
    const float blur = -std::log(last) / float(bands * (bands - 1));
    const float t = std::max(kMirrorBlur[std::size_t(bands)] - blur, 0.f);
    std::array<float, kMaxBands> windowed{};
    for (int l = 0; l < bands; ++l)
        windowed[std::size_t(l)] = s[std::size_t(l)] * std::exp(-t * float(l * (l + 1)));
    return windowed;
}

glm::vec3 shLobe(int bands, const glm::vec3* c, glm::vec3 d,
                 const std::array<float, kMaxBands>& factors) {
    float y[kMaxCoefficients];
    shBasis(bands, d, y);
    glm::vec3 sum{0};
    for (int l = 0, i = 0; l < bands; ++l) {
        glm::vec3 band{0};
        for (; i < (l + 1) * (l + 1); ++i)
            band += c[i] * y[i];
        sum += band * factors[std::size_t(l)];
    }
    return sum;
}

float hemisphereSeen(const std::array<float, kMaxBands>& factors, int bands, float cosine) {
    // The hemisphere is 1/2 + sum of h_l P_l over odd l, h_l = (P_{l-1}(0) - P_{l+1}(0)) / 2.
    static constexpr float kHalf[kMaxBands] = {0.5f, 0.75f,     0, -7 / 16.f,
                                               0,    11 / 32.f, 0, -75 / 256.f};
    float sum = kHalf[0], before = 1, p = cosine; // P_{l-1}, P_l
    for (int l = 1; l < bands; ++l) {
        sum += kHalf[l] * factors[std::size_t(l)] * p;
        const float next = (float(2 * l + 1) * cosine * p - float(l) * before) / float(l + 1);
        before = p;
        p = next;
    }
    return std::max(sum, 0.5f);
}

std::array<float, kMaxBands + 1> lobeLosses(std::span<const double> s) {
    // The squared integral of P_l over a cap has the mean q_l = (1/(2l-1) + 1/(2l+3)) / (2l+1)^2
    // over caps of all sizes; the squared loss is the sum of (2l+1) q_l s_l^2.
    std::array<float, kMaxBands + 1> loss{};
    double sum = 0;
    for (std::size_t l = s.size() - 1; l > 0; --l) {
        const auto k = double(l);
        sum += (1 / (2 * k - 1) + 1 / (2 * k + 3)) / (2 * k + 1) * s[l] * s[l];
        if (l <= std::size_t(kMaxBands))
            loss[l] = float(std::sqrt(sum));
    }
    return loss;
}

} // namespace limn
