// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/cut/lighting_rows.h"

#include "tests/core/vector_units.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace limn::lighting_rows_test {
namespace {

/// Random radiosities of a few nodes.
struct Rows {
    std::mt19937 engine{11};
    TrainingLight training;

    explicit Rows(std::uint32_t nodes) {
        for (std::uint32_t i = 0; i < nodes * TrainingLight::kCount; ++i)
            training.radiosity.push_back(number());
    }
    float number() { return std::uniform_real_distribution<float>(0, 2)(engine); }
    LightingRow row() {
        LightingRow r;
        for (float& x : r)
            x = number();
        return r;
    }
};

/// Calls `body` once for each vector unit that this machine has.
template <class Body>
void forEachVectorUnit(const Body& body) {
    ASSERT_NE(vectorUnitsHere(), 0);
    for (std::int64_t rest = vectorUnitsHere(); rest != 0; rest &= rest - 1) {
        const OnlyVectorUnit only(rest & -rest);
        body();
    }
}

TEST(LightingRows, WhatIsReceivedIsTheSumOfWhatIsSeen) {
    Rows rows(50);
    std::vector<std::uint32_t> node;
    std::vector<FormFactor> formFactor;
    std::array<double, TrainingLight::kCount> expected{};
    for (std::uint32_t i = 0; i < 23; ++i) {
        node.push_back(i * 7 % 50);
        formFactor.push_back({1, rows.number(), {}});
        for (std::size_t t = 0; t < expected.size(); ++t)
            expected[t] +=
                double(formFactor.back().irradiance) * double(rows.training.row(node[i])[t]);
    }
    const LightingRow first = receivedFrom(rows.training, node, formFactor);
    for (std::size_t t = 0; t < expected.size(); ++t)
        EXPECT_NEAR(first[t], expected[t], 1e-5 * expected[t]);
    forEachVectorUnit([&] { EXPECT_EQ(receivedFrom(rows.training, node, formFactor), first); });
    EXPECT_EQ(receivedFrom(rows.training, {}, {}), LightingRow{});
}

TEST(LightingRows, ErrorsAreWeightedMeanSquares) {
    Rows rows(0);
    const LightingRow l = rows.row(), r = rows.row(), weight = rows.row();
    const std::array<LightingRow, kLinkCandidates> read = {rows.row(), l, r};
    const Received left{0.3f, l.data()}, right{0.2f, r.data()};
    const auto errorsOf = [&](LightingRow& contribution) {
        return linkErrors(left, right, 0.5f, {read[0].data(), read[1].data(), read[2].data()},
                          weight.data(), contribution.data());
    };
    LightingRow contribution;
    const auto errors = errorsOf(contribution);
    for (std::size_t c = 0; c < kLinkCandidates; ++c) {
        double sum = 0;
        for (std::size_t t = 0; t < contribution.size(); ++t) {
            const double b = 0.3 * double(l[t]) + 0.2 * double(r[t]),
                         off = b - 0.5 * double(read[c][t]);
            EXPECT_NEAR(contribution[t], b, 1e-6);
            sum += off * off * double(weight[t]);
        }
        EXPECT_NEAR(errors[c], sum / TrainingLight::kCount, 1e-5 * errors[c]);
    }
    forEachVectorUnit([&] {
        LightingRow again;
        EXPECT_EQ(errorsOf(again), errors);
        EXPECT_EQ(again, contribution);
    });
}

TEST(LightingRows, ALinkThatReadsWhatBothSendHasNoError) {
    Rows rows(0);
    const LightingRow same = rows.row(), weight = rows.row();
    const Received half{0.25f, same.data()};
    LightingRow contribution;
    const auto errors = linkErrors(half, half, 0.5f, {same.data(), same.data(), same.data()},
                                   weight.data(), contribution.data());
    for (const float e : errors)
        EXPECT_EQ(e, 0);
}

} // namespace
} // namespace limn::lighting_rows_test
