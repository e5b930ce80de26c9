// SPDX-License-Identifier: MIT
// Surfaces are lit by the normals of their vertices, as they are seen.
#include "tests/techniques/illuminance/relight/relit.h"
#include "tests/trace/simple_scene.h"

#include <numbers>

#include <glm/geometric.hpp>

namespace limn::smooth_normals_test {
namespace {

using namespace simple;

/// A floor whose vertices' normals lean over by 40 degrees, two-sided or not, and mirrored or not.
Scene leaning(bool twoSided, float mirror) {
    const float angle = 40 * std::numbers::pi_v<float> / 180;
    SceneBuilder b;
    Material grey = lambert(glm::vec3(0.5f));
    grey.doubleSided = twoSided;
    b.addMaterial(grey);
    Mesh floor = quad({-1, 0, 1}, {2, 0, 0}, {0, 0, -2});
    floor.normals.assign(4, {std::sin(angle), std::cos(angle), 0});
    glm::mat4 place(1);
    place[0][0] = mirror;
    b.add(std::move(floor), place);
    Light sun;
    sun.kind = LightKind::Directional;
    sun.direction = {0, -1, 0};
    sun.strength = 3;
    b.scene.lights.push_back(sun);
    Scene scene = b.build();
    scene.bake.surfels = 200;
    scene.bake.lightmapCaches = 100;
    scene.bake.rays = 64;
    return scene;
}

TEST(SmoothNormals, SurfelsGetLightByTheNormalsOfTheVertices) {
    for (const bool twoSided : {false, true})
        for (const float mirror : {1.f, -1.f}) {
            const Relit lit(leaning(twoSided, mirror));
            const Surfels& s = lit.baked->surfels;
            const float cosine = std::cos(40 * std::numbers::pi_v<float> / 180);
            for (std::size_t i = 0; i < s.size(); ++i) {
                EXPECT_NEAR(std::abs(s.normal[i].y), cosine, 1e-5f);
                const float up = s.normal[i].y > 0 ? 1.f : 0.f;
                EXPECT_NEAR(lit.relighter.radiosity()[i].x, up * 0.5f * 3 * cosine, 1e-4f)
                    << twoSided << " " << mirror;
            }
        }
}

} // namespace
} // namespace limn::smooth_normals_test
