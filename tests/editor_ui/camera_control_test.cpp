// SPDX-License-Identifier: MIT
#include "editor_ui/view/camera_control.h"
#include "editor_ui/view/gizmo_math.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

namespace limn::camera_control_test {
namespace {

void expectNear(glm::vec3 a, glm::vec3 b, float tolerance = 1e-4f) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
    EXPECT_NEAR(a.z, b.z, tolerance);
}

Camera atDistanceFour() {
    return {.eye = {1, 2, 7}, .target = {1, 2, 3}};
}

TEST(CameraControl, OrbitByAQuarterMovesTheEyeToTheRightSide) {
    Camera c = atDistanceFour();
    orbit(c, c.target, glm::half_pi<float>(), 0);
    expectNear(c.eye, {5, 2, 3});
    expectNear(c.target, {1, 2, 3});
}

TEST(CameraControl, OrbitKeepsTheDistanceAndStopsBeforeThePoles) {
    Camera c = atDistanceFour();
    for (int i = 0; i < 100; ++i)
        orbit(c, c.target, 0.1f, 0.1f);
    EXPECT_NEAR(glm::length(c.eye - c.target), 4, 1e-3f);
    const float elevation = std::asin((c.eye.y - c.target.y) / 4);
    EXPECT_NEAR(elevation, 89 * glm::pi<float>() / 180, 1e-3f);
    EXPECT_TRUE(std::isfinite(viewMatrix(c)[0][0]));
}

TEST(CameraControl, PanByThePicturesHeightShiftsByItsHeightAtTheTarget) {
    Camera c = atDistanceFour();
    c.fovY = glm::half_pi<float>(); // height at distance d is 2 d
    pan(c, 0, 0.5f);
    expectNear(c.eye, {1, 6, 7});
    expectNear(c.target, {1, 6, 3});
    pan(c, 0.25f, 0);
    expectNear(c.target, {3, 6, 3});
}

TEST(CameraControl, ZoomMultipliesTheDistanceByNineTenthsPerStep) {
    Camera c = atDistanceFour();
    zoom(c, c.target, 2);
    expectNear(c.eye, {1, 2, 3 + 4 * 0.81f});
    zoom(c, c.target, 1000);
    EXPECT_NEAR(glm::length(c.eye - c.target), 1e-3f, 1e-5f);
}

TEST(CameraControl, ThePointThatTheViewTurnsAboutStaysAtItsPixelAndDistance) {
    const glm::vec3 pivot(2.5f, 2.8f, -4);
    Picture picture{atDistanceFour(), {100, 50}, {640, 480}};
    const glm::vec2 pixel = *toPixel(picture, pivot);
    const float distance = glm::length(pivot - picture.camera.eye);
    const glm::vec3 before = forward(picture.camera);
    orbit(picture.camera, pivot, 0.8f, 0.3f);
    const glm::vec2 now = *toPixel(picture, pivot);
    EXPECT_NEAR(now.x, pixel.x, 0.01f);
    EXPECT_NEAR(now.y, pixel.y, 0.01f);
    EXPECT_NEAR(glm::length(pivot - picture.camera.eye), distance, 1e-4f);
    EXPECT_NEAR(glm::dot(before, forward(picture.camera)), std::cos(0.8f) * std::cos(0.3f), 1e-5f);
}

TEST(CameraControl, ThePointThatTheViewZoomsTowardsStaysAtItsPixel) {
    const glm::vec3 point(2.5f, 2.8f, -4);
    Picture picture{atDistanceFour(), {100, 50}, {640, 480}};
    const glm::vec2 pixel = *toPixel(picture, point);
    const glm::vec3 ahead = forward(picture.camera);
    const float distance = glm::length(point - picture.camera.eye);
    zoom(picture.camera, point, 3);
    const glm::vec2 now = *toPixel(picture, point);
    EXPECT_NEAR(now.x, pixel.x, 0.01f);
    EXPECT_NEAR(now.y, pixel.y, 0.01f);
    EXPECT_NEAR(glm::length(point - picture.camera.eye), 0.729f * distance, 1e-4f);
    expectNear(forward(picture.camera), ahead);
}

TEST(CameraControl, TheTargetTakesThePointsDepthAndThePictureStays) {
    Camera c = atDistanceFour();
    setTargetDepth(c, {9, 9, -3});
    expectNear(c.target, {1, 2, -3});
    expectNear(c.eye, {1, 2, 7});
    setTargetDepth(c, {0, 0, 8}); // behind the eye
    expectNear(c.target, {1, 2, -3});
}

TEST(CameraControl, LookTurnsAboutTheEyeToTheRight) {
    Camera c = atDistanceFour();
    look(c, glm::half_pi<float>(), 0);
    expectNear(c.eye, {1, 2, 7});
    expectNear(c.target, {5, 2, 7});
}

TEST(CameraControl, FlyMovesAlongTheCamerasOwnAxes) {
    Camera c = atDistanceFour();
    fly(c, 1, 2, 3);
    expectNear(c.eye, {2, 4, 4});
    expectNear(c.target, {2, 4, 0});
}

TEST(CameraControl, FocusShowsTheWholeSphereAroundTheBoxFromTheSameSide) {
    Camera c = atDistanceFour();
    focus(c, {{-2, -2, -1}, {2, 2, 1}}); // radius 3
    expectNear(c.target, {0, 0, 0});
    EXPECT_NEAR(glm::length(c.eye) * std::sin(c.fovY / 2), 3, 1e-4f);
    expectNear(glm::normalize(c.eye), {0, 0, 1});
}

TEST(CameraControl, NumpadViewsStandOnTheirAxes) {
    const std::pair<Side, glm::vec3> sides[] = {
        {Side::Front, {0, 0, 1}}, {Side::Back, {0, 0, -1}}, {Side::Right, {1, 0, 0}},
        {Side::Left, {-1, 0, 0}}, {Side::Top, {0, 1, 0}},   {Side::Bottom, {0, -1, 0}}};
    for (const auto& [side, axis] : sides) {
        Camera c = atDistanceFour();
        orbit(c, c.target, 0.7f, 0.4f);
        lookFrom(c, side);
        // A degree short of the pole keeps +Y up in the picture.
        EXPECT_GT(glm::dot(glm::normalize(c.eye - c.target), axis), std::cos(0.018f));
        EXPECT_NEAR(glm::length(c.eye - c.target), 4, 1e-3f);
    }
}

TEST(CameraControl, ACameraThatStandsOnItsTargetStaysFinite) {
    Camera c{.eye = {1, 1, 1}, .target = {1, 1, 1}};
    orbit(c, c.target, 0.1f, 0.1f);
    look(c, 0.1f, 0.1f);
    zoom(c, c.target, 3);
    focus(c, {});
    EXPECT_TRUE(std::isfinite(c.eye.x + c.eye.y + c.eye.z + c.target.x + c.target.y + c.target.z));
    EXPECT_NE(c.eye, c.target);
}

} // namespace
} // namespace limn::camera_control_test
