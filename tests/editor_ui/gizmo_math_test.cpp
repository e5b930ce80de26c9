// SPDX-License-Identifier: MIT
#include "editor_ui/view/gizmo_math.h"

#include <cmath>
#include <random>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

namespace limn::gizmo_math_test {
namespace {

Picture somePicture() {
    return {{.eye = {3, 2, 5}, .target = {0, 0.5f, 0}, .fovY = 0.8f}, {270, 40}, {640, 480}};
}

TEST(GizmoMath, APixelIsWhereThePerspectivePutsThePoint) {
    const Picture p{{.eye = {0, 0, 4}, .target = {0, 0, 0}, .fovY = glm::half_pi<float>()},
                    {100, 50},
                    {400, 200}};
    const auto centre = toPixel(p, {0, 0, 0});
    ASSERT_TRUE(centre);
    EXPECT_NEAR(centre->x, 300, 1e-3f);
    EXPECT_NEAR(centre->y, 150, 1e-3f);
    const auto up = toPixel(p, {0, 2, 0}); // tan 45 = 1: half the height at distance 4 is 4
    EXPECT_NEAR(up->y, 100, 1e-3f);
    const auto right = toPixel(p, {2, 0, 0});
    EXPECT_NEAR(right->x, 350, 1e-3f);
    EXPECT_FALSE(toPixel(p, {0, 0, 5}));
}

TEST(GizmoMath, ThePixelsDirectionLeadsBackToThePoint) {
    const Picture p = somePicture();
    std::mt19937 rng(1);
    std::uniform_real_distribution<float> coordinate(-1.5f, 1.5f);
    for (int i = 0; i < 200; ++i) {
        const glm::vec3 world(coordinate(rng), coordinate(rng), coordinate(rng));
        const auto pixel = toPixel(p, world);
        ASSERT_TRUE(pixel);
        const glm::vec3 expected = glm::normalize(world - p.camera.eye);
        EXPECT_GT(glm::dot(pixelDirection(p, *pixel), expected), 1 - 1e-6f);
    }
}

TEST(GizmoMath, AnArrowIsAsLongOnScreenAtAnyDistance) {
    const Picture p = somePicture();
    const glm::vec3 forward = glm::normalize(p.camera.target - p.camera.eye);
    const glm::vec3 right = glm::normalize(glm::cross(forward, {0, 1, 0}));
    for (float distance : {0.01f, 1.f, 300.f}) {
        const glm::vec3 origin = p.camera.eye + forward * distance;
        const auto a = toPixel(p, origin), b = toPixel(p, origin + right * arrowLength(p, origin));
        EXPECT_NEAR(glm::length(*b - *a), 90, 0.05f);
    }
}

TEST(GizmoMath, ADragAlongAnAxisGivesExactlyTheWayTheMouseWentOnIt) {
    const Picture p = somePicture();
    const glm::vec3 origin(0.2f, 0.4f, -0.3f);
    for (Handle h : {Handle::X, Handle::Y, Handle::Z})
        for (float t : {-0.7f, 0.1f, 1.3f}) {
            const glm::vec3 axis = handleAxis(h), grabbed = origin + axis * 0.2f;
            const auto d = dragDisplacement(p, h, {origin}, *toPixel(p, grabbed),
                                            *toPixel(p, grabbed + axis * t));
            ASSERT_TRUE(d);
            EXPECT_NEAR(glm::length(*d - axis * t), 0, 2e-4f) << int(h) << " " << t;
        }
}

TEST(GizmoMath, ADragBesideAnAxisStaysOnIt) {
    const Picture p = somePicture();
    const auto d = dragDisplacement(p, Handle::X, {}, {500, 300}, {571, 213});
    ASSERT_TRUE(d);
    EXPECT_NE(d->x, 0);
    EXPECT_EQ(d->y, 0);
    EXPECT_EQ(d->z, 0);
}

TEST(GizmoMath, ADragInAPlaneGivesExactlyTheWayTheMouseWentInIt) {
    const Picture p = somePicture();
    const glm::vec3 origin(0.2f, 0.4f, -0.3f);
    for (Handle h : {Handle::YZ, Handle::ZX, Handle::XY}) {
        const glm::vec3 n = handleAxis(h), move = glm::vec3(0.3f, -0.2f, 0.5f) * (glm::vec3(1) - n);
        const glm::vec3 grabbed = origin + glm::vec3(0.1f) * (glm::vec3(1) - n);
        const auto d =
            dragDisplacement(p, h, {origin}, *toPixel(p, grabbed), *toPixel(p, grabbed + move));
        ASSERT_TRUE(d);
        EXPECT_NEAR(glm::length(*d - move), 0, 2e-4f) << int(h);
    }
}

TEST(GizmoMath, AnAxisThatPointsAtTheEyeCannotBeDragged) {
    const Picture p{{.eye = {0, 0, 4}, .target = {0, 0, 0}}, {0, 0}, {400, 400}};
    EXPECT_FALSE(dragDisplacement(p, Handle::Z, {}, {200, 200}, {200, 200}));
    EXPECT_FALSE(dragDisplacement(p, Handle::YZ, {}, {200, 200}, {200, 250}));
    EXPECT_NE(handleAt(p, Tool::Move, {}, {200, 200}), Handle::Z);
}

TEST(GizmoMath, TheHandleUnderTheMouseIsTheOneDrawnThere) {
    const Picture p = somePicture();
    const glm::vec3 origin(0, 0.5f, 0);
    const float length = arrowLength(p, origin);
    for (Handle h : {Handle::X, Handle::Y, Handle::Z}) {
        const auto tip = toPixel(p, arrowTip(h, {origin}, length * 0.9f));
        EXPECT_EQ(handleAt(p, Tool::Move, {origin}, *tip), h);
    }
    for (Handle h : {Handle::YZ, Handle::ZX, Handle::XY}) {
        const auto corners = planeHandle(h, {origin}, length);
        const auto middle = toPixel(p, (corners[0] + corners[2]) * 0.5f);
        EXPECT_EQ(handleAt(p, Tool::Move, {origin}, *middle), h);
    }
    EXPECT_EQ(handleAt(p, Tool::Move, {origin}, {280, 60}), Handle::None);
}

/// Axes of no particular direction.
glm::mat3 someAxes() {
    return glm::mat3_cast(glm::normalize(glm::quat(0.9f, 0.2f, -0.3f, 0.25f)));
}

TEST(GizmoMath, HandlesFollowTheAxesOfTheirFrame) {
    const Picture p = somePicture();
    const GizmoFrame frame{{0.1f, 0.4f, 0}, someAxes()};
    for (Handle h : {Handle::X, Handle::Y, Handle::Z}) {
        const glm::vec3 axis = frame.axes * handleAxis(h);
        const auto from = toPixel(p, frame.origin + axis * 0.2f);
        const auto to = toPixel(p, frame.origin + axis * 0.6f);
        const auto d = dragDisplacement(p, h, frame, *from, *to);
        ASSERT_TRUE(d);
        EXPECT_NEAR(glm::length(*d - axis * 0.4f), 0, 2e-4f) << int(h);
        const float length = arrowLength(p, frame.origin);
        EXPECT_EQ(handleAt(p, Tool::Scale, frame, *toPixel(p, arrowTip(h, frame, length))), h);
    }
}

TEST(GizmoMath, ADragRoundARingGivesTheAngleAtItsMiddle) {
    const Picture p = somePicture();
    const GizmoFrame frame{{0.1f, 0.4f, 0}}; // no ring of which is edge-on
    const float radius = arrowLength(p, frame.origin);
    for (Handle h : {Handle::X, Handle::Y, Handle::Z, Handle::All}) {
        const glm::vec3 normal =
            h == Handle::All ? towardsEye(p, frame.origin) : frame.axes * handleAxis(h);
        for (float angle : {-2.f, -0.3f, 0.7f, 3.f}) {
            const auto from = toPixel(p, ringPoint(frame.origin, normal, radius, 0.4f));
            const auto to = toPixel(p, ringPoint(frame.origin, normal, radius, 0.4f + angle));
            const auto turned = dragAngle(p, h, frame, *from, *to);
            ASSERT_TRUE(turned);
            EXPECT_NEAR(*turned, angle, 2e-3f) << int(h);
        }
    }
}

// A ring seen edge-on is a line. The side that faces the eye follows the mouse along it.
TEST(GizmoMath, ARingSeenEdgeOnTurnsAsTheMouseGoesAlongIt) {
    const Picture p{{.eye = {0, 0, 4}, .target = {0, 0, 0}}, {0, 0}, {400, 400}};
    const auto right = dragAngle(p, Handle::Y, {}, {200, 200}, {245, 200});
    ASSERT_TRUE(right);
    EXPECT_GT(*right, 0.3f); // +Z towards +X about +Y
    EXPECT_LT(*right, 0.6f);
    EXPECT_NEAR(*dragAngle(p, Handle::Y, {}, {200, 200}, {155, 200}), -*right, 1e-4f);
    EXPECT_NEAR(*dragAngle(p, Handle::Y, {}, {200, 200}, {200, 245}), 0, 1e-4f);
}

TEST(GizmoMath, RingsArePickedWhereTheyFaceTheEye) {
    const Picture p = somePicture();
    const GizmoFrame frame{{0, 0.5f, 0}};
    const float radius = arrowLength(p, frame.origin);
    for (Handle h : {Handle::X, Handle::Y, Handle::Z}) {
        const glm::vec3 normal = handleAxis(h), eye = towardsEye(p, frame.origin);
        const glm::vec3 near = glm::normalize(eye - normal * glm::dot(eye, normal));
        EXPECT_EQ(handleAt(p, Tool::Rotate, frame, *toPixel(p, frame.origin + near * radius)), h);
        EXPECT_NE(handleAt(p, Tool::Rotate, frame, *toPixel(p, frame.origin - near * radius)), h);
    }
    const glm::vec2 middle = *toPixel(p, frame.origin);
    const glm::vec2 rim = middle + glm::vec2(0.6f, -0.8f) * (90 * kOuterRing);
    EXPECT_EQ(handleAt(p, Tool::Rotate, frame, rim), Handle::All);
    EXPECT_EQ(handleAt(p, Tool::Scale, frame, rim), Handle::All);
    EXPECT_EQ(handleAt(p, Tool::Move, frame, middle), Handle::All);
    EXPECT_EQ(handleAt(p, Tool::Select, frame, middle), Handle::None);
}

TEST(GizmoMath, TheFactorIsTheRatioOfDistancesFromTheOrigin) {
    const Picture p = somePicture();
    const GizmoFrame frame{{0.1f, 0.4f, 0}, someAxes()};
    const glm::vec3 axis = frame.axes[1];
    for (float factor : {-1.5f, 0.25f, 2.f}) {
        const auto f = dragFactor(p, Handle::Y, frame, *toPixel(p, frame.origin + axis * 0.5f),
                                  *toPixel(p, frame.origin + axis * (0.5f * factor)));
        ASSERT_TRUE(f);
        EXPECT_NEAR(*f, factor, 1e-3f);
    }
    const glm::vec2 middle = *toPixel(p, frame.origin);
    EXPECT_NEAR(
        *dragFactor(p, Handle::All, frame, middle + glm::vec2(30, 40), middle + glm::vec2(0, -100)),
        2, 1e-3f);
    EXPECT_FALSE(dragFactor(p, Handle::All, frame, middle, middle + glm::vec2(0, -100)));
}

TEST(GizmoMath, SnappingRoundsEachComponent) {
    const glm::vec3 s = snapped({0.26f, -0.24f, 0.04f}, 0.1f);
    EXPECT_NEAR(s.x, 0.3f, 1e-6f);
    EXPECT_NEAR(s.y, -0.2f, 1e-6f);
    EXPECT_EQ(s.z, 0);
}

} // namespace
} // namespace limn::gizmo_math_test
