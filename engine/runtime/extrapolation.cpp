// SPDX-License-Identifier: MIT
#include "engine/runtime/extrapolation.h"

#include "engine/runtime/convergence.h"

#include <algorithm>
#include <cmath>

namespace limn::runtime {

namespace {

constexpr std::uint32_t kKept = Extrapolation::kKept, kUnknowns = kKept - 1;

/// Products of the changes of bounces i and j, summed over surfels, for each colour.
struct Products {
    double of[kKept][kKept][3] = {};
};

/// Solves the symmetric system a x = b of n unknowns by elimination. Unknowns on which nothing
/// depends become 0.
void solve(double a[kUnknowns][kUnknowns], double* b, std::uint32_t n, double* x) {
    constexpr double kSingular = 1e-10;
    double scale = 0;
    for (std::uint32_t i = 0; i < n; ++i)
        scale = std::max(scale, a[i][i]);
    bool used[kUnknowns] = {};
    for (std::uint32_t i = 0; i < n; ++i) {
        used[i] = a[i][i] > kSingular * scale;
        for (std::uint32_t row = i + 1; used[i] && row < n; ++row) {
            const double factor = a[row][i] / a[i][i];
            for (std::uint32_t k = i; k < n; ++k)
                a[row][k] -= factor * a[i][k];
            b[row] -= factor * b[i];
        }
    }
    for (std::uint32_t i = n; i-- > 0;) {
        x[i] = used[i] ? b[i] : 0;
        for (std::uint32_t k = i + 1; used[i] && k < n; ++k)
            x[i] -= a[i][k] * x[k];
        if (used[i])
            x[i] /= a[i][i];
    }
}

/// A surfel's weight in products of irradiances: with it, a bounce is a symmetric map, as long as
/// its links are reciprocal, so that no change passes on more than the slowest one.
F4 weightOf(const BouncedLight& light, std::size_t s) {
    return light.albedo[s] * splat(light.area[s]);
}

} // namespace

void Extrapolation::before(const F4* irradiance, std::size_t surfels) {
    m_newest = (m_newest + 1) % kKept;
    std::copy(irradiance, irradiance + surfels, change[m_newest]);
}

Residual Extrapolation::replace(const BouncedLight& light) {
    m_count = std::min(m_count + 1, kKept);
    Residual residual;
    for (std::size_t s = 0; s < light.surfels; ++s) {
        after[m_newest][s] = light.irradiance[s];
        const F4 d = light.irradiance[s] - change[m_newest][s], b = light.radiosity[s];
        change[m_newest][s] = d;
        const F4 sent = d * light.albedo[s];
        const float changed = std::fabs(sent[0]) + std::fabs(sent[1]) + std::fabs(sent[2]),
                    sum = b[0] + b[1] + b[2];
        residual.change += double(changed) * double(light.area[s]);
        residual.total += double(sum) * double(light.area[s]);
        residual.relative += double(relativeChange(changed, sum) * light.seenShare[s]);
    }
    if (m_count >= 2) {
        measurePassedOn(light);
        combine(light);
    }
    residual.passedOn = m_passedOn;
    return residual;
}

void Extrapolation::measurePassedOn(const BouncedLight& light) {
    constexpr double kRounding = 1e-8; // squares of changes that are mostly rounding
    double into[3] = {}, out[3] = {}, all[3] = {};
    const std::uint32_t now = slot(0), last = slot(1);
    for (std::size_t s = 0; s < light.surfels; ++s) {
        const F4 weight = weightOf(light, s), g = after[now][s] - after[last][s],
                 x = g - change[now][s] + change[last][s];
        const F4 g2 = g * g * weight, x2 = x * x * weight,
                 a2 = after[now][s] * after[now][s] * weight;
        for (int c = 0; c < 3; ++c) {
            out[c] += double(g2[c]);
            into[c] += double(x2[c]);
            all[c] += double(a2[c]);
        }
    }
    for (int c = 0; c < 3; ++c)
        if (into[c] > kRounding * all[c] && into[c] > 0)
            m_passedOn = std::max(m_passedOn, std::sqrt(out[c] / into[c]));
}

void Extrapolation::combine(const BouncedLight& light) {
    Products sum;
    for (std::size_t s = 0; s < light.surfels; ++s) {
        const F4 weight = weightOf(light, s);
        for (std::uint32_t i = 0; i < m_count; ++i) {
            const F4 weighted = change[slot(i)][s] * weight;
            for (std::uint32_t j = 0; j <= i; ++j) {
                const F4 product = weighted * change[slot(j)][s];
                for (int c = 0; c < 3; ++c)
                    sum.of[i][j][c] += double(product[c]);
            }
        }
    }
    F4 factor[kUnknowns] = {};
    const std::uint32_t unknowns = m_count - 1;
    for (int c = 0; c < 3; ++c) {
        const auto product = [&](std::uint32_t i, std::uint32_t j) {
            return sum.of[std::max(i, j)][std::min(i, j)][c];
        };
        double a[kUnknowns][kUnknowns] = {}, b[kUnknowns] = {}, x[kUnknowns] = {};
        for (std::uint32_t i = 0; i < unknowns; ++i) {
            for (std::uint32_t j = 0; j < unknowns; ++j)
                a[i][j] =
                    product(i + 1, j + 1) - product(i + 1, 0) - product(j + 1, 0) + product(0, 0);
            b[i] = product(0, 0) - product(i + 1, 0);
        }
        solve(a, b, unknowns, x);
        for (std::uint32_t i = 0; i < unknowns; ++i)
            factor[i][c] = std::isfinite(x[i]) ? float(x[i]) : 0.f;
    }
    for (std::size_t s = 0; s < light.surfels; ++s) {
        F4 ahead = light.irradiance[s];
        for (std::uint32_t i = 0; i < unknowns; ++i)
            ahead += factor[i] * (after[slot(i + 1)][s] - light.irradiance[s]);
        light.irradiance[s] = ahead > 0.f ? ahead : F4{};
    }
}

} // namespace limn::runtime
