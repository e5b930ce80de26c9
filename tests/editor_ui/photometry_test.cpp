// SPDX-License-Identifier: MIT
#include "editor_ui/document/photometry.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/constants.hpp>
#include <gtest/gtest.h>

namespace limn::photometry_test {
namespace {

TEST(Photometry, TheFluxOfASpotIsTheIntegralOfWhatTheLightSends) {
    Light spot;
    spot.kind = LightKind::Spot;
    spot.direction = {0, -1, 0};
    spot.strength = 3;
    spot.innerAngle = 0.3f;
    spot.outerAngle = 0.9f;
    double sum = 0; // of I(theta) 2 pi sin(theta) over the cone, at 1 m
    constexpr int kSteps = 20000;
    for (int i = 0; i < kSteps; ++i) {
        const double theta = (i + 0.5) * double(spot.outerAngle) / kSteps;
        const glm::vec3 p(float(std::sin(theta)), float(-std::cos(theta)), 0);
        sum += double(sampleLight(spot, p).irradiance.x) * 2 * glm::pi<double>() * std::sin(theta) *
               double(spot.outerAngle) / kSteps;
    }
    EXPECT_NEAR(lumen(spot), sum, 1e-3 * sum);
}

TEST(Photometry, TheFluxOfARectangleIsPiTimesRadianceTimesArea) {
    Light light;
    light.kind = LightKind::Rectangle;
    light.size = {2, 0.5f};
    light.strength = 3;
    EXPECT_NEAR(lumen(light), 3 * glm::pi<float>(), 1e-5f);
    EXPECT_NEAR(strengthForLumen(light, 6 * glm::pi<float>()), 6, 1e-5f);
}

TEST(Photometry, APointLightOfOneCandelaHasFourPiLumen) {
    Light point;
    point.strength = 1;
    EXPECT_FLOAT_EQ(lumen(point), 4 * glm::pi<float>());
    EXPECT_FLOAT_EQ(strengthForLumen(point, lumen(point)), 1);
}

TEST(Photometry, BlackBodiesAreRedThenWhiteThenBlue) {
    const glm::vec3 candle = blackbodyColor(1900), day = blackbodyColor(6500),
                    sky = blackbodyColor(15000);
    EXPECT_EQ(candle.x, 1);
    EXPECT_LT(candle.z, 0.05f);
    EXPECT_NEAR(day.y, 1, 0.06f); // D65 is white and lies close to the curve
    EXPECT_NEAR(day.x, 1, 0.06f);
    EXPECT_NEAR(day.z, 1, 0.06f);
    EXPECT_EQ(sky.z, 1);
    EXPECT_LT(sky.x, 0.8f);
}

TEST(Photometry, TheNearestTemperatureOfABlackBodyIsItsOwn) {
    for (float kelvin : {1800.f, 2700.f, 4000.f, 6500.f, 12000.f})
        EXPECT_NEAR(nearestKelvin(blackbodyColor(kelvin) * 7.f), kelvin, 0.012f * kelvin);
    EXPECT_EQ(nearestKelvin({0, 0, 0}), 6500);
}

} // namespace
} // namespace limn::photometry_test
