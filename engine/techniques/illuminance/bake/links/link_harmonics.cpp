// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/links/link_harmonics.h"

#include "engine/math/cone.h"
#include "engine/math/horizon.h"
#include "engine/math/sh_basis.h"

#include <algorithm>

namespace limn {

void addHarmonics(int bands, glm::vec3 direction, float u, float transport, float* coefficients) {
    withBands(bands, [&]<int Bands>() {
        float y[Bands * Bands], g[Bands];
        shBasisFixed<Bands>(direction, y);
        if (u > 0)
            coneFactors(Bands, u, g);
        else
            std::fill_n(g, Bands, 1.f);
        for (int l = 0, i = 0; l < Bands; ++l)
            for (; i < (l + 1) * (l + 1); ++i)
                coefficients[i] += transport * g[l] * y[i];
    });
}

IrradianceAxis::IrradianceAxis(int bands, std::span<const glm::vec3> normals, glm::vec3 plane)
    : m_count(bands * bands), m_axis{} {
    const auto factors = irradianceFactors();
    for (const glm::vec3 normal : normals) {
        float y[kMaxCoefficients];
        shBasis(bands, normal, y);
        for (int l = 0, i = 0; l < bands; ++l)
            for (; i < (l + 1) * (l + 1); ++i)
                m_axis[i] += factors[std::size_t(l)] * y[i] / float(normals.size());
    }
    weighContinued(plane, m_axis);
}

float IrradianceAxis::irradiance(const float* coefficients) const {
    float sum = 0;
    for (int i = 0; i < m_count; ++i)
        sum += m_axis[i] * coefficients[i];
    return sum;
}

float IrradianceAxis::gainTo(float irradiance, const float* coefficients) const {
    const float series = this->irradiance(coefficients);
    return series > 0 ? std::min(irradiance / series, kMaxGain) : 1;
}

} // namespace limn
