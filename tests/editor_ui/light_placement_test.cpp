// SPDX-License-Identifier: MIT
#include "editor_ui/panels/action.h"
#include "editor_ui/view/light_placement.h"
#include "editor_ui/view/pivot.h"
#include "tests/editor_ui/cornell_view.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace limn::light_placement_test {
namespace {

bool within(const Bounds& b, glm::vec3 p) {
    return p.x > b.lower.x && p.y > b.lower.y && p.z > b.lower.z && p.x < b.upper.x &&
           p.y < b.upper.y && p.z < b.upper.z;
}

bool seen(const EditorState& state, glm::vec3 from, glm::vec3 to) {
    const glm::vec3 d = to - from;
    const float length = glm::length(d);
    const Hit hit = state.trace->closestHit({from, d / length});
    return !hit || hit.t >= length * 0.999f;
}

TEST(LightPlacement, AClickPutsTheLightIntoTheRoomOffTheSurfaceThere) {
    CornellView v;
    for (LightKind kind : {LightKind::Point, LightKind::Spot, LightKind::Rectangle})
        for (float y = 0.2f; y < 0.9f; y += 0.15f)
            for (float x = 0.2f; x < 0.9f; x += 0.15f) {
                const glm::vec2 pixel = v.at(x, y);
                const Hit hit = v.state.trace->closestHit(
                    {v.state.view.camera.eye, pixelDirection(v.state.view.picture(), pixel)});
                if (!hit)
                    continue;
                const Light light = lightAtPixel(v.state, kind, pixel);
                EXPECT_TRUE(within(v.state.sceneBounds, light.position)) << x << ' ' << y;
                const glm::vec3 off = light.position - hit.position;
                EXPECT_NEAR(std::abs(glm::dot(glm::normalize(off), hit.geometricNormal)), 1, 1e-3f);
                EXPECT_GT(glm::dot(off, v.state.view.camera.eye - hit.position), 0);
                EXPECT_TRUE(seen(v.state, light.position, hit.position));
                EXPECT_NEAR(glm::dot(light.direction, glm::normalize(off)), 1, 1e-3f);
            }
}

TEST(LightPlacement, OffAFloorItIsATenthOfTheWayToTheCeiling) {
    CornellView v;
    v.state.view.camera.eye = {0, 4, 2.5f};
    v.state.view.camera.target = {0, 0, 2.4f};
    const Light light = lightAtPixel(v.state, LightKind::Point, v.at(0.5f, 0.5f));
    EXPECT_NEAR(light.position.y, 0.1f * v.state.sceneBounds.upper.y, 2e-3f);
}

TEST(LightPlacement, BeforeTheCameraItIsSeenAndInTheRoom) {
    CornellView v;
    const Light light = lightBeforeCamera(v.state, LightKind::Point);
    EXPECT_TRUE(within(v.state.sceneBounds, light.position));
    EXPECT_TRUE(seen(v.state, v.state.view.camera.eye, light.position));
    EXPECT_EQ(light.name, "Point light");
}

Light beforeTheCameraAtScale(LightKind kind, float scale) {
    CornellView v(scale);
    return lightBeforeCamera(v.state, kind);
}

TEST(LightPlacement, StrengthFitsTheScenesSize) {
    for (LightKind kind : {LightKind::Point, LightKind::Spot, LightKind::Rectangle}) {
        const Light a = beforeTheCameraAtScale(kind, 1), b = beforeTheCameraAtScale(kind, 1000);
        if (kind == LightKind::Rectangle) { // radiance is the same at any size
            EXPECT_NEAR(b.size.x / a.size.x, 1000, 1e-3);
            EXPECT_NEAR(b.strength / a.strength, 1, 1e-3);
        } else {
            EXPECT_NEAR(b.strength / a.strength, 1e6, 1e3);
        }
    }
}

/// The room is 5.5 m wide: its surfaces are between 1 and 5 m away.
TEST(LightPlacement, ANewLampLightsTheRoomByAboutFiveWattsASquareMetre) {
    CornellView v;
    Light light = lightBeforeCamera(v.state, LightKind::Point);
    for (float metres : {2.f, 5.f}) {
        const LightSample s = sampleLight(light, light.position + glm::vec3(metres, 0, 0));
        EXPECT_GT(s.irradiance.x, metres > 4 ? 0.3f : 1.5f);
        EXPECT_LT(s.irradiance.x, metres > 4 ? 5.f : 31.f);
    }
}

TEST(LightPlacement, StrengthFitsTheExposure) {
    CornellView v;
    const float before = lightBeforeCamera(v.state, LightKind::Point).strength;
    v.state.view.exposureEv = 3;
    EXPECT_NEAR(lightBeforeCamera(v.state, LightKind::Point).strength, before / 8,
                0.05f * before / 8);
    EXPECT_NEAR(lightBeforeCamera(v.state, LightKind::Directional).strength, 10.f / 8, 0.051f);
}

TEST(LightPlacement, AnEmptySceneStillGetsALamp) {
    EditorState state = emptyEditor();
    const Light light = lightAtPixel(state, LightKind::Rectangle, {10, 10});
    EXPECT_TRUE(std::isfinite(light.position.x) && std::isfinite(light.strength));
    EXPECT_GT(light.strength, 0);
    EXPECT_GT(light.size.x, 0);
}

TEST(LightPlacement, TheActionWaitsForAClick) {
    CornellView v;
    const std::size_t objects = v.state.document.objects.size();
    runAction(v.state, actionById("add.point"));
    v.ui.frames(v.state);
    EXPECT_EQ(v.state.document.objects.size(), objects);
    const glm::vec2 pixel = glm::floor(v.at(0.3f, 0.6f));
    v.ui.mouse(pixel.x, pixel.y);
    v.ui.button(true);
    v.ui.button(false);
    v.ui.frames(v.state);
    ASSERT_EQ(v.state.history.edits.size(), 1u);
    EXPECT_EQ(v.state.history.edits[0].label, "Add Point light");
    const Light expected = lightAtPixel(v.state, LightKind::Point, pixel);
    EXPECT_EQ(std::get<Light>(v.state.document.objects.at(activeId(v.state))).position,
              expected.position);
    EXPECT_FALSE(v.state.view.placing);
}

TEST(LightPlacement, EnterPlacesBeforeTheCameraAndEscapeAddsNothing) {
    CornellView v;
    runAction(v.state, actionById("add.spot"));
    v.ui.tap(key::kEscape);
    v.ui.frames(v.state);
    EXPECT_FALSE(v.state.view.placing);
    EXPECT_TRUE(v.state.history.edits.empty());
    v.ui.tap(key::kEnter);
    v.ui.frames(v.state);
    EXPECT_TRUE(v.state.history.edits.empty()); // nothing is being placed
    runAction(v.state, actionById("add.spot"));
    v.ui.tap(key::kEnter);
    v.ui.frames(v.state);
    ASSERT_EQ(v.state.history.edits.size(), 1u);
    EXPECT_EQ(v.state.history.edits[0].label, "Add Spot light");
}

} // namespace
} // namespace limn::light_placement_test
