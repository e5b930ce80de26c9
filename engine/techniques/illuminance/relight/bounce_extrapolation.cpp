// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/relight/bounce_extrapolation.h"

#include "engine/core/parallel.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/vec4.hpp>

namespace limn {

namespace {

constexpr std::size_t kSurfelsOfSum = 1024; ///< summed by one thread, for any number of threads

/// Sums what `add(sum, i)` adds for each i below `count`.
template <class Sum, class Add>
Sum sumOver(std::size_t count, const Add& add) {
    std::vector<Sum> sums((count + kSurfelsOfSum - 1) / kSurfelsOfSum);
    parallelRanges(sums.size(), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t k = begin; k < end; ++k)
            for (std::size_t i = k * kSurfelsOfSum; i < std::min((k + 1) * kSurfelsOfSum, count);
                 ++i)
                add(sums[k], i);
    });
    Sum all{};
    for (const Sum& sum : sums)
        all += sum;
    return all;
}

/// Solves the symmetric system a x = b of n unknowns by elimination. Unknowns on which nothing
/// depends become 0.
template <std::size_t N>
std::array<double, N> solve(std::array<std::array<double, N>, N> a, std::array<double, N> b,
                            std::uint32_t n) {
    constexpr double kSingular = 1e-10;
    double scale = 0;
    for (std::uint32_t i = 0; i < n; ++i)
        scale = std::max(scale, a[i][i]);
    std::array<bool, N> used{};
    for (std::uint32_t i = 0; i < n; ++i) {
        used[i] = a[i][i] > kSingular * scale;
        for (std::uint32_t row = i + 1; used[i] && row < n; ++row) {
            const double factor = a[row][i] / a[i][i];
            for (std::uint32_t k = i; k < n; ++k)
                a[row][k] -= factor * a[i][k];
            b[row] -= factor * b[i];
        }
    }
    std::array<double, N> x{};
    for (std::uint32_t i = n; i-- > 0;) {
        if (!used[i])
            continue;
        x[i] = b[i];
        for (std::uint32_t k = i + 1; k < n; ++k)
            x[i] -= a[i][k] * x[k];
        x[i] /= a[i][i];
    }
    return x;
}

/// A surfel's weight in products of irradiances, whose squares may leave the range of floats: with
/// it, a bounce is a symmetric map, as far as links are reciprocal, so that no change passes on
/// more than the slowest one.
glm::dvec3 weightOf(const BouncingSurfels& surfels, std::size_t i) {
    return glm::dvec3(surfels.albedo[i]) * double(surfels.area[i]);
}

/// Squares of what went into two bounces, apart, and of what came out of them.
struct PassedOnSum {
    glm::dvec3 into{0}, out{0}, all{0};
    void operator+=(const PassedOnSum& other) {
        into += other.into;
        out += other.out;
        all += other.all;
    }
};

template <std::size_t N>
struct Products {
    std::array<glm::dvec3, N> value{};
    void operator+=(const Products& other) {
        for (std::size_t i = 0; i < N; ++i)
            value[i] += other.value[i];
    }
};

} // namespace

void BounceExtrapolation::clear() {
    m_count = 0;
    m_passedOn = 0;
    m_begun = m_grows = false;
    m_residual.reset();
}

void BounceExtrapolation::release() {
    *this = {};
}

void BounceExtrapolation::begin(std::span<const glm::vec3> irradiance) {
    m_newest = (m_newest + 1) % kKept;
    m_change[m_newest].assign(irradiance.begin(), irradiance.end());
    m_begun = true;
}

void BounceExtrapolation::end(const BouncingSurfels& surfels, std::span<glm::vec3> irradiance) {
    if (!m_begun || m_grows)
        return;
    m_begun = false;
    m_count = std::min(m_count + 1, kKept);
    m_after[m_newest].assign(irradiance.begin(), irradiance.end());
    const RoundChange change = takeChange(surfels, irradiance);
    multiplyNewest(surfels);
    if (m_count < 2)
        return;
    m_passedOn = std::max(m_passedOn, sharePassedOn(surfels));
    m_grows = !(m_passedOn < 1);
    m_residual.reset();
    if (m_grows)
        return;
    m_residual = Residual{change, m_passedOn};
    combine(bestFactors(), irradiance);
}

void BounceExtrapolation::addRound(const RoundChange& round, Convergence& convergence) const {
    if (m_residual)
        convergence.addResidual(m_residual->change, m_residual->passedOn);
    else
        convergence.addRound(round, m_grows);
}

