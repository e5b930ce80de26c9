// SPDX-License-Identifier: MIT
#include "engine/scene/light/photometry.h"

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

TEST(Photometry, StrengthsConvertBetweenUnits) {
    Light point, sun, panel;
    sun.kind = LightKind::Directional;
    panel.kind = LightKind::Rectangle;
    panel.size = {2, 0.5f};
    EXPECT_FLOAT_EQ(*strengthFrom(4 * glm::pi<float>(), LightUnit::Lumen, point), 1);
    EXPECT_FLOAT_EQ(*strengthFrom(0, LightUnit::Ev100, sun), 2.5f);
    EXPECT_FLOAT_EQ(*strengthFrom(15, LightUnit::Ev100, sun), 81920); // the sun at noon, nearly
    EXPECT_FLOAT_EQ(*strengthFrom(3, LightUnit::Ev100, panel), 1);
    EXPECT_FLOAT_EQ(*strengthFrom(7, LightUnit::Candela, panel), 7);
    EXPECT_FLOAT_EQ(*strengthFrom(-3, LightUnit::Ev100, panel), 0.125f / 8);
    for (const Light& light : {point, sun, panel})
        for (const LightUnit unit : unitsOf(light.kind))
            EXPECT_NEAR(*strengthFrom(strengthIn(unit, light), unit, light), light.strength,
                        1e-4f * light.strength)
                << nameOf(unit);
    EXPECT_FALSE(strengthFrom(1, LightUnit::Lux, point));
    EXPECT_FALSE(strengthFrom(1, LightUnit::Lumen, sun));
    EXPECT_FALSE(strengthFrom(-1, LightUnit::Candela, point));
    EXPECT_FALSE(strengthFrom(60, LightUnit::Ev100, sun));
    EXPECT_FALSE(strengthFrom(2e11f, LightUnit::Lumen, point));
}

TEST(Photometry, UnderstandsWhatPeopleType) {
    const auto typed = [](const char* text, Light light) {
        const Result<void> applied = applyTyped(text, light);
        EXPECT_TRUE(applied) << text << ": " << applied.error().message;
        return light;
    };
    const Light point;
    Light sun;
    sun.kind = LightKind::Directional;
    EXPECT_FLOAT_EQ(typed("12.5", point).strength, 12.5f);
    EXPECT_FLOAT_EQ(typed(" 3 cd ", point).strength, 3);
    EXPECT_FLOAT_EQ(typed("800 lm", point).strength, 800 / (4 * glm::pi<float>()));
    EXPECT_FLOAT_EQ(typed("800LM", point).strength, 800 / (4 * glm::pi<float>()));
    EXPECT_FLOAT_EQ(typed("1e4lx", sun).strength, 1e4f);
    EXPECT_FLOAT_EQ(typed("-1 EV", sun).strength, 1.25f);
    EXPECT_EQ(typed("2700K", point).color, blackbodyColor(2700));
    const Light both = typed("800 lm, 2700 K", point);
    EXPECT_FLOAT_EQ(both.strength, 800 / (4 * glm::pi<float>()));
    EXPECT_EQ(both.color, blackbodyColor(2700));

    for (const char* bad : {"", "  ", "bright", "3 candles", "3 lux", "-3 cd", "nan cd", "900 K",
                            "3 cd 900 K", "inf", "3 cd cd"}) {
        Light light;
        EXPECT_FALSE(applyTyped(bad, light)) << bad;
        EXPECT_EQ(light, Light()) << bad;
    }
}

} // namespace
} // namespace limn::photometry_test
