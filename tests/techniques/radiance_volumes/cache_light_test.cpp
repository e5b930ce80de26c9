// SPDX-License-Identifier: MIT
#include "engine/techniques/radiance_volumes/cache_light.h"

#include "engine/math/sampling.h"
#include "engine/math/sh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace limn::cache_light_test {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;

/// One area light, with its flux in red, green and blue.
void add(AreaLights& lights, glm::vec3 p, glm::vec3 n, float area, glm::vec3 flux) {
    lights.x.push_back(p.x), lights.y.push_back(p.y), lights.z.push_back(p.z);
    lights.nx.push_back(n.x), lights.ny.push_back(n.y), lights.nz.push_back(n.z);
    lights.disc.push_back(area / kPi);
    lights.flux.push_back(flux);
}

/// All area lights in one block.
AreaLights whole(AreaLights lights) {
    lights.blocks = {{.begin = 0, .end = std::uint32_t(lights.count())}};
    return lights;
}

/// Irradiance of a surface at `p` with normal `n`, by a cache there.
glm::vec3 irradiance(const AreaLights& lights, std::uint32_t bands, glm::vec3 p, glm::vec3 n) {
    const LitAreaLights lit{&lights, glm::vec3(1)};
    const CachePlace place{.position = p};
    const CacheLight light =
        lightCaches(std::span(&place, 1), {.lights = std::span(&lit, 1), .bands = bands});
    return shIrradiance(int(bands), light.harmonics.data(), n);
}

// What is left of the perpendicular irradiance of a far small square: 1/4 + 1/2 cos with two
// bands, 0.3125 P_2(cos) more with three.
TEST(CacheLight, OfAFarSmallSquareIsThatOfItsBands) {
    AreaLights lights;
    add(lights, {0, 0, -100}, {0, 0, 1}, 0.01f, {3, 2, 1});
    lights = whole(lights);
    const float perpendicular = 3 / kPi / (100 * 100);
    const auto share = [&](std::uint32_t bands, glm::vec3 n) {
        return irradiance(lights, bands, glm::vec3(0), n).x / perpendicular;
    };
    EXPECT_NEAR(share(2, {0, 0, -1}), 0.75f, 1e-4f);
    EXPECT_NEAR(share(3, {0, 0, -1}), 1.0625f, 1e-4f);
    EXPECT_NEAR(share(2, {1, 0, 0}), 0.25f, 1e-4f);
    EXPECT_NEAR(share(3, {0, 1, 0}), 0.09375f, 1e-4f);
    EXPECT_NEAR(share(3, {1, 0, 0}), 0.09375f, 1e-4f);
    // Directions in general position find all nine harmonics.
    const glm::vec3 d = glm::normalize(glm::vec3(0.3f, -0.5f, 0.8f));
    AreaLights slanted;
    add(slanted, 100.f * d, -d, 0.01f, {3, 2, 1});
    slanted = whole(slanted);
    const DirectionSet normals(50, true, 0);
    for (std::uint32_t k = 0; k < normals.count; ++k) {
        const float c = glm::dot(normals[k], d);
        EXPECT_NEAR(irradiance(slanted, 3, glm::vec3(0), normals[k]).y / perpendicular * 1.5f,
                    0.25f + 0.5f * c + 0.3125f * (1.5f * c * c - 0.5f), 1e-4f);
    }
}

// Above a square of half-side 1 and radiosity 1 in many pieces, the share of the truth
// (4 / pi) k atan k, k = X / sqrt(1 + X^2), X = 1 / h, that the bands of a cache hold.
TEST(CacheLight, AboveASquareHoldsTheShareOfItsBands) {
    constexpr int kSide = 200;
    AreaLights lights;
    constexpr float kPiece = 4.f / (kSide * kSide);
    for (int i = 0; i < kSide * kSide; ++i)
        add(lights,
            {2 * (float(i % kSide) + 0.5f) / kSide - 1, 0,
             2 * (float(i / kSide) + 0.5f) / kSide - 1},
            {0, 1, 0}, kPiece, glm::vec3(kPiece));
    lights = whole(lights);
    const float expected[3][2] = {{0.855f, 0.983f}, {0.801f, 1.008f}, {0.768f, 1.039f}};
    for (int k = 0; k < 3; ++k) {
        const float h = 0.5f * float(1 << k), x = 1 / h, s = x / std::sqrt(1 + x * x);
        const float truth = 4 / kPi * s * std::atan(s);
        for (const std::uint32_t bands : {2U, 3U})
            EXPECT_NEAR(irradiance(lights, bands, {0, h, 0}, {0, -1, 0}).x / truth,
                        expected[k][bands - 2], 5e-4f)
                << h << ' ' << bands;
    }
}

// Phi / pi / (A / pi) at contact: the radiosity of the area light.
TEST(CacheLight, IsBoundedAtContact) {
    AreaLights lights;
    add(lights, glm::vec3(0), {0, 1, 0}, 0.5f, glm::vec3(0.5f));
    lights = whole(lights);
    for (const float h : {1e-2f, 1e-4f, 1e-20f, 0.f}) {
        const LitAreaLights lit{&lights, glm::vec3(1)};
        const CachePlace place{.position = {0, h, 0}};
        float sum = -1;
        visitArrivals({.lights = std::span(&lit, 1)}, place,
                      [&](const Arrival& a) { sum = a.factor; });
        EXPECT_NEAR(sum * 0.5f, h > 0 ? 1 / (1 + kPi * h * h / 0.5f) : -0.5f, 1e-5f)
            << "from the surface itself, nothing arrives";
        const CacheLight light = lightCaches(std::span(&place, 1), {.lights = std::span(&lit, 1)});
        for (const glm::vec3 c : light.harmonics)
            EXPECT_TRUE(std::isfinite(c.x) && std::abs(c.x) < 2);
    }
}

TEST(CacheLight, IsTheSumOfItsArrivals) {
    AreaLights lights;
    const DirectionSet d(60, true, 3);
    for (std::uint32_t k = 0; k < d.count; ++k)
        add(lights, d[k] * (1 + 0.1f * float(k % 5)), -d[k], 0.1f, {1 + float(k % 3), 2, 3});
    lights.blocks = {{.begin = 0, .end = 25}, {.begin = 25, .end = 60}};
    const LitAreaLights lit{&lights, {0.5f, 1, 2}};
    std::vector<CachePlace> places;
    for (int k = 0; k < 11; ++k)
        places.push_back({.position = {0.05f * float(k), 0.02f * float(k), -0.3f}});
    const CacheLightInput input{.lights = std::span(&lit, 1), .bands = 3};
    const CacheLight light = lightCaches(places, input);
    for (std::size_t c = 0; c < places.size(); ++c) {
        glm::dvec3 sum[9] = {};
        visitArrivals(input, places[c], [&](const Arrival& a) {
            float y[9];
            shBasis(3, a.direction, y);
            for (int i = 0; i < 9; ++i)
                sum[i] += glm::dvec3(lights.flux[a.light] * lit.colour) * double(a.factor * y[i]);
        });
        for (std::size_t i = 0; i < 9; ++i)
            for (int k = 0; k < 3; ++k)
                EXPECT_NEAR(light.harmonics[c * 9 + i][k], sum[i][k], 2e-5 * std::abs(sum[0][k]));
    }
}

} // namespace
} // namespace limn::cache_light_test
