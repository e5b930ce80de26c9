// SPDX-License-Identifier: MIT
#include "engine/lighting/direct_irradiance.h"
#include "engine/techniques/illuminance/bake/baker.h"
#include "engine/techniques/illuminance/format/bake.h"
#include "tests/techniques/illuminance/bake/parted_hall.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include <glm/geometric.hpp>

namespace limn::light_points_test {
namespace {

using namespace simple;

/// Throws where the bake fails, which ends the test.
Surfels bakedSurfels(const Scene& scene) {
    Result<Bake> made = bake(TraceScene(scene));
    if (!made)
        throw std::runtime_error(made.error().message);
    return std::move(made->surfels);
}

std::vector<glm::vec3> lightAt(const Scene& scene, const std::vector<glm::vec3>& at,
                               const std::vector<glm::vec3>& normals, std::uint32_t each) {
    DirectIrradiance direct;
    updateDirectIrradiance(at, normals, scene, TraceScene(scene), direct, each);
    return direct.irradiance;
}

std::vector<glm::vec3> directLight(const Scene& scene, const Surfels& s) {
    return lightAt(scene, s.litAt(), s.litNormals(), s.litAtEach());
}

/// A floor of 4 x 4 m under slats that shade every other strip of half a `period` [m] of it from
/// the sun in the zenith, between walls, which see it.
Scene slats(float period) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(quad({0, 0, 0}, {0, 0, 4}, {4, 0, 0}));
    for (float x = 0.1f; x < 4; x += period)
        b.add(quad({x, 1, 0}, {0, 0, 4}, {std::min(period / 2, 4 - x), 0, 0}));
    b.add(quad({0, 0, 0}, {0, 3, 0}, {0, 0, 4}));
    b.add(quad({4, 0, 0}, {0, 0, 4}, {0, 3, 0}));
    b.add(quad({0, 0, 0}, {4, 0, 0}, {0, 3, 0}));
    b.add(quad({0, 0, 4}, {0, 3, 0}, {4, 0, 0}));
    b.scene.lights.resize(1);
    b.scene.lights[0].kind = LightKind::Directional;
    b.scene.lights[0].direction = {0, -1, 0};
    Scene scene = b.build();
    scene.bake.surfels = 1600;
    scene.bake.lightmapCaches = 400;
    scene.bake.rays = 64;
    return scene;
}

/// Area of the floor that the sun lights [m^2].
double litArea(float period) {
    double lit = 16;
    for (float x = 0.1f; x < 4; x += period)
        lit -= 4 * double(std::min(period / 2, 4 - x));
    return lit;
}

// A grid of middles meets strips of nearly its own width in step. Relative rms over the periods:
// 0.021, with the middle alone 0.049.
TEST(LightPoints, StripsOfSunLightAFloorByTheirShare) {
    double errors = 0, atMiddle = 0;
    for (float period = 0.2f; period < 0.8f; period += 0.05f) {
        const Scene scene = slats(period);
        const Surfels surfels = bakedSurfels(scene);
        ASSERT_EQ(surfels.lightPoints.size(), surfels.size() * kLightPoints);
        const auto error = [&](const std::vector<glm::vec3>& direct) {
            double flux = 0, area = 0;
            for (std::size_t s = 0; s < surfels.size(); ++s)
                if (surfels.instance[s] == 0) {
                    flux += double(surfels.area[s]) * double(direct[s].x);
                    area += double(surfels.area[s]);
                }
            const double unit = double(scene.lights[0].color.x * scene.lights[0].strength);
            return flux / unit / area * 16 / litArea(period) - 1;
        };
        errors += std::pow(error(directLight(scene, surfels)), 2);
        atMiddle += std::pow(error(lightAt(scene, surfels.position, surfels.normal, 1)), 2);
    }
    std::printf("rms %.4f, at the middle alone %.4f\n", std::sqrt(errors / 12),
                std::sqrt(atMiddle / 12));
    EXPECT_LT(errors, 0.25 * atMiddle);
}

TEST(LightPoints, LieOnTheSurfaceAroundTheSurfel) {
    const Scene scene = partedHall(0.1f, 400);
    const Surfels s = bakedSurfels(scene);
    ASSERT_EQ(s.lightNormals.size(), s.lightPoints.size());
    std::size_t away = 0;
    for (std::size_t k = 0; k < s.lightPoints.size(); ++k) {
        const glm::vec3 d = s.lightPoints[k] - s.position[k / kLightPoints];
        EXPECT_LE(glm::length(d), 2.5f * std::sqrt(s.area[k / kLightPoints]));
        EXPECT_NEAR(glm::dot(d, s.normal[k / kLightPoints]), 0, 1e-4f);
        EXPECT_NEAR(glm::dot(s.lightNormals[k], s.normal[k / kLightPoints]), 1, 1e-5f);
        away += glm::length(d) > 0;
    }
    EXPECT_GT(away, s.lightPoints.size() * 3 / 4);
}

// In a closed room every part of a surface is seen as much as any other. Half of the floor lies
// under a plate that floats closely above it, and coarse patches reach under its edge.
TEST(LightPoints, LieUnderAPlateAsOftenAsItCoversTheFloor) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(box(glm::vec3(0), glm::vec3(4, 2, 4), true));
    b.add(box({0.013f, 0.02f, 0.013f}, {2, 0.03f, 3.987f}, false));
    Scene scene = b.build();
    scene.bake.lightmapCaches = 4000;
    scene.bake.rays = 256;
    double covered = 0, all = 0;
    // About 25 of a floor's 160 points may lie on either side of the edge, so that a bake scatters
    // by 0.015.
    for (std::uint32_t surfels = 160; surfels <= 240; surfels += 10) {
        scene.bake.surfels = surfels;
        const Surfels s = bakedSurfels(scene);
        for (std::size_t k = 0; k < s.lightPoints.size(); ++k) {
            const std::size_t surfel = k / kLightPoints;
            if (s.lightPoints[k].y > 1e-3f || s.lightNormals[k].y < 0.9f)
                continue;
            all += double(s.area[surfel]);
            covered += s.lightPoints[k].x < 2 ? double(s.area[surfel]) : 0;
        }
    }
    std::printf("covered %.4f of 0.5\n", covered / all);
    EXPECT_NEAR(covered / all, 0.5, 0.015); // three times the scatter of nine bakes
}

