// SPDX-License-Identifier: MIT
#include "editor_ui/document/manipulation.h"

#include "editor_ui/document/document_edit.h"
#include "editor_ui/document/object_rules.h"
#include "engine/scene/light/rectangle_light.h"
#include "tests/editor_ui/headless.h"

#include <random>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

namespace limn::manipulation_test {
namespace {

struct ManipulationTest : testing::Test {
    EditorState state = fullEditor();
    const ObjectId left = idNamed(state, "Left"), group = idNamed(state, "Group");

    Node& node(ObjectId id) { return std::get<Node>(state.document.objects.at(id)); }
    Light& light(const char* name) {
        return std::get<Light>(state.document.objects.at(idNamed(state, name)));
    }
    void apply(ObjectId id, const Manipulation& by) {
        Object& object = state.document.objects.at(id);
        object = manipulated(state.document, object, by);
    }
    glm::mat4 world(ObjectId id) const { return worldMatrix(state.document, id); }
};

float difference(const glm::mat4& a, const glm::mat4& b) {
    float most = 0;
    for (int c = 0; c < 4; ++c)
        most = std::max(most, glm::length(a[c] - b[c]));
    return most;
}

/// The manipulation as a matrix.
glm::mat4 asMatrix(const Manipulation& by) {
    const glm::mat3 linear = glm::mat3_cast(by.turn) * by.axes *
                             glm::mat3(by.scale.x, 0, 0, 0, by.scale.y, 0, 0, 0, by.scale.z) *
                             glm::transpose(by.axes);
    glm::mat4 m(linear);
    m[3] = glm::vec4(by.pivot - linear * by.pivot + by.move, 1);
    return m;
}

TEST_F(ManipulationTest, ANodeMovesThatFarInTheWorldUnderItsScaledParent) {
    const glm::vec3 d(0.3f, -0.2f, 0.7f), from = world(left)[3];
    apply(left, {.move = d});
    EXPECT_NEAR(glm::length(glm::vec3(world(left)[3]) - from - d), 0, 1e-5f);
}

TEST_F(ManipulationTest, TurningAboutAPivotIsExactUnderATurnedAndEvenlyScaledParent) {
    node(group).transform.rotation = glm::normalize(glm::quat(0.8f, 0.3f, -0.4f, 0.1f));
    node(left).transform = {
        {0.4, 0.1, -2}, glm::normalize(glm::quat(0.5f, -0.4f, 0.3f, 0.6f)), {1, 3, -0.5f}};
    const Manipulation by{.pivot = {1, -2, 0.5f},
                          .move = {0.2f, 0, 1},
                          .turn = glm::normalize(glm::quat(0.9f, 0.1f, 0.4f, -0.2f)),
                          .scale = glm::vec3(1.7f)};
    const glm::mat4 expected = asMatrix(by) * world(left);
    apply(left, by);
    EXPECT_LT(difference(world(left), expected), 2e-5f);
    EXPECT_TRUE(isValid(state.document.objects.at(left)));
}

TEST_F(ManipulationTest, ScalingAlongOwnAxesIsExactForATurnedNode) {
    node(left).transform.rotation = glm::normalize(glm::quat(0.5f, -0.4f, 0.3f, 0.6f));
    const Manipulation by{.pivot = world(left)[3],
                          .scale = {2, 0.5f, -1},
                          .axes = ownAxes(state.document, state.document.objects.at(left)),
                          .alongOwnAxes = true};
    const glm::mat4 expected = asMatrix(by) * world(left);
    apply(left, by);
    EXPECT_LT(difference(world(left), expected), 2e-5f);
}

TEST_F(ManipulationTest, ScalingAlongTheWorldsAxesIsExactForAnUprightNode) {
    const Manipulation by{.pivot = {1, 2, 3}, .scale = {2, 0.5f, -1}};
    const glm::mat4 expected = asMatrix(by) * world(left);
    apply(left, by);
    EXPECT_LT(difference(world(left), expected), 2e-5f);
}

// Parents that shear: the place is exact, and a full turn in steps comes back to the start.
TEST_F(ManipulationTest, TurningUnderAShearingParentKeepsTheSizeAndComesBack) {
    node(group).transform.scale = {4, 1, 0.3f};
    Node middle;
    middle.parent = group;
    middle.transform.rotation = glm::normalize(glm::quat(0.8f, 0.3f, -0.4f, 0.1f));
    middle.transform.scale = {1, 2, 1};
    node(left).parent = addObject(state.document, middle);
    const Transform before = node(left).transform;
    const glm::vec3 pivot(0.5f, 0, 0.25f);
    const glm::quat step =
        glm::angleAxis(glm::two_pi<float>() / 8, glm::normalize(glm::vec3(1, 2, -1)));
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 expected = pivot + step * (glm::vec3(world(left)[3]) - pivot);
        apply(left, {.pivot = pivot, .turn = step});
        EXPECT_NEAR(glm::length(glm::vec3(world(left)[3]) - expected), 0, 1e-4f);
        EXPECT_EQ(node(left).transform.scale, before.scale);
        EXPECT_NEAR(glm::length(node(left).transform.rotation), 1, 1e-5f);
        EXPECT_TRUE(i == 7 || node(left).transform.rotation != before.rotation);
    }
    EXPECT_NEAR(std::abs(glm::dot(node(left).transform.rotation, before.rotation)), 1, 1e-5f);
    EXPECT_NEAR(glm::length(node(left).transform.translation - before.translation), 0, 1e-4);
}

TEST_F(ManipulationTest, NothingBecomesInvalid) {
    std::mt19937 rng(3);
    std::uniform_real_distribution<float> number(-1, 1), power(-30, 30);
    const auto any = [&] { return glm::vec3(number(rng), number(rng), number(rng)); };
    for (int i = 0; i < 400; ++i) {
        const glm::vec3 large = any() * std::pow(10.f, power(rng));
        Manipulation by{.pivot = any(), .move = i % 3 ? any() : large};
        by.turn = glm::normalize(glm::quat(number(rng), number(rng), number(rng), 0.1f));
        by.scale = i % 2 ? large : any();
        by.alongOwnAxes = i % 5 == 0;
        if (i % 7 == 0)
            by.scale = glm::vec3(0);
        if (i % 11 == 0)
            by.move.x = std::numeric_limits<float>::quiet_NaN();
        const auto objects = state.document.objects;
        for (const auto& [id, object] : objects) {
            apply(id, by);
            EXPECT_TRUE(isValid(state.document.objects.at(id))) << objectName(object) << i;
        }
        if (i % 40 == 0)
            state.document.objects = fullEditor().document.objects;
    }
}

TEST_F(ManipulationTest, ScalesStayWithinTheirLimits) {
    for (int i = 0; i < 20; ++i)
        apply(left, {.scale = glm::vec3(-0.01f, 1000, 1)});
    const glm::vec3 s = node(left).transform.scale;
    EXPECT_EQ(std::abs(s.x), kMinNodeScale);
    EXPECT_EQ(s.y, kMaxNodeScale);
    EXPECT_EQ(s.z, 1);
}

TEST_F(ManipulationTest, ARectangleLightTurnsWithItsEdges) {
    Light& panel = light("Panel");
    panel.direction = glm::normalize(glm::vec3(0.3f, -0.7f, 0.2f));
    panel.roll = 0.4f;
    panel.size = {2, 0.5f};
    const LightRectangle before = lightRectangle(panel);
    const glm::quat turn = glm::normalize(glm::quat(0.9f, 0.5f, -0.2f, 0.3f));
    const glm::vec3 pivot(1, 1, 1);
    apply(idNamed(state, "Panel"), {.pivot = pivot, .turn = turn});
    const LightRectangle after = lightRectangle(panel);
    EXPECT_NEAR(glm::length(after.centre - (pivot + turn * (before.centre - pivot))), 0, 1e-5f);
    EXPECT_NEAR(glm::length(after.normal - turn * before.normal), 0, 1e-5f);
    EXPECT_NEAR(glm::length(after.halfWidth - turn * before.halfWidth), 0, 1e-5f);
    EXPECT_NEAR(glm::length(after.halfHeight - turn * before.halfHeight), 0, 1e-5f);
}

TEST_F(ManipulationTest, ScalingARectangleLightAlongItsOwnAxesChangesItsSides) {
    Light& panel = light("Panel");
    panel.direction = glm::normalize(glm::vec3(0.3f, -0.7f, 0.2f));
    panel.size = {2, 0.5f};
    const ObjectId id = idNamed(state, "Panel");
    apply(id, {.pivot = panel.position,
               .scale = {3, 0.5f, 7},
               .axes = ownAxes(state.document, state.document.objects.at(id)),
               .alongOwnAxes = true});
    EXPECT_NEAR(panel.size.x, 6, 1e-5f);
    EXPECT_NEAR(panel.size.y, 0.25f, 1e-5f);
}

TEST_F(ManipulationTest, OwnAxesOfLightsAndCamerasLookDownMinusZ) {
    for (const char* name : {"Torch", "Sun", "Panel"})
        EXPECT_NEAR(glm::length(ownAxes(state.document, light(name))[2] + light(name).direction), 0,
                    1e-6f)
            << name;
    const Camera& shot = std::get<Camera>(state.document.objects.at(idNamed(state, "Shot")));
    EXPECT_NEAR(glm::length(ownAxes(state.document, shot)[2] - glm::vec3(0, 0, 1)), 0, 1e-6f);
}

TEST_F(ManipulationTest, ACameraTurnsAboutThePivotAndKeepsItsDistance) {
    const ObjectId id = idNamed(state, "Shot"); // at 0, 1, 6 and looks at 0, 1, 0
    apply(id,
          {.pivot = {0, 1, 0}, .turn = glm::angleAxis(glm::half_pi<float>(), glm::vec3(0, 1, 0))});
    const Camera& shot = std::get<Camera>(state.document.objects.at(id));
    EXPECT_NEAR(glm::length(shot.eye - glm::vec3(6, 1, 0)), 0, 1e-5f);
    EXPECT_NEAR(glm::length(shot.target - glm::vec3(0, 1, 0)), 0, 1e-5f);
}

} // namespace
} // namespace limn::manipulation_test
