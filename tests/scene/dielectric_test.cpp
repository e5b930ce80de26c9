// SPDX-License-Identifier: MIT
#include "engine/scene/surface/dielectric.h"

#include <cmath>
#include <limits>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace limn::dielectric_test {
namespace {

const glm::vec3 kUp(0, 1, 0);

glm::vec3 atCosine(float cosine) {
    return {std::sqrt(1 - cosine * cosine), cosine, 0};
}

/// Share that is reflected of uniform light from the whole hemisphere.
double diffuseReflectance(float eta) {
    constexpr int kSteps = 20000; // even in the cosine's square, which is the light's density
    double sum = 0;
    for (int i = 0; i < kSteps; ++i)
        sum += double(fresnelDielectric(std::sqrt((float(i) + 0.5f) / kSteps), eta));
    return sum / kSteps;
}

TEST(Dielectric, ReflectsWhatFresnelsEquationsSay) {
    EXPECT_NEAR(fresnelDielectric(1, 1.5f), 0.04f, 1e-6f);
    EXPECT_NEAR(fresnelDielectric(1, 1 / 1.5f), 0.04f, 1e-6f);
    EXPECT_NEAR(fresnelDielectric(0, 1.5f), 1, 1e-6f);
    EXPECT_NEAR(fresnelDielectric(0.6f, 1), 0, 1e-12f);
    EXPECT_EQ(dielectricF0(1.5f), 0.04f);
    EXPECT_EQ(dielectricF0(1), 0);
    // At Brewster's angle, tan = eta, only the perpendicular half is reflected:
    // ((eta^2 - 1) / (eta^2 + 1))^2 / 2.
    for (const float eta : {1.33f, 1.5f, 2.4f}) {
        const float e2 = eta * eta, half = (e2 - 1) / (e2 + 1);
        EXPECT_NEAR(fresnelDielectric(1 / std::sqrt(1 + e2), eta), half * half / 2, 1e-6f) << eta;
    }
}

// Walsh. 1926: 0.0918 for glass of index 1.5. What enters a body under uniform light fills the cone
// of 1 / eta^2 of the hemisphere inside, so the same light from within passes by (1 - R) / eta^2.
TEST(Dielectric, ReflectsDiffuseLightByWalshsFormula) {
    const double outside = diffuseReflectance(1.5f);
    EXPECT_NEAR(outside, 0.0918, 5e-5);
    EXPECT_NEAR(diffuseReflectance(1 / 1.5f), 1 - (1 - outside) / 2.25, 1e-4);
}

TEST(Dielectric, RefractsBySnellsLawAndBack) {
    for (const float cosine : {0.05f, 0.4f, 0.9f, 1.f})
        for (const float eta : {1.f, 1.5f, 2.f}) {
            const glm::vec3 toLight = atCosine(cosine);
            const glm::vec3 inside = refractedDirection(kUp, toLight, eta);
            EXPECT_NEAR(glm::length(inside), 1, 1e-6f);
            EXPECT_LT(inside.y, 0);
            EXPECT_NEAR(-inside.x * eta, toLight.x, 1e-6f);
            EXPECT_NEAR(inside.z, 0, 1e-7f);
            const glm::vec3 back = refractedDirection(-kUp, inside, 1 / eta);
            EXPECT_LT(glm::length(back - toLight), 1e-4f) << cosine << ' ' << eta;
            EXPECT_NEAR(fresnelDielectric(-inside.y, 1 / eta), fresnelDielectric(cosine, eta),
                        1e-5f);
        }
}

TEST(Dielectric, ReflectsAllBeyondTheCriticalAngle) {
    const float critical = std::sqrt(1 - 1 / 2.25f); // its cosine
    for (const float cosine : {0.f, 0.5f, critical - 1e-3f}) {
        EXPECT_EQ(fresnelDielectric(cosine, 1 / 1.5f), 1);
        EXPECT_EQ(refractedDirection(kUp, atCosine(cosine), 1 / 1.5f), glm::vec3(0));
    }
    EXPECT_LT(fresnelDielectric(critical + 1e-3f, 1 / 1.5f), 1);
    EXPECT_NE(refractedDirection(kUp, atCosine(critical + 1e-3f), 1 / 1.5f), glm::vec3(0));
}

TEST(Dielectric, HugeIndicesAndCosinesOutOfRangeAreDefined) {
    const float huge = std::numeric_limits<float>::max();
    for (const float eta : {huge, 1 / huge, 1.f})
        for (const float cosine : {-1.f, 0.f, 0.3f, 1.f, 1.0001f}) {
            const float F = fresnelDielectric(cosine, eta);
            EXPECT_TRUE(F >= 0 && F <= 1) << cosine << ' ' << eta;
        }
    EXPECT_EQ(dielectricF0(huge), 1);
    EXPECT_NEAR(refractedDirection(kUp, atCosine(0.5f), huge).y, -1, 1e-6f);
}

} // namespace
} // namespace limn::dielectric_test
