// SPDX-License-Identifier: MIT
#include "editor_ui/view/gizmo_math.h"

#include <cmath>
#include <random>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

namespace limn {
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
            const auto d = dragDisplacement(p, h, origin, *toPixel(p, grabbed),
                                            *toPixel(p, grabbed + axis * t));
            ASSERT_TRUE(d);
            EXPECT_NEAR(glm::length(*d - axis * t), 0, 2e-4f) << int(h) << " " << t;
        }
}

TEST(GizmoMath, ADragBesideAnAxisStaysOnIt) {
    const Picture p = somePicture();
    const auto d = dragDisplacement(p, Handle::X, {0, 0, 0}, {500, 300}, {571, 213});
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
            dragDisplacement(p, h, origin, *toPixel(p, grabbed), *toPixel(p, grabbed + move));
        ASSERT_TRUE(d);
        EXPECT_NEAR(glm::length(*d - move), 0, 2e-4f) << int(h);
    }
}

TEST(GizmoMath, AnAxisThatPointsAtTheEyeCannotBeDragged) {
    const Picture p{{.eye = {0, 0, 4}, .target = {0, 0, 0}}, {0, 0}, {400, 400}};
    EXPECT_FALSE(dragDisplacement(p, Handle::Z, {0, 0, 0}, {200, 200}, {200, 200}));
    EXPECT_FALSE(dragDisplacement(p, Handle::YZ, {0, 0, 0}, {200, 200}, {200, 250}));
    EXPECT_NE(handleAt(p, {0, 0, 0}, {200, 200}), Handle::Z);
}

TEST(GizmoMath, TheHandleUnderTheMouseIsTheOneDrawnThere) {
    const Picture p = somePicture();
    const glm::vec3 origin(0, 0.5f, 0);
    const float length = arrowLength(p, origin);
    for (Handle h : {Handle::X, Handle::Y, Handle::Z}) {
        const auto tip = toPixel(p, arrowTip(h, origin, length * 0.9f));
        EXPECT_EQ(handleAt(p, origin, *tip), h);
    }
    for (Handle h : {Handle::YZ, Handle::ZX, Handle::XY}) {
        const auto corners = planeHandle(h, origin, length);
        const auto middle = toPixel(p, (corners[0] + corners[2]) * 0.5f);
        EXPECT_EQ(handleAt(p, origin, *middle), h);
    }
    EXPECT_EQ(handleAt(p, origin, {280, 60}), Handle::None);
}

TEST(GizmoMath, SnappingRoundsEachComponent) {
    const glm::vec3 s = snapped({0.26f, -0.24f, 0.04f}, 0.1f);
    EXPECT_NEAR(s.x, 0.3f, 1e-6f);
    EXPECT_NEAR(s.y, -0.2f, 1e-6f);
    EXPECT_EQ(s.z, 0);
}

} // namespace
} // namespace limn
