// SPDX-License-Identifier: MIT
#include "editor_ui/panels/action.h"
#include "editor_ui/view/pivot.h"
#include "tests/editor_ui/cornell_view.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace limn::pivot_test {
namespace {

TEST(Pivot, IsTheSurfaceUnderTheMouse) {
    CornellView v;
    const glm::vec2 aboveTheBlocks = v.at(0.5f, 0.3f);
    const auto hit = surfaceUnder(v.state, aboveTheBlocks);
    ASSERT_TRUE(hit);
    EXPECT_EQ(pivotUnder(v.state, aboveTheBlocks), *hit);
    EXPECT_NEAR(hit->z, v.state.sceneBounds.lower.z, 0.1f); // the back wall
}

TEST(Pivot, BesideTheSceneIsAtTheDepthOfTheSelectionElseOfTheMiddle) {
    CornellView v;
    const glm::vec2 corner = v.at(0.01f, 0.01f);
    ASSERT_FALSE(surfaceUnder(v.state, corner));
    const glm::vec3 eye = v.state.view.camera.eye;
    const glm::vec3 middle = pivotUnder(v.state, v.at(0.5f, 0.5f));
    EXPECT_NEAR(pivotUnder(v.state, corner).z, middle.z, 1e-4f);
    const glm::vec2 pixel = *toPixel(v.state.view.picture(), pivotUnder(v.state, corner));
    EXPECT_NEAR(pixel.x, corner.x, 0.01f);
    const ObjectId lamp =
        addObject(v.state.document, Light{.name = "Lamp", .position = eye - glm::vec3(0, 0, 1.5f)});
    v.state.selection = {lamp};
    EXPECT_NEAR(pivotUnder(v.state, corner).z, eye.z - 1.5f, 1e-4f);
}

TEST(Pivot, WithoutASceneToTraceIsAtTheTargetsDepth) {
    CornellView v;
    v.state.trace = nullptr;
    const Camera& camera = v.state.view.camera;
    const glm::vec3 pivot = pivotUnder(v.state, v.at(0.5f, 0.5f));
    EXPECT_NEAR(glm::length(pivot - camera.target), 0, 1e-4f);
}

TEST(Pivot, AnImportedCameraOrbitsAboutWhatIsUnderTheMouse) {
    CornellView v;
    const glm::vec2 from = glm::floor(v.at(0.45f, 0.55f)); // ImGui counts whole pixels
    const glm::vec3 pivot = *surfaceUnder(v.state, from);
    v.drag(from, from + glm::vec2(120, 30));
    const glm::vec2 pixel = *toPixel(v.state.view.picture(), pivot);
    EXPECT_NEAR(pixel.x, from.x, 0.1f);
    EXPECT_NEAR(pixel.y, from.y, 0.1f);
    EXPECT_TRUE(surfaceUnder(v.state, v.at(0.5f, 0.5f))); // Cornell is still in view
}

TEST(Pivot, TheWheelBringsAnImportedCameraIntoTheRoom) {
    CornellView v;
    const glm::vec2 mouse = v.at(0.5f, 0.5f);
    v.ui.mouse(mouse.x, mouse.y);
    for (int i = 0; i < 12; ++i)
        v.ui.input.events.push_back({.kind = InputEvent::Kind::Scroll, .position = {0, 1}});
    v.ui.frames(v.state);
    const glm::vec3 eye = v.state.view.camera.eye;
    EXPECT_LT(eye.z, v.state.sceneBounds.upper.z);
    EXPECT_GT(eye.z, v.state.sceneBounds.lower.z);
}

TEST(Pivot, ANumpadViewStandsOffWhatTheMiddleSees) {
    CornellView v;
    const glm::vec3 middle = pivotUnder(v.state, v.at(0.5f, 0.5f));
    const float distance = glm::length(middle - v.state.view.camera.eye);
    runAction(v.state, actionById("view.right"));
    EXPECT_NEAR(glm::length(v.state.view.camera.eye - v.state.view.camera.target), distance,
                1e-3f * distance);
    EXPECT_NEAR(glm::length(v.state.view.camera.target - middle), 0, 1e-3f * distance);
}

} // namespace
} // namespace limn::pivot_test