// Few patches cover the ball, and each spans a wide angle.
TEST(LightPoints, HaveTheNormalsOfTheirOwnPlaces) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(sphere(1, 4, false));
    b.add(sphere(8, 2, true));
    Scene scene = b.build();
    scene.bake.surfels = 300;
    scene.bake.lightmapCaches = 2000;
    scene.bake.rays = 256;
    const Surfels s = bakedSurfels(scene);
    std::size_t onBall = 0;
    for (std::size_t k = 0; k < s.lightPoints.size(); ++k)
        if (s.instance[k / kLightPoints] == 0) {
            ++onBall;
            EXPECT_GT(glm::dot(s.lightNormals[k], glm::normalize(s.lightPoints[k])), 0.999f);
        }
    EXPECT_GT(onBall, 4U);
}

// The floor, ceiling and long walls are one surface on both sides of the wall; the lamp hangs right
// of it.
TEST(LightPoints, LieOnOneSideOfAWall) {
    for (const float wall : {0.f, 0.01f}) {
        const Scene scene = partedHall(wall, 400);
        const Surfels s = bakedSurfels(scene);
        const std::vector<glm::vec3> direct = directLight(scene, s);
        for (std::size_t i = 0; i < s.size(); ++i)
            if (s.position[i].x < 3.69f) {
                EXPECT_EQ(direct[i], glm::vec3(0)) << s.position[i].x;
            }
    }
}

} // namespace
} // namespace limn::light_points_test
