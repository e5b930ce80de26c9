// SPDX-License-Identifier: MIT
#include "engine/field/field_packing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace limn::field_packing_test {
namespace {

/// Layers of `texels` texels; from band `chroma` on grey.
std::vector<glm::vec4> field(std::uint32_t bands, std::uint32_t chroma, std::size_t texels,
                             float strength) {
    std::vector<glm::vec4> f;
    for (std::uint32_t i = 0; i < bands * bands; ++i)
        for (std::size_t t = 0; t < texels; ++t) {
            const float x = float(i * texels + t);
            const glm::vec3 c(std::sin(x), std::cos(3 * x), std::sin(5 * x + 1));
            f.emplace_back((i < chroma * chroma ? c : glm::vec3(c.x)) * strength, 0);
        }
    return f;
}

TEST(FieldPacking, TakesAsManyLayersAsThereAreValues) {
    EXPECT_EQ(fieldLayers(2, 2), 3U);  // 12 values
    EXPECT_EQ(fieldLayers(3, 3), 7U);  // 27
    EXPECT_EQ(fieldLayers(4, 4), 12U); // 48: 96 bytes, as in the paper
    EXPECT_EQ(fieldLayers(4, 2), 6U);  // 16 and twice 4
    EXPECT_EQ(fieldLayers(8, 1), 17U); // 64 and 2
}

TEST(FieldPacking, GivesBackWhatItWasGivenToHalfPrecision) {
    for (std::uint32_t bands = 2; bands <= 8; ++bands)
        for (std::uint32_t chroma = 1; chroma <= bands; ++chroma)
            for (const float strength : {1e-30f, 1e-6f, 1.f, 1e10f, 1e30f}) {
                const std::vector<glm::vec4> f = field(bands, chroma, 5, strength);
                const float scale = fieldScale(brightestOf(f));
                const auto packed = packField(f, bands, chroma, scale);
                EXPECT_EQ(packed.size(), 5 * fieldLayers(bands, chroma));
                const auto back = unpackField(packed, bands, chroma, scale);
                ASSERT_EQ(back.size(), f.size());
                for (std::size_t i = 0; i < f.size(); ++i)
                    for (int c = 0; c < 4; ++c)
                        ASSERT_NEAR(back[i][c], f[i][c],
                                    std::abs(f[i][c]) * 0x1p-11f + strength * 1e-11f)
                            << bands << " " << chroma << " " << strength << " " << i;
            }
}

TEST(FieldPacking, ScalesArePowersOfTwoThatKeepValuesInRange) {
    for (const float brightest : {1e-30f, 1e-3f, 1.f, 3.f, 65504.f, 1e10f, 1e37f}) {
        const float scale = fieldScale(brightest);
        int exponent = 0;
        EXPECT_EQ(std::frexp(scale, &exponent), 0.5f);
        EXPECT_GE(scale * brightest, 0x1p12f);
        EXPECT_LT(scale * brightest, 0x1p13f);
        EXPECT_TRUE(scaleServes(scale, brightest));
        EXPECT_TRUE(scaleServes(scale, brightest * 3.9f));
        EXPECT_TRUE(scaleServes(scale, brightest / 256));
        EXPECT_FALSE(scaleServes(scale, brightest / 1024));
        EXPECT_FALSE(scaleServes(scale, brightest * 8));
    }
    EXPECT_EQ(fieldScale(0), 1);
    EXPECT_FALSE(scaleServes(0, 0)) << "nothing is there yet";
    EXPECT_TRUE(scaleServes(16, 0)) << "black is black in any";
}

TEST(FieldPacking, NothingBecomesInfiniteOrNoNumber) {
    const float infinite = std::numeric_limits<float>::infinity();
    std::vector<glm::vec4> f(4, glm::vec4(1e9f, -infinite, std::nanf(""), 0));
    EXPECT_EQ(fieldScale(infinite), 1);
    EXPECT_EQ(fieldScale(std::nanf("")), 1);
    const auto back = unpackField(packField(f, 2, 2, 1), 2, 2, 1);
    for (const glm::vec4& c : back)
        EXPECT_EQ(c, glm::vec4(65504, -65504, 0, 0));
}

} // namespace
} // namespace limn::field_packing_test
