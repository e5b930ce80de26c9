// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/format/bake.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// How far two arrays of colours are apart.
struct Distance {
    double max = 0, rms = 0;
};

template <class T>
Distance distance(const std::vector<T>& a, const std::vector<T>& b) {
    EXPECT_EQ(a.size(), b.size());
    Distance d;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        for (int k = 0; k < 3; ++k) {
            const double x = std::abs(double(a[i][k]) - double(b[i][k]));
            d.max = std::max(d.max, x);
            d.rms += x * x;
        }
    d.rms = std::sqrt(d.rms / double(std::max<std::size_t>(3 * a.size(), 1)));
    return d;
}

inline double largest(const std::vector<glm::vec3>& values) {
    double out = 0;
    for (const glm::vec3 v : values)
        out = std::max({out, double(v.x), double(v.y), double(v.z)});
    return out;
}

inline double maxLinks(const Caches& caches) {
    std::uint32_t most = 0;
    for (std::size_t c = 0; c < caches.size(); ++c)
        most = std::max(most, caches.linkBegin[c + 1] - caches.linkBegin[c]);
    return most;
}

/// Both sum the same numbers in 32 bits, in other orders. Each step rounds by 2^-25 / sqrt(3) of
/// the sum so far (rms), which over n steps that end at S makes sqrt(n) / 6 2^-24 S, and for the
/// difference of two such sums a quarter of sqrt(n) 2^-24 S; half a unit more for what is done to
/// the sums. S is at most `scale`, the largest value there is, but terms of higher bands have both
/// signs and are up to sqrt(2 l + 1) < 4 times those of the first. The largest of some thousand
/// differences lies within six standard deviations.
inline void expectRounding(const char* what, const Distance& d, double terms, double scale) {
    const double unit = std::ldexp(scale, -24), rms = 0.25 * std::sqrt(terms) + 0.5;
    EXPECT_LT(d.max, 6 * 4 * rms * unit) << what;
    EXPECT_LT(d.rms, rms * unit) << what;
    std::printf("  %-10s max %.1e rms %.1e of the largest, %.2f and %.2f of what is allowed\n",
                what, d.max / scale, d.rms / scale, d.max / (6 * 4 * rms * unit),
                d.rms / (rms * unit));
}

/// Expects what the GPU keeps in halfs to be `expected` but for rounding to halfs and what
/// expectRounding() allows.
inline void expectHalves(const char* what, const std::vector<glm::vec4>& halves,
                         const std::vector<glm::vec4>& expected, double terms, double scale) {
    ASSERT_EQ(halves.size(), expected.size()) << what;
    const double summed = 6 * 4 * (0.25 * std::sqrt(terms) + 0.5) * std::ldexp(scale, -24);
    double worst = 0;
    for (std::size_t i = 0; i < halves.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double e = double(expected[i][c]),
                         allowed = std::ldexp(std::abs(e), -11) + summed;
            worst = std::max(worst, std::abs(double(halves[i][c]) - e) / allowed);
        }
    EXPECT_LT(worst, 1.001) << what; // of a value that sums otherwise a half is another one, too
}

} // namespace limn