/// Turns what went into the bounce into its change.
RoundChange BounceExtrapolation::takeChange(const BouncingSurfels& surfels,
                                            std::span<const glm::vec3> irradiance) {
    PerSurfel& change = m_change[m_newest];
    return sumOver<RoundChange>(irradiance.size(), [&](RoundChange& sum, std::size_t i) {
        change[i] = irradiance[i] - change[i];
        const glm::vec3 sent = glm::abs(change[i] * surfels.albedo[i]);
        const float changed = sent.x + sent.y + sent.z,
                    all = surfels.radiosity[i].x + surfels.radiosity[i].y + surfels.radiosity[i].z;
        sum.change += double(changed) * double(surfels.area[i]);
        sum.total += double(all) * double(surfels.area[i]);
        sum.relative += double(relativeChange(changed, all) * surfels.seenShare[i]);
    });
}

/// By the latest two bounces.
double BounceExtrapolation::sharePassedOn(const BouncingSurfels& surfels) const {
    constexpr double kRounding = 1e-8; // squares of changes that are mostly rounding
    const PerSurfel &after = m_after[slot(0)], &afterLast = m_after[slot(1)],
                    &change = m_change[slot(0)], &changeLast = m_change[slot(1)];
    const auto sum = sumOver<PassedOnSum>(after.size(), [&](PassedOnSum& s, std::size_t i) {
        const glm::dvec3 weight = weightOf(surfels, i), all = after[i],
                         out = all - glm::dvec3(afterLast[i]),
                         into = out - glm::dvec3(change[i]) + glm::dvec3(changeLast[i]);
        s.out += out * out * weight;
        s.into += into * into * weight;
        s.all += all * all * weight;
    });
    double share = 0;
    for (int c = 0; c < 3; ++c)
        if (sum.into[c] > kRounding * sum.all[c] && sum.into[c] > 0)
            share = std::max(share, std::sqrt(sum.out[c] / sum.into[c]));
    return share;
}

/// Products with older changes are known already.
void BounceExtrapolation::multiplyNewest(const BouncingSurfels& surfels) {
    using Sum = Products<kKept>;
    const auto sum = sumOver<Sum>(surfels.albedo.size(), [&](Sum& s, std::size_t i) {
        const glm::dvec3 weighted = glm::dvec3(m_change[m_newest][i]) * weightOf(surfels, i);
        for (std::uint32_t age = 0; age < m_count; ++age)
            s.value[age] += weighted * glm::dvec3(m_change[slot(age)][i]);
    });
    for (std::uint32_t age = 0; age < m_count; ++age)
        m_products[m_newest][slot(age)] = m_products[slot(age)][m_newest] = sum.value[age];
}

/// The factors of older bounces with which the combined change is the smallest.
BounceExtrapolation::Factors BounceExtrapolation::bestFactors() const {
    Factors factors{};
    const std::uint32_t unknowns = m_count - 1;
    for (int c = 0; c < 3; ++c) {
        const auto product = [&](std::uint32_t i, std::uint32_t j) {
            return m_products[slot(i)][slot(j)][c];
        };
        std::array<std::array<double, kUnknowns>, kUnknowns> a{};
        std::array<double, kUnknowns> b{};
        for (std::uint32_t i = 0; i < unknowns; ++i) {
            for (std::uint32_t j = 0; j < unknowns; ++j)
                a[i][j] =
                    product(i + 1, j + 1) - product(i + 1, 0) - product(j + 1, 0) + product(0, 0);
            b[i] = product(0, 0) - product(i + 1, 0);
        }
        const std::array<double, kUnknowns> x = solve(a, b, unknowns);
        for (std::uint32_t i = 0; i < unknowns; ++i)
            factors[i][c] = std::isfinite(x[i]) ? float(x[i]) : 0.f;
    }
    return factors;
}

void BounceExtrapolation::combine(const Factors& factors, std::span<glm::vec3> irradiance) const {
    parallelRanges(irradiance.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            glm::vec3 ahead = irradiance[i];
            for (std::uint32_t k = 0; k + 1 < m_count; ++k)
                ahead += factors[k] * (m_after[slot(k + 1)][i] - irradiance[i]);
            irradiance[i] = glm::max(ahead, glm::vec3(0));
        }
    });
}

std::uint64_t BounceExtrapolation::bytes() const {
    std::uint64_t bytes = 0;
    for (const auto* kept : {&m_change, &m_after})
        for (const PerSurfel& values : *kept)
            bytes += values.capacity() * sizeof(glm::vec3);
    return bytes;
}

} // namespace limn
