// SPDX-License-Identifier: MIT
#include "engine/math/lobe.h"

#include "engine/math/sampling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace limn::lobe_test {
namespace {

/// The least value of the kernel sum (2l+1) s_l P_l over its value in the middle.
double lowest(const std::array<float, kMaxBands>& s, int bands, double power = 1) {
    double middle = 0, least = 0;
    for (int i = 0; i <= 720; ++i) {
        const double x = std::cos(3.14159265358979 * i / 720);
        double k = 0;
        for (int l = 0; l < bands; ++l)
            k += (2 * l + 1) * std::pow(double(s[std::size_t(l)]), power) *
                 std::legendre(unsigned(l), x);
        if (i == 0)
            middle = k;
        least = std::min(least, k / middle);
    }
    return least;
}

/// lobeFactors() of 128 bands.
std::vector<double> longFactors(double n) {
    std::vector<double> s = {1, (n + 1) / (n + 2)};
    for (int l = 2; l < 128; ++l)
        s.push_back(s[std::size_t(l - 2)] * (n + 2 - l) / (n + l + 1));
    return s;
}

/// Simpson's rule.
template <class F>
double integrate(F f, double a, double b, int steps) {
    const double h = (b - a) / (2 * steps);
    double sum = f(a) + f(b);
    for (int i = 1; i < 2 * steps; ++i)
        sum += f(a + i * h) * (i % 2 ? 4 : 2);
    return sum * h / 3;
}

TEST(Lobe, WindowedLobesOfConstantRadianceAreThatRadiance) {
    for (int bands = 2; bands <= kMaxBands; ++bands)
        for (const float n : {0.f, 1.f, 30.f, 798.f}) {
            std::vector<glm::vec3> c(std::size_t(bands * bands), glm::vec3(0));
            c[0] = glm::vec3(3.5449077f) * glm::vec3(1, 2, 3);
            const glm::vec3 L = shLobe(bands, c.data(), glm::normalize(glm::vec3(1, 2, -3)),
                                       windowedFactors(lobeFactors(n), bands));
            EXPECT_LT(glm::length(L - glm::vec3(1, 2, 3)), 1e-5f) << bands << " " << n;
        }
}

TEST(Lobe, KernelsAreNowhereFarBelowZero) {
    for (int bands = 3; bands <= kMaxBands; ++bands)
        for (float n = 1; n < 800; n *= 1.3f)
            // A tenth of the peak; a thousandth for the window's first order.
            EXPECT_GT(lowest(windowedFactors(lobeFactors(n), bands), bands), -0.101)
                << bands << " " << n;
}

TEST(Lobe, NoneBecomesWiderThanADiffuseOne) {
    for (int bands = 2; bands <= kMaxBands; ++bands)
        for (float n = 1; n < 1e6f; n *= 1.3f)
            EXPECT_GT(windowedFactors(lobeFactors(n), bands)[1], lobeFactors(1)[1] - 1e-5f);
    EXPECT_NEAR(windowedFactors(lobeFactors(1e7f), 2)[1], lobeFactors(1)[1], 1e-5f)
        << "as narrow as that";
}

TEST(Lobe, OfAMirrorTheWindowIsTheLeastThatDoesSo) {
    for (int bands = 3; bands <= kMaxBands; ++bands) {
        const auto s = windowedFactors(lobeFactors(1e7f), bands);
        EXPECT_NEAR(lowest(s, bands), -0.1, 2e-4) << bands;
        EXPECT_LT(lowest(s, bands, 0.98), -0.1005) << bands << " bands with 2 % less blur";
    }
}

// The window adds what it takes off the bands that stay: of the same skies as lobeLosses().
TEST(Lobe, WindowsCostLessThanTheBandsThatAreMissing) {
    for (int bands = 3; bands <= kMaxBands; ++bands)
        for (const float n : {5.f, 30.f, 100.f, 798.f}) {
            const auto whole = lobeFactors(n), s = windowedFactors(lobeFactors(n), bands);
            double blur = 0;
            for (int l = 1; l < bands; ++l) {
                const double q = (1.0 / (2 * l - 1) + 1.0 / (2 * l + 3)) / (2 * l + 1);
                blur += q * std::pow(double(whole[std::size_t(l)] - s[std::size_t(l)]), 2);
            }
            const double lost = double(lobeLosses(longFactors(double(n)))[std::size_t(bands)]);
            EXPECT_LT(std::sqrt(blur), 1.2 * lost) << n << " " << bands;
            if (bands >= 5) {
                EXPECT_LT(std::sqrt(blur), 0.7 * lost) << n << " " << bands;
            }
        }
}

TEST(Lobe, WideLobesAreLeftAsTheyAre) {
    for (const auto& [n, bands] : {std::pair(5.f, 5), {5.f, 8}, {14.f, 7}, {18.f, 8}, {30.f, 8}})
        for (int l = 0; l < kMaxBands; ++l)
            EXPECT_EQ(windowedFactors(lobeFactors(n), bands)[std::size_t(l)],
                      l < bands ? lobeFactors(n)[std::size_t(l)] : 0)
                << n << " " << bands << " " << l;
}

TEST(Lobe, SeesOfAHemisphereWhatItsHarmonicsHave) {
    const glm::vec3 normal = glm::normalize(glm::vec3(1, 2, -2));
    const DirectionSet set(40000, false, 1);
    std::vector<glm::vec3> c(kMaxCoefficients, glm::vec3(0));
    for (std::uint32_t i = 0; i < set.count; ++i) {
        float y[kMaxCoefficients];
        shBasis(kMaxBands, basisAround(normal) * set[i], y);
        for (int k = 0; k < kMaxCoefficients; ++k)
            c[std::size_t(k)] += y[k] * set.solidAngle(i);
    }
    for (int bands = 2; bands <= kMaxBands; ++bands)
        for (const float n : {1.f, 5.f, 60.f})
            for (const float cosine : {0.1f, 0.5f, 1.f}) {
                const auto s = windowedFactors(lobeFactors(n), bands);
                const glm::vec3 d =
                    basisAround(normal) * glm::vec3(std::sqrt(1 - cosine * cosine), 0, cosine);
                EXPECT_NEAR(hemisphereSeen(s, bands, cosine), shLobe(bands, c.data(), d, s).x,
                            1e-3f)
                    << bands << " " << n << " " << cosine;
            }
    EXPECT_EQ(hemisphereSeen(lobeFactors(60), 8, -0.7f), 0.5f) << "below the horizon";
}

TEST(Lobe, LossIsTheRmsOverSkiesOfOneBrightCap) {
    constexpr int kCaps = 200, kLast = 40;
    for (const float n : {1.f, 5.f, 30.f}) {
        // (2l+1) times the mean square of the cap's integral, times the lobe's, both by quadrature.
        std::vector<double> power(kLast + 1);
        for (int l = 1; l <= kLast; ++l) {
            const auto P = [&](double x) { return std::legendre(unsigned(l), x); };
            double square = 0;
            for (int k = 0; k < kCaps; ++k) {
                const double a = integrate(P, -1 + (2 * k + 1.0) / kCaps, 1, 60);
                square += a * a / kCaps;
            }
            const double s = integrate(
                [&](double x) { return (n + 1) * std::pow(x, double(n)) * P(x); }, 0, 1, 400);
            power[std::size_t(l)] = (2 * l + 1) * square * s * s;
        }
        const auto loss = lobeLosses(longFactors(double(n)));
        for (int bands = 1; bands <= kMaxBands; ++bands) {
            double sum = 0;
            for (int l = bands; l <= kLast; ++l)
                sum += power[std::size_t(l)];
            EXPECT_NEAR(loss[std::size_t(bands)], std::sqrt(sum), 2e-3 * std::sqrt(sum) + 1e-4)
                << n << " " << bands;
        }
    }
}

} // namespace
} // namespace limn::lobe_test
