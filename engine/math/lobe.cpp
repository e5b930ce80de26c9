// SPDX-License-Identifier: MIT
#include "engine/math/lobe.h"

#include "engine/math/sh_basis.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace limn {

/// The least t for a lobe without width, of so many bands.
static constexpr std::array<float, kMaxBands + 1> kMirrorBlur = {
    0, 0, 0.20273f, 0.12417f, 0.09887f, 0.02879f, 0.02643f, 0.01244f, 0.00910f};

float lobeExponent(float roughness) {
    const float alpha = std::max(roughness * roughness, 0.05f);
    return std::max(2 / (alpha * alpha) - 2, 0.f);
}

std::array<float, kMaxBands> windowedLobeFactors(float n, int bands) {
    assert(n >= 0 && bands >= 2 && bands <= kMaxBands);
    // To first order a lobe is itself such a blur, of the t that gives its s_1: what it has, the
    // window need not add.
    const float own = 0.5f * std::log((n + 2) / (n + 1));
    const float t = std::max(kMirrorBlur[std::size_t(bands)] - own, 0.f);
    std::array<float, kMaxBands> s = lobeFactors(n);
    for (int l = 0; l < kMaxBands; ++l)
        s[std::size_t(l)] *= l < bands ? std::exp(-t * float(l * (l + 1))) : 0.f;
    return s;
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

std::array<float, kMaxBands + 1> lobeLosses(float n) {
    // The integral of P_l over a cap, squared, has the mean q_l = (1/(2l-1) + 1/(2l+3)) / (2l+1)^2
    // over caps of all sizes; the loss squared is the sum of (2l+1) q_l s_l^2. Of the narrowest
    // lobe, n = 798, the bands from 128 on would add 1e-7.
    constexpr int kEnd = 128;
    std::array<double, kEnd> term{};
    double before = 1, s = (n + 1.0) / (n + 2.0); // s_{l-1}, s_l
    for (int l = 1; l < kEnd; ++l) {
        term[std::size_t(l)] = (1.0 / (2 * l - 1) + 1.0 / (2 * l + 3)) / (2 * l + 1) * s * s;
        const double next = before * (n + 1.0 - l) / (n + 2.0 + l);
        before = s;
        s = next;
    }
    std::array<float, kMaxBands + 1> loss{};
    double sum = 0;
    for (int l = kEnd - 1; l > 0; --l) {
        sum += term[std::size_t(l)];
        if (l <= kMaxBands)
            loss[std::size_t(l)] = float(std::sqrt(sum));
    }
    return loss;
}

} // namespace limn
