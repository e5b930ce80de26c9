// SPDX-License-Identifier: MIT
#include "editor_ui/document/light_angles.h"
#include "engine/scene/light/light.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace limn::light_angles_test {
namespace {

TEST(LightAngles, AreRecoveredFromTheirDirection) {
    for (const float elevation : {-89.f, -40.f, 0.f, 12.5f, 89.f})
        for (const float azimuth : {-170.f, -90.f, 0.f, 45.f, 179.f}) {
            const LightAngles angles = lightAngles(lightDirection({elevation, azimuth}));
            EXPECT_NEAR(angles.elevation, elevation, 0.01f);
            EXPECT_NEAR(angles.azimuth, azimuth, 0.01f);
        }
}

TEST(LightAngles, OfASunInTheEastPointWest) {
    const glm::vec3 direction = lightDirection({30, 90}); // from +X
    EXPECT_NEAR(direction.x, -0.866025f, 1e-5f);
    EXPECT_NEAR(direction.y, -0.5f, 1e-5f);
    EXPECT_NEAR(direction.z, 0, 1e-5f);
}

TEST(LightAngles, OfANewLightThatShinesStraightDownHaveNoAzimuth) {
    const LightAngles angles = lightAngles(Light{}.direction);
    EXPECT_EQ(angles.elevation, 90);
    EXPECT_EQ(angles.azimuth, 0);
}

TEST(LightAngles, AnAzimuthThatIsSetAtTheZenithStays) {
    LightAngles angles = lightAngles({0, -1, 0});
    angles.azimuth = 60;
    EXPECT_NEAR(lightAngles(lightDirection(angles)).azimuth, 60, 0.1f);
}

} // namespace
} // namespace limn::light_angles_test
