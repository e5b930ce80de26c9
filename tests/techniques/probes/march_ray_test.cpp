// SPDX-License-Identifier: MIT
#include "engine/techniques/probes/march_ray.h"

#include "engine/math/octahedral.h"
#include "engine/math/sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn::march_ray_test {
namespace {

/// Number `i` of points spread evenly over [-1, 1]^3.
glm::vec3 pointIn(std::uint32_t i) {
    const auto at = [&](std::uint32_t k) { return 2 * unitFloat(mixBits(4 * i + k)) - 1; };
    return {at(1), at(2), at(3)};
}

glm::vec3 directionOf(std::uint32_t i) {
    return glm::normalize(pointIn(i + 1000000) + glm::vec3(1e-6f));
}

/// Maps of probes in a closed box, seen at the texels' centres, that glows with `radiance`.
MarchedMaps boxMaps(glm::uvec3 grid, std::uint32_t side, const Bounds& box,
                    glm::vec3 radiance = glm::vec3(1)) {
    MarchedMaps maps = emptyMarchedMaps(grid, box, side);
    for (std::uint32_t p = 0; p < maps.probes(); ++p) {
        const glm::uvec3 at(p % grid.x, p / grid.x % grid.y, p / grid.x / grid.y);
        const glm::vec3 from = box.lower + (glm::vec3(at) + 0.5f) / glm::vec3(grid) * box.size();
        for (std::uint32_t t = 0; t < maps.texels(); ++t) {
            const glm::vec2 square =
                (glm::vec2(float(t % side), float(t / side)) + 0.5f) * (2 / float(side)) - 1.f;
            const glm::vec3 d = glm::normalize(octahedralPoint(square));
            float nearest = std::numeric_limits<float>::max();
            glm::vec3 normal(0);
            for (int a = 0; a < 3; ++a) {
                const float wall = d[a] > 0 ? box.upper[a] : box.lower[a];
                const float distance = d[a] != 0 ? (wall - from[a]) / d[a] : nearest;
                if (distance < nearest) {
                    nearest = distance;
                    normal = glm::vec3(0);
                    normal[a] = d[a] > 0 ? -1 : 1;
                }
            }
            const std::size_t texel = p * maps.texels() + t;
            maps.planes[texel] = marchedPlane(d, nearest, normal, MarchedMaps::kSurface);
            maps.radiance[0][texel] = radiance;
        }
        updateNearest(maps, p);
        updateLevels(maps, p);
    }
    return maps;
}

/// Side of a texel of the mean solid angle, of a map of 64 texels a side [rad].
const float kTexel = 2 * std::sqrt(3.14159265f) / 64;

const Bounds kRoom{glm::vec3(-2, -1.5f, -2.5f), glm::vec3(2, 1.5f, 2.5f)};

TEST(CutRay, GivesAtMostFourPiecesThatAreStraightInTheMap) {
    constexpr float kSide = 48;
    std::size_t most = 0;
    for (std::uint32_t i = 0; i < 2000; ++i) {
        const glm::vec3 o = 2.f * pointIn(i), d = directionOf(i);
        const RayPieces pieces = cutRay(o, d, 0.1f, 50);
        most = std::max(most, pieces.count);
        ASSERT_LE(pieces.count, 4U);
        EXPECT_EQ(pieces.piece[0].from, 0.1f);
        EXPECT_EQ(pieces.piece[pieces.count - 1].to, 50);
        for (std::size_t k = 0; k < pieces.count; ++k) {
            const RayPiece& p = pieces.piece[k];
            if (k > 0) {
                EXPECT_EQ(p.from, pieces.piece[k - 1].to);
            }
            for (const float s : {0.01f, 0.25f, 0.5f, 0.9f, 0.99f}) {
                const glm::vec3 x = o + p.along(s) * d;
                const glm::vec2 off = octahedralSquare(x) - glm::mix(p.start, p.end, s);
                EXPECT_LT(glm::length(off) * kSide / 2, 0.5f) << i << ", " << k << ", " << s;
                const float inverse = glm::mix(p.startInverse, p.endInverse, s);
                EXPECT_NEAR(inverse * norm1(x), 1, 2e-3);
            }
        }
    }
    EXPECT_EQ(most, 4U);
}

TEST(MarchRay, MeetsTheWallsOfARoom) {
    const MarchedMaps maps = boxMaps(glm::uvec3(1), 64, kRoom);
    int within = 0, rays = 0;
    for (std::uint32_t i = 0; i < 4000; ++i) {
        const glm::vec3 o = 0.999f * pointIn(i) * kRoom.upper, d = directionOf(i);
        const MarchedRay ray = marchRay(maps, o, d);
        ASSERT_EQ(ray.end, MarchEnd::Hit) << i;
        const glm::vec3 walls = (glm::sign(d) * kRoom.upper - o) / d;
        const float exact = std::min({walls.x, walls.y, walls.z});
        ++rays;
        within += std::abs(ray.t - exact) < 2 * kTexel * glm::length(o + exact * d) ? 1 : 0;
    }
    EXPECT_GT(within, rays * 0.95);
    RecordProperty("within", within);
}

TEST(MarchRay, MeetsWhatIsFarFromTheGridAndMissesTheSky) {
    const Bounds far{glm::vec3(-500), glm::vec3(500)};
    MarchedMaps maps = boxMaps(glm::uvec3(1), 32, far);
    maps.gridBounds = kRoom; // a small grid, in the middle as well
    const glm::vec3 o(1, 0.5f, 1), d = glm::normalize(glm::vec3(1, 0.3f, 0.2f));
    const MarchedRay ray = marchRay(maps, o, d);
    ASSERT_EQ(ray.end, MarchEnd::Hit);
    EXPECT_NEAR(ray.t, 499 / d.x, 0.1f);
    const MarchedMaps sky = emptyMarchedMaps(glm::uvec3(2), kRoom, 32);
    for (std::uint32_t i = 0; i < 100; ++i)
        EXPECT_EQ(marchRay(sky, pointIn(i), directionOf(i)).end, MarchEnd::Miss);
}

TEST(MarchRay, NothingIsUnknownInALongRoom) {
    const Bounds hall{glm::vec3(-20, -1, -1.5f), glm::vec3(20, 1, 1.5f)};
    const MarchedMaps maps = boxMaps(glm::uvec3(1), 32, hall);
    for (std::uint32_t i = 0; i < 20000; ++i)
        EXPECT_EQ(marchRay(maps, 0.9999f * pointIn(i) * hall.upper, directionOf(i)).end,
                  MarchEnd::Hit);
}

TEST(MarchRay, TheCoarseLevelChangesNothing) {
    for (const std::uint32_t side : {25U, 48U}) {
        const MarchedMaps maps = boxMaps(glm::uvec3(2, 1, 2), side, kRoom);
        MarchedMaps fine = maps;
        std::ranges::fill(fine.nearest, std::numeric_limits<float>::max());
        for (std::uint32_t i = 0; i < 2000; ++i) {
            const glm::vec3 o = 0.999f * pointIn(i) * kRoom.upper, d = directionOf(i);
            const MarchedRay a = marchRay(maps, o, d), b = marchRay(fine, o, d);
            EXPECT_EQ(a.end, b.end) << side << ", " << i;
            EXPECT_EQ(a.t, b.t) << side << ", " << i;
        }
    }
}

TEST(MarchRay, SpecialRaysHaveNumbers) {
    const MarchedMaps maps = boxMaps(glm::uvec3(1), 48, kRoom);
    const glm::vec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (const float sign : {-1.f, 1.f})
        for (int a = 0; a < 3; ++a)
            for (const glm::vec3 o : {glm::vec3(0), -sign * axes[a], 0.5f * sign * axes[a],
                                      0.25f * axes[(a + 1) % 3], glm::vec3(0.3f, 0.2f, 0.1f)}) {
                const glm::vec3 d = sign * axes[a];
                const MarchedRay ray = marchRay(maps, o, d);
                EXPECT_EQ(ray.end, MarchEnd::Hit);
                EXPECT_NEAR(ray.t, kRoom.upper[a] - sign * o[a], 1e-4f) << a << ", " << sign;
                // The weights of up to eight texels sum to 1 but for rounding.
                EXPECT_LT(glm::distance(marchedRadiance(maps, lookUp(maps, ray, o, d, 0.1f)),
                                        glm::vec3(1)),
                          1e-6f);
            }
    // Through the probe, from all around.
    for (std::uint32_t i = 0; i < 500; ++i) {
        const glm::vec3 d = directionOf(i), o = -0.7f * d;
        const MarchedRay ray = marchRay(maps, o, d);
        ASSERT_EQ(ray.end, MarchEnd::Hit);
        const glm::vec3 walls = kRoom.upper / glm::abs(d);
        const float wall = std::min({walls.x, walls.y, walls.z});
        EXPECT_NEAR(ray.t, 0.7f + wall, 2 * kTexel * 64 / 48 * wall) << i;
    }
    const MarchedRay none = marchRay(maps, glm::vec3(0.5f), glm::vec3(0));
    EXPECT_EQ(none.end, MarchEnd::Unknown);
    EXPECT_EQ(none.t, 0);
    EXPECT_EQ(marchedRadiance(maps, lookUp(maps, none, glm::vec3(0.5f), glm::vec3(0), 0)),
              glm::vec3(0));
}

TEST(MarchRay, AProbeInASolidIsPassedOver) {
    MarchedMaps maps = boxMaps(glm::uvec3(2, 1, 1), 32, kRoom);
    const glm::vec3 o(-0.9f, 0.2f, 0.3f), d(0, 0, 1);
    EXPECT_EQ(marchRay(maps, o, d).probe, 0U);
    maps.inSolid[0] = 1;
    EXPECT_EQ(marchRay(maps, o, d).probe, 1U);
    maps.inSolid[1] = 1;
    const MarchedRay ray = marchRay(maps, o, d);
    EXPECT_EQ(ray.probe, MarchedRay::kNoProbe);
    EXPECT_EQ(marchedRadiance(maps, lookUp(maps, ray, o, d, 0)), glm::vec3(0));
}

TEST(MarchedMaps, EveryLevelKeepsTheMeanAndUniformLightItself) {
    for (const std::uint32_t side : {8U, 13U, 48U}) {
        MarchedMaps maps = emptyMarchedMaps(glm::uvec3(1), kRoom, side);
        for (std::uint32_t t = 0; t < maps.texels(); ++t)
            maps.radiance[0][t] = {1, unitFloat(mixBits(t)), float(t % side)};
        updateLevels(maps, 0);
        EXPECT_LE(maps.levelSide(maps.radiance.size() - 1), 4U);
        glm::dvec3 finest(0);
        for (std::size_t k = 0; k < maps.radiance.size(); ++k) {
            glm::dvec3 mean(0);
            for (const glm::vec3 texel : maps.radiance[k]) {
                mean += glm::dvec3(texel) / double(maps.radiance[k].size());
                EXPECT_NEAR(texel.x, 1, 1e-5);
            }
            if (k == 0)
                finest = mean;
            EXPECT_LT(glm::length(mean - finest), 1e-4 * glm::length(finest)) << side << ", " << k;
        }
        for (const float spread : {0.f, 0.2f, 0.7f, 3.f})
            EXPECT_NEAR(probeRadiance(maps, 0, directionOf(side), spread).x, 1, 1e-5);
    }
}

TEST(MarchedMaps, RadianceIsContinuousWhereTheSquareIsFolded) {
    MarchedMaps maps = emptyMarchedMaps(glm::uvec3(1), kRoom, 32);
    for (std::uint32_t t = 0; t < maps.texels(); ++t) {
        const glm::vec2 at = glm::vec2(float(t % 32), float(t / 32)) + 0.5f;
        maps.radiance[0][t] = glm::normalize(octahedralPoint(at / 16.f - 1.f));
    }
    updateLevels(maps, 0);
    for (std::uint32_t i = 0; i < 1000; ++i) {
        const glm::vec3 d = directionOf(i);
        EXPECT_LT(glm::distance(probeRadiance(maps, 0, d, 0), d), 0.06f);
    }
    const glm::vec3 below(1e-4f, -1e-4f, -1), across(-1e-4f, 1e-4f, -1);
    EXPECT_LT(glm::distance(probeRadiance(maps, 0, below, 0), probeRadiance(maps, 0, across, 0)),
              1e-3f);
}

} // namespace
} // namespace limn::march_ray_test
