// SPDX-License-Identifier: MIT
#include "engine/lighting/direct_irradiance.h"

#include "tests/trace/simple_scene.h"

#include <gtest/gtest.h>

#include <random>

#include <glm/gtc/matrix_transform.hpp>

namespace limn::direct_irradiance_test {
namespace {

/// A floor below a still and a moving plate, `x` along, with a light of each kind.
Scene plates(float x, bool isThere = true) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(glm::vec3(0.5f)));
    b.add(simple::quad({-4, 0, 4}, {8, 0, 0}, {0, 0, -8}));
    b.add(simple::quad({-3, 1, 1}, {2, 0, 0}, {0, 0, -2}));
    if (isThere)
        b.add(simple::quad({-1, 1, 1}, {2, 0, 0}, {0, 0, -2}),
              glm::translate(glm::mat4(1), {x, 0, 0}), true);
    for (const LightKind kind :
         {LightKind::Directional, LightKind::Point, LightKind::Spot, LightKind::Rectangle}) {
        Light light;
        light.kind = kind;
        light.position = {0.3f, 4, 0.2f};
        light.direction = {0, -1, 0};
        b.scene.lights.push_back(light);
    }
    return b.build();
}

struct Floor {
    std::vector<glm::vec3> positions, normals;

    explicit Floor(std::size_t count) : normals(count, {0, 1, 0}) {
        std::mt19937 random(9);
        std::uniform_real_distribution<float> within(-4, 4);
        for (std::size_t i = 0; i < count; ++i)
            positions.emplace_back(within(random), 0, within(random));
    }
};

/// Updates `state` and compares it with what a new one finds.
void expectAsNew(const Scene& scene, const TraceScene& trace, const Floor& floor,
                 DirectIrradiance& state, std::uint32_t each) {
    updateDirectIrradiance(floor.positions, floor.normals, scene, trace, state, each);
    DirectIrradiance anew;
    updateDirectIrradiance(floor.positions, floor.normals, scene, trace, anew, each);
    EXPECT_EQ(state.irradiance, anew.irradiance);
}

TEST(DirectIrradiance, OfMovedObjectsIsThatOfANewStart) {
    for (const std::uint32_t each : {1U, 4U}) {
        const Floor floor(3000 * each);
        Scene scene = plates(0);
        auto trace = std::make_unique<TraceScene>(scene);
        DirectIrradiance state;
        expectAsNew(scene, *trace, floor, state, each);
        const std::uint64_t all = state.raysTraced;
        for (const float x : {1.f, -2.f, 0.5f}) {
            scene = plates(x);
            trace = std::make_unique<TraceScene>(scene, *trace);
            expectAsNew(scene, *trace, floor, state, each);
            EXPECT_EQ(state.lightsTraced, 4U);
            EXPECT_LT(state.raysTraced, all);
        }
        scene.lights[1].position.x += 1; // one light, and then the object again
        expectAsNew(scene, *trace, floor, state, each);
        EXPECT_EQ(state.lightsTraced, 1U);
        scene.instances[2].toWorld[3].x += 1;
        trace = std::make_unique<TraceScene>(scene, *trace);
        expectAsNew(scene, *trace, floor, state, each);
        scene = plates(0, false);
        trace = std::make_unique<TraceScene>(scene);
        expectAsNew(scene, *trace, floor, state, each);
        EXPECT_EQ(state.lightsTraced, 4U);
    }
}

/// What moved on is no longer in the shadow.
TEST(DirectIrradiance, FollowsTheObject) {
    const std::vector<glm::vec3> positions = {{0, 0, 0}, {2, 0, 0}, {-2, 0, 0}},
                                 normals(3, {0, 1, 0});
    Scene scene = plates(0);
    scene.lights.resize(1); // the sun, straight from above
    auto trace = std::make_unique<TraceScene>(scene);
    DirectIrradiance state;
    updateDirectIrradiance(positions, normals, scene, *trace, state);
    EXPECT_EQ(state.irradiance[0].x, 0);
    EXPECT_GT(state.irradiance[1].x, 0);
    EXPECT_EQ(state.irradiance[2].x, 0) << "below the still plate";
    scene.instances[2].toWorld[3].x += 2;
    trace = std::make_unique<TraceScene>(scene, *trace);
    EXPECT_TRUE(updateDirectIrradiance(positions, normals, scene, *trace, state));
    EXPECT_GT(state.irradiance[0].x, 0);
    EXPECT_EQ(state.irradiance[1].x, 0);
    EXPECT_EQ(state.irradiance[2].x, 0);
    EXPECT_EQ(state.raysTraced, 2U) << "of those that see the sun past the still plate";
}

} // namespace
} // namespace limn::direct_irradiance_test
