// SPDX-License-Identifier: MIT
#include "engine/techniques/sparse_probes/compressed_transport.h"

#include "engine/core/parallel.h"
#include "engine/math/packing.h"
#include "engine/techniques/sparse_probes/sparse_gather.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include <glm/geometric.hpp>

namespace limn::compressed_transport_test {
namespace {

constexpr std::uint32_t kBands = 3, kCoefficients = kBands * kBands, kProbes = 20;

/// Receivers in a unit square, whose matrices are those of some patterns, mixed at random with
/// weights from `least` to 1.
struct RandomTransport {
    SparseBake bake;
    ReceiverPoints points;
    ProbeRadiance probes;

    RandomTransport(std::size_t receivers, std::size_t patterns, float least = 0) {
        std::mt19937 random(1);
        std::uniform_real_distribution<float> unit(0, 1), weight(least, 1);
        bake.sparse.bands = kBands;
        bake.receivers.texel.resize(receivers);
        bake.probes.resize(kProbes);
        std::vector<float> basis(patterns * kProbesPerReceiver * kCoefficients);
        for (float& b : basis)
            b = unit(random) - 0.3f;
        for (std::size_t r = 0; r < receivers; ++r) {
            points.position.emplace_back(unit(random), 0, unit(random));
            points.normal.emplace_back(0, 1, 0);
            std::vector<float> mix(patterns);
            for (float& m : mix)
                m = weight(random);
            for (std::size_t i = 0; i < kProbesPerReceiver * kCoefficients; ++i) {
                float sum = 0;
                for (std::size_t p = 0; p < patterns; ++p)
                    sum += mix[p] * basis[p * kProbesPerReceiver * kCoefficients + i] /
                           float(patterns * (p + 1));
                bake.transport.coefficients.push_back(floatToHalf(sum));
            }
            for (std::uint32_t k = 0; k < kProbesPerReceiver; ++k)
                bake.transport.probe.push_back(std::uint16_t(2 * k + 1));
        }
        for (std::size_t i = 0; i < std::size_t(kProbes) * 3 * kCoefficients; ++i)
            probes.push_back(unit(random));
    }
    CompressedTransport compressed(float error) const {
        return compressTransport(bake.transport, kCoefficients, points, error);
    }
    std::vector<glm::vec3> irradiance(NotNegative clamped) const {
        std::vector<glm::vec3> all;
        gatherReceivers(bake, probes, clamped, all);
        return all;
    }
    std::vector<glm::vec3> irradiance(const CompressedTransport& t, NotNegative clamped) const {
        std::vector<glm::vec3> all(bake.receivers.size());
        gatherCompressed(t, kCoefficients, probes, clamped, all);
        return all;
    }
    /// Frobenius norm of the transport less what is compressed, relative to that of the transport.
    double loss(const CompressedTransport& t) const {
        double lost = 0, whole = 0;
        std::vector<glm::vec3> row(std::size_t(kProbes) * kCoefficients),
            one(bake.receivers.size());
        for (std::size_t r = 0; r < one.size(); ++r) {
            std::ranges::fill(row, glm::vec3(0));
            one[r] = glm::vec3(1);
            addTransposed(t, kCoefficients, one, row);
            one[r] = glm::vec3(0);
            for (std::uint32_t k = 0; k < kProbesPerReceiver; ++k)
                for (std::size_t i = 0; i < kCoefficients; ++i) {
                    const std::size_t from = r * kProbesPerReceiver + k;
                    const double exact =
                        double(halfToFloat(bake.transport.coefficients[from * kCoefficients + i]));
                    const double d =
                        double(row[bake.transport.probe[from] * kCoefficients + i].x) - exact;
                    lost += d * d;
                    whole += exact * exact;
                }
        }
        return std::sqrt(lost / whole);
    }
};

TEST(CompressedTransport, OfFewPatternsHasTheirNumberAsRankAndLosesNothing) {
    const RandomTransport t(700, 3);
    const CompressedTransport c = t.compressed(0.002f);
    ASSERT_EQ(c.clusters(), 4U); // of 175
    for (const std::uint16_t rank : c.rank)
        EXPECT_EQ(rank, 3);
    EXPECT_LT(t.loss(c), 0.002);
    EXPECT_LT(c.bytes(), 2 * t.bake.transport.coefficients.size() / 10);
    for (const NotNegative clamped : {NotNegative::Sum, NotNegative::Parts, NotNegative::Nothing}) {
        const auto exact = t.irradiance(clamped), packed = t.irradiance(c, clamped);
        for (std::size_t r = 0; r < exact.size(); ++r)
            EXPECT_LT(glm::distance(exact[r], packed[r]), 0.004f * glm::length(exact[r])) << r;
    }
}

TEST(CompressedTransport, LosesNoMoreThanAllowedAndNeedsLessForMore) {
    const RandomTransport t(500, 60, -1); // no pattern that all share
    std::uint64_t before = ~0ULL;
    for (const float error : {0.01f, 0.05f, 0.2f, 0.5f}) {
        const CompressedTransport c = t.compressed(error);
        EXPECT_LE(t.loss(c), double(error) + 0.001) << error;
        EXPECT_LT(c.bytes(), before) << error;
        before = c.bytes();
    }
    // A rank less would lose more: the bound is used, not only kept.
    EXPECT_GT(t.loss(t.compressed(0.2f)), 0.1);
    EXPECT_EQ(t.compressed(1).left.size(), 0U);
}

TEST(CompressedTransport, ClustersHoldEveryReceiverOnceAndLieTogether) {
    RandomTransport t(1000, 2);
    for (std::size_t r = 0; r < 1000; r += 2)
        t.points.normal[r] = {0, -1, 0}; // the other side of the square
    const CompressedTransport c = t.compressed(0.1f);
    std::vector<std::uint32_t> sorted = c.receiver;
    std::ranges::sort(sorted);
    for (std::uint32_t r = 0; r < sorted.size(); ++r)
        ASSERT_EQ(sorted[r], r);
    for (std::size_t k = 0; k < c.clusters(); ++k) {
        const std::uint32_t begin = c.receiverBegin[k], end = c.receiverBegin[k + 1];
        EXPECT_LE(end - begin, kMaxClusterReceivers);
        glm::vec3 lower(2), upper(-2);
        for (std::uint32_t i = begin; i < end; ++i) {
            lower = glm::min(lower, t.points.position[c.receiver[i]]);
            upper = glm::max(upper, t.points.position[c.receiver[i]]);
        }
        EXPECT_LT(std::min(upper.x - lower.x, upper.z - lower.z), 0.7f) << "a part of the square";
    }
}

TEST(CompressedTransport, ItsTransposeBelongsToIt) {
    const RandomTransport t(300, 20);
    const CompressedTransport c = t.compressed(0.05f);
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<glm::vec3> weights(300);
    for (glm::vec3& w : weights)
        w = {unit(random), unit(random), unit(random)};
    std::vector<glm::vec3> probes(std::size_t(kProbes) * kCoefficients);
    addTransposed(c, kCoefficients, weights, probes);
    glm::dvec3 byProbes(0), byReceivers(0);
    for (std::size_t p = 0; p < kProbes; ++p)
        for (std::size_t i = 0; i < kCoefficients; ++i) {
            const float* at = &t.probes[p * 3 * kCoefficients + i];
            byProbes += glm::dvec3(probes[p * kCoefficients + i] *
                                   glm::vec3(at[0], at[kCoefficients], at[2 * kCoefficients]));
        }
    const auto irradiance = t.irradiance(c, NotNegative::Sum); // of which none is negative here
    for (std::size_t r = 0; r < irradiance.size(); ++r)
        byReceivers += glm::dvec3(weights[r] * irradiance[r]);
    EXPECT_LT(glm::distance(byProbes, byReceivers), 1e-4 * glm::length(byReceivers));
}

TEST(CompressedTransport, IsTheSameWithAnyNumberOfThreadsAndOfNothingIsNothing) {
    const RandomTransport t(900, 30);
    const CompressedTransport many = t.compressed(0.1f);
    const ThreadLimit one(1);
    EXPECT_EQ(many, t.compressed(0.1f));
    EXPECT_TRUE(RandomTransport(0, 1).compressed(0.1f).empty());
    RandomTransport dark(40, 1);
    std::ranges::fill(dark.bake.transport.coefficients, std::uint16_t(0));
    const CompressedTransport c = dark.compressed(0.1f);
    EXPECT_EQ(c.rank, std::vector<std::uint16_t>{0});
    for (const glm::vec3 e : dark.irradiance(c, NotNegative::Sum))
        EXPECT_EQ(e, glm::vec3(0));
}

} // namespace
} // namespace limn::compressed_transport_test
