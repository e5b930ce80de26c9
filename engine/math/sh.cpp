// SPDX-License-Identifier: MIT
#include "engine/math/sh.h"

#include "engine/math/sh_basis.h"

#include <cassert>
#include <numbers>

namespace limn {

void shBasis(int bands, glm::vec3 d, float* y) {
    assert(bands >= 1 && bands <= kMaxBands);
    withBands(bands, [&]<int Bands>() { shBasisFixed<Bands>(d, y); });
}

std::array<float, kMaxBands> lobeFactors(float n) {
    std::array<float, kMaxBands> s{};
    s[0] = 1;
    s[1] = (n + 1) / (n + 2);
    for (int l = 2; l < kMaxBands; ++l)
        s[std::size_t(l)] = s[std::size_t(l - 2)] * (n + 2 - float(l)) / (n + float(l) + 1);
    return s;
}

std::array<float, kMaxBands> irradianceFactors() {
    std::array<float, kMaxBands> a = lobeFactors(1);
    for (float& factor : a)
        factor *= std::numbers::pi_v<float>;
    return a;
}

glm::vec3 shIrradiance(int bands, const glm::vec3* c, glm::vec3 n) {
    static const auto a = irradianceFactors();
    float y[kMaxCoefficients];
    shBasis(bands, n, y);
    glm::vec3 e{0};
    for (int l = 0, i = 0; l < bands; ++l) {
        glm::vec3 band{0};
        for (const int end = (l + 1) * (l + 1); i < end; ++i)
            band += c[i] * y[i];
        e += band * a[std::size_t(l)];
    }
    return e;
}

} // namespace limn
