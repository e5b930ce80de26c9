// SPDX-License-Identifier: MIT
#include "engine/runtime/extrapolation.h"

#include "engine/runtime/convergence.h"

#include <algorithm>
#include <cmath>

namespace limn::runtime {

namespace {

constexpr std::uint32_t kKept = Extrapolation::kKept, kUnknowns = kKept - 1;

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

F4 absolute(F4 v) {
    return v < 0.f ? -v : v;
}

double sumOf(const double* rgb) {
    return rgb[0] + rgb[1] + rgb[2];
}

} // namespace

/// Sums over surfels. Floats sum up a few of them, and doubles these sums.
struct Extrapolation::Sums {
    F4 sent{}, all{};          ///< times area: changes of what is sent, and all of it
    F4 out{}, into{}, light{}; ///< squares of what came out of the bounce and went into it
    F4 product[kKept] = {};    ///< of the newest change with others, by age
    double relative = 0;
};
struct Extrapolation::Totals {
    double sent[3] = {}, all[3] = {}, out[3] = {}, into[3] = {}, light[3] = {};
    double product[kKept][3] = {};
    double relative = 0;

    void operator+=(const Sums& s) {
        for (int c = 0; c < 3; ++c) {
            sent[c] += double(s.sent[c]);
            all[c] += double(s.all[c]);
            out[c] += double(s.out[c]);
            into[c] += double(s.into[c]);
            light[c] += double(s.light[c]);
            for (std::uint32_t age = 0; age < kKept; ++age)
                product[age][c] += double(s.product[age][c]);
        }
        relative += s.relative;
    }
};

void Extrapolation::before(const F4* irradiance, std::size_t surfels) {
    m_newest = (m_newest + 1) % kKept;
    std::copy(irradiance, irradiance + surfels, change[m_newest]);
}

Residual Extrapolation::replace(const BouncedLight& light) {
    constexpr std::size_t kBlock = 32;
    m_count = std::min(m_count + 1, kKept);
    Totals totals;
    for (std::size_t begin = 0; begin < light.surfels; begin += kBlock) {
        Sums sums;
        for (std::size_t s = begin; s < std::min(begin + kBlock, light.surfels); ++s)
            take(light, s, sums);
        totals += sums;
    }
    for (std::uint32_t age = 0; age < m_count; ++age)
        for (int c = 0; c < 3; ++c)
            m_products[m_newest][slot(age)][c] = m_products[slot(age)][m_newest][c] =
                totals.product[age][c];
    if (m_count >= 2) {
        measurePassedOn(totals.into, totals.out, totals.light);
        combine(light);
    }
    return {sumOf(totals.sent), sumOf(totals.all), totals.relative, m_passedOn};
}

/// Turns what went into the bounce at a surfel into its change, and adds to the sums. A surfel's
/// weight in products of irradiances is its albedo times its area: with it, a bounce is a symmetric
/// map, as long as its links are reciprocal, so that no change passes on more than the slowest one.
inline void Extrapolation::take(const BouncedLight& light, std::size_t s, Sums& sums) {
    const std::uint32_t last = slot(1);
    const F4 irradiance = light.irradiance[s], albedo = light.albedo[s], b = light.radiosity[s],
             area = splat(light.area[s]), weight = albedo * area,
             d = irradiance - change[m_newest][s];
    change[m_newest][s] = d;
    after[m_newest][s] = irradiance;
    const F4 sent = absolute(d * albedo);
    sums.sent += sent * area;
    sums.all += b * area;
    sums.relative += double(relativeChange(sent[0] + sent[1] + sent[2], b[0] + b[1] + b[2]) *
                            light.seenShare[s]);
    const F4 weighted = d * weight;
    sums.product[0] += weighted * d;
    if (m_count < 2)
        return;
    const F4 out = irradiance - after[last][s], into = out - d + change[last][s];
    sums.out += out * out * weight;
    sums.into += into * into * weight;
    sums.light += irradiance * irradiance * weight;
    for (std::uint32_t age = 1; age < m_count; ++age)
        sums.product[age] += weighted * change[slot(age)][s];
}

/// By the latest two bounces.
void Extrapolation::measurePassedOn(const double* into, const double* out, const double* light) {
    constexpr double kRounding = 1e-8; // squares of changes that are mostly rounding
    for (int c = 0; c < 3; ++c)
        if (into[c] > kRounding * light[c] && into[c] > 0)
            m_passedOn = std::max(m_passedOn, std::sqrt(out[c] / into[c]));
}

void Extrapolation::combine(const BouncedLight& light) {
    F4 factor[kUnknowns] = {};
    const std::uint32_t unknowns = m_count - 1;
    for (int c = 0; c < 3; ++c) {
        const auto product = [&](std::uint32_t i, std::uint32_t j) {
            return m_products[slot(i)][slot(j)][c];
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
