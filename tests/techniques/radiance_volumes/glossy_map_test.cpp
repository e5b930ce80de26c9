// SPDX-License-Identifier: MIT
#include "engine/techniques/radiance_volumes/glossy_map.h"

#include "engine/math/sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace limn::glossy_map_test {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

TEST(GlossyMaps, MapTheHemisphereToTheSquareAndBack) {
    const DirectionSet d(500, false, 2);
    for (std::uint32_t k = 0; k < d.count; ++k) {
        const glm::vec2 p = squareOfHemisphere(d[k]);
        EXPECT_TRUE(p.x >= 0 && p.y >= 0 && p.x <= 1 && p.y <= 1);
        EXPECT_LT(glm::distance(hemisphereOfSquare(p), d[k]), 2e-3f);
    }
    EXPECT_EQ(squareOfHemisphere({0, 0, 1}), glm::vec2(0.5f));
    EXPECT_NEAR(hemisphereOfSquare({0, 0.3f}).z, 0, 1e-6f) << "edges are the horizon";
}

// The solid angle of each texel, from its corners' triangles on the sphere, is 2 pi / 64.
TEST(GlossyMaps, HaveTexelsOfEqualSolidAngle) {
    constexpr int kSide = 8, kFine = 16;
    const auto triangle = [](glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
        return 2 * std::atan2(std::abs(glm::dot(a, glm::cross(b, c))),
                              1 + glm::dot(a, b) + glm::dot(b, c) + glm::dot(c, a));
    };
    for (int t = 0; t < kSide * kSide; ++t) {
        double angle = 0;
        for (int s = 0; s < kFine * kFine; ++s) {
            const auto corner = [&](int dx, int dy) {
                return glm::dvec3(hemisphereOfSquare(
                    {(float(t % kSide) + float(s % kFine + dx) / kFine) / kSide,
                     (float(t / kSide) + float(s / kFine + dy) / kFine) / kSide}));
            };
            angle += triangle(corner(0, 0), corner(1, 0), corner(1, 1)) +
                     triangle(corner(0, 0), corner(1, 1), corner(0, 1));
        }
        EXPECT_NEAR(angle, 2 * std::numbers::pi / (kSide * kSide), 1e-3 * angle + 1e-4);
    }
}

TEST(GlossyMaps, AreBrightestAtTheHalfVector) {
    const GlossyMapShape shape{.tile = 16};
    const glm::mat3 frame = glossyFrame({1, 2, -0.5f});
    for (const glm::vec3 direction :
         {glm::vec3(0.2f, 0.9f, 0.1f), glm::vec3(-1, 0.4f, 0.3f), glm::vec3(0.5f, 0.2f, -1)}) {
        const glm::vec3 w = glm::normalize(direction);
        std::vector<glm::vec3> texels(shape.texels(), glm::vec3(0));
        const GlossySplat splat = glossySplat(shape, frame, w);
        texels[splat.texel] += 2.f * splat.factor;
        const glm::vec3 h = glm::normalize(w + frame[2]);
        EXPECT_NEAR(splat.factor, glm::dot(h, w) * 263 / (8 * kPi), 1e-4f);
        completeGlossyMap(shape, texels);
        const auto brightest = std::max_element(texels.begin(), texels.end(),
                                                [](glm::vec3 a, glm::vec3 b) { return a.x < b.x; });
        const auto t = std::uint32_t(brightest - texels.begin());
        ASSERT_LT(t, 256U);
        const glm::vec2 p = squareOfHemisphere(h * frame) * 16.f;
        EXPECT_EQ(t % 16, std::uint32_t(p.x));
        EXPECT_EQ(t / 16, std::uint32_t(p.y));
        // A smooth surface with that normal sees it, one of another does not.
        const auto seen = [&](glm::vec3 normal, float roughness) {
            const GlossyLookup found = lookUpGlossy(shape, frame, normal, roughness);
            float sum = 0, weights = 0;
            for (std::size_t k = 0; k < found.count; ++k) {
                sum += found.weight[k] * texels[found.texel[k]].x;
                weights += found.weight[k];
            }
            EXPECT_NEAR(weights, 1, 1e-5f);
            return sum;
        };
        EXPECT_GT(seen(h, 0.1f), 0.25f * brightest->x);
        EXPECT_GT(seen(h, 0.1f), seen(h, 0.6f));
        EXPECT_GT(seen(h, 0.6f), seen(h, 1));
        // Of a roughness of 1 the exponent is 2, and the level 1/2 log2(256 / 3) = 3.2.
        for (const std::uint32_t texel : lookUpGlossy(shape, frame, h, 1).texel)
            EXPECT_GE(texel, shape.firstTexel(3));
        EXPECT_EQ(lookUpGlossy(shape, frame, h, 0.1f).count, 4U) << "the finest level alone";
    }
    EXPECT_EQ(lookUpGlossy(shape, frame, -frame[2], 0.5f).count, 0U);
}

