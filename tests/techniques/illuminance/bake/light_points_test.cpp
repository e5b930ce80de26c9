// SPDX-License-Identifier: MIT
#include "engine/lighting/direct_irradiance.h"
#include "engine/techniques/illuminance/bake/bake.h"
#include "tests/techniques/illuminance/bake/parted_hall.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include <glm/geometric.hpp>

namespace limn::light_points_test {
namespace {

using namespace simple;

std::vector<glm::vec3> directLight(const Scene& scene, const std::vector<glm::vec3>& at,
                                   const Surfels& surfels) {
    DirectIrradiance direct;
    updateDirectIrradiance(at, surfels.normal, scene, TraceScene(scene), direct);
    return direct.irradiance;
}

/// A floor of 4 x 4 m under slats that shade every other strip of half a `period` [m] of it from
/// the sun in the zenith.
Scene slats(float period) {
    SceneBuilder b;
    b.addMaterial(lambert(glm::vec3(0.5f)));
    b.add(quad({0, 0, 0}, {0, 0, 4}, {4, 0, 0}));
    for (float x = 0.1f; x < 4; x += period)
        b.add(quad({x, 1, 0}, {0, 0, 4}, {std::min(period / 2, 4 - x), 0, 0}));
    b.scene.lights.resize(1);
    b.scene.lights[0].kind = LightKind::Directional;
    b.scene.lights[0].direction = {0, -1, 0};
    Scene scene = b.build();
    scene.bake.surfels = 400;
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
// 0.012, with the middle alone 0.067.
TEST(LightPoints, StripsOfSunLightAFloorByTheirShare) {
    double errors = 0, atMiddle = 0;
    for (float period = 0.2f; period < 0.8f; period += 0.05f) {
        const Scene scene = slats(period);
        const TraceScene trace(scene);
        const Result<Bake> made = bake(trace);
        ASSERT_TRUE(made) << made.error().message;
        const Surfels& surfels = made->surfels;
        ASSERT_EQ(surfels.lightPoints.size(), surfels.size() * kLightPoints);
        const auto error = [&](const std::vector<glm::vec3>& at) {
            const std::vector<glm::vec3> direct = directLight(scene, at, surfels);
            double flux = 0, area = 0;
            for (std::size_t s = 0; s < surfels.size(); ++s)
                if (surfels.instance[s] == 0) {
                    flux += double(surfels.area[s]) * double(direct[s].x);
                    area += double(surfels.area[s]);
                }
            const double unit = double(scene.lights[0].color.x * scene.lights[0].strength);
            return flux / unit / area * 16 / litArea(period) - 1;
        };
        errors += std::pow(error(surfels.litAt()), 2);
        atMiddle += std::pow(error(surfels.position), 2);
    }
    std::printf("rms %.4f, at the middle alone %.4f\n", std::sqrt(errors / 12),
                std::sqrt(atMiddle / 12));
    EXPECT_LT(errors, 0.1 * atMiddle);
}

TEST(LightPoints, LieOnTheSurfaceAroundTheSurfel) {
    const Scene scene = partedHall(0.1f, 400);
    const TraceScene trace(scene);
    const Result<Bake> made = bake(trace);
    ASSERT_TRUE(made) << made.error().message;
    const Surfels& s = made->surfels;
    std::size_t away = 0;
    for (std::size_t k = 0; k < s.lightPoints.size(); ++k) {
        const glm::vec3 d = s.lightPoints[k] - s.position[k / kLightPoints];
        EXPECT_LE(glm::length(d),
                  1.01f * std::sqrt(s.area[k / kLightPoints] / std::numbers::pi_v<float>));
        EXPECT_NEAR(glm::dot(d, s.normal[k / kLightPoints]), 0, 1e-4f);
        away += glm::length(d) > 0;
    }
    EXPECT_GT(away, s.lightPoints.size() * 3 / 4);
}

// The floor, ceiling and long walls are one surface on both sides of the wall; the lamp hangs right
// of it.
TEST(LightPoints, LieOnOneSideOfAWall) {
    for (const float wall : {0.f, 0.01f}) {
        const Scene scene = partedHall(wall, 400);
        const TraceScene trace(scene);
        const Result<Bake> made = bake(trace);
        ASSERT_TRUE(made) << made.error().message;
        const Surfels& s = made->surfels;
        const std::vector<glm::vec3> direct = directLight(scene, s.litAt(), s);
        for (std::size_t i = 0; i < s.size(); ++i)
            if (s.position[i].x < 3.69f) {
                EXPECT_EQ(direct[i], glm::vec3(0)) << s.position[i].x;
            }
    }
}

} // namespace
} // namespace limn::light_points_test