/// A map of radiance 1 from everywhere.
std::vector<glm::vec3> evenLight(const GlossyMapShape& shape, const glm::mat3& frame) {
    std::vector<glm::vec3> texels(shape.texels(), glm::vec3(0));
    const DirectionSet d(500000, true, 0);
    for (std::uint32_t k = 0; k < d.count; ++k) {
        const GlossySplat splat = glossySplat(shape, frame, d[k]);
        texels[splat.texel] += 4 * kPi / float(d.count) * splat.factor;
    }
    completeGlossyMap(shape, texels);
    return texels;
}

// Light from a cone of half vectors dh at the angle t covers 4 cos t dh. As published, each part of
// it counts cos t (m + 8) / 8 pi: a texel of 2 pi / (m + 1) reflects cos^2 t (m + 8) / (m + 1) of
// even light. Of the microfacet model it is (m + 2) / (m + 1) at all angles.
TEST(GlossyMaps, ReflectTheSquaredCosineOfEvenLightOrAllOfIt) {
    const glm::mat3 frame = glossyFrame({1, 2, -0.5f});
    const GlossyMapShape published{.tile = 16}, microfacet{.tile = 16, .microfacet = true};
    const std::vector<glm::vec3> dim = evenLight(published, frame),
                                 full = evenLight(microfacet, frame);
    for (const float angle : {0.f, 30.f, 45.f, 60.f}) {
        const float t = angle * kPi / 180, c = std::cos(t);
        const GlossyLookup found =
            lookUpGlossy(published, frame, frame * glm::vec3(std::sin(t), 0, c), 0.1f);
        float reflected = 0, all = 0, squared = 0; // the mean cos^2 over the texels that are read
        for (std::size_t k = 0; k < found.count; ++k) {
            reflected += found.weight[k] * dim[found.texel[k]].x;
            all += found.weight[k] * full[found.texel[k]].x;
            for (std::uint32_t s = 0; s < 64; ++s) {
                const glm::vec2 p(float(found.texel[k] % 16) + (float(s % 8) + 0.5f) / 8,
                                  float(found.texel[k] / 16) + (float(s / 8) + 0.5f) / 8);
                const float z = hemisphereOfSquare(p / 16.f).z;
                squared += found.weight[k] * z * z / 64;
            }
        }
        EXPECT_NEAR(squared, c * c, 0.02f);
        EXPECT_NEAR(reflected, squared * 263 / 256, 0.005f) << angle;
        EXPECT_NEAR(all, 257 / 256.f, 0.01f) << angle;
    }
}

TEST(GlossyMaps, KeepTheirLightWhereHolesAreFilled) {
    for (const std::uint32_t fill : {0U, 1U, 3U, 5U}) {
        const GlossyMapShape shape{.tile = 16, .fill = fill};
        std::vector<glm::vec3> texels(shape.texels(), glm::vec3(0));
        glm::vec3 sum(0);
        for (std::uint32_t k = 0; k < 40; ++k) {
            const glm::vec3 light(float(k % 7), 1, 2);
            texels[mixBits(k) % 120] += light;
            sum += light;
        }
        const std::vector<glm::vec3> finest(texels.begin(), texels.begin() + 256);
        completeGlossyMap(shape, texels);
        glm::vec3 after(0);
        bool dark = false;
        for (std::size_t t = 0; t < 256; ++t) {
            after += texels[t];
            dark |= texels[t] == glm::vec3(0);
        }
        EXPECT_NEAR(after.x, sum.x, 1e-4f * sum.x);
        EXPECT_NEAR(texels.back().x, sum.x / 256, 1e-5f * sum.x);
        EXPECT_EQ(dark, fill < 4) << "half of all texels are";
        // The adjoint weighs the finest texels as the completed map is weighed.
        std::vector<glm::vec3> weight(shape.texels());
        for (std::uint32_t t = 0; t < weight.size(); ++t)
            weight[t] = {unitFloat(mixBits(t)), float(t % 3), 1};
        const std::vector<glm::vec3> adjoint = glossyAdjoint(shape, finest, weight);
        glm::dvec3 complete(0), back(0);
        for (std::size_t t = 0; t < weight.size(); ++t)
            complete += glm::dvec3(weight[t] * texels[t]);
        for (std::size_t t = 0; t < 256; ++t)
            back += glm::dvec3(adjoint[t] * finest[t]);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(back[c], complete[c], 1e-5 * complete[c]);
    }
}

TEST(GlossyMaps, HaveAFrameForEveryDirection) {
    for (const glm::vec3 toEye :
         {glm::vec3(0, 1, 0), glm::vec3(0, -3, 0), glm::vec3(0), glm::vec3(1, 1, 1)}) {
        const glm::mat3 frame = glossyFrame(toEye);
        for (int a = 0; a < 3; ++a)
            for (int b = 0; b < 3; ++b)
                EXPECT_NEAR(glm::dot(frame[a], frame[b]), a == b ? 1 : 0, 1e-6f);
        EXPECT_NEAR(glm::dot(frame[2], toEye), glm::length(toEye), 1e-5f);
    }
}

} // namespace
} // namespace limn::glossy_map_test
