// SPDX-License-Identifier: MIT
#include "engine/scene/light/light.h"
#include "engine/scene/light/light_spec.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

namespace limn::light_test {
namespace {

Light pointLight() {
    Light light;
    light.kind = LightKind::Point;
    light.position = {1, 2, 3};
    light.color = {1, 0.5f, 0.25f};
    light.strength = 100;
    return light;
}

TEST(SampleLight, APointLightFallsWithTheSquareOfTheDistance) {
    const Light light = pointLight();
    for (const float d : {0.1f, 1.f, 2.f, 30.f}) {
        const LightSample s = sampleLight(light, light.position + glm::vec3(0, 0, d));
        EXPECT_NEAR(s.irradiance.x, 100 / (d * d), 1e-4f * 100 / (d * d));
        EXPECT_NEAR(s.irradiance.z, 25 / (d * d), 1e-4f * 100 / (d * d));
        EXPECT_NEAR(s.distance, d, 1e-5f * d + 1e-6f);
        EXPECT_NEAR(s.toLight.z, -1, 1e-5f);
    }
}

TEST(SampleLight, APointLightGrowsDownTo10NmAndToTheMostIrradiance) {
    Light light = pointLight();
    light.position = {};
    const auto at = [&](float d) { return sampleLight(light, {d, 0, 0}).irradiance; };
    EXPECT_FLOAT_EQ(at(1e-7f).x, 1e16f);
    EXPECT_FLOAT_EQ(at(1e-8f).x, 1e18f);
    EXPECT_EQ(at(1e-9f), at(1e-8f));
    light.strength = kMaxLight;
    light.color = {kMaxLight, 1, 0};
    EXPECT_EQ(at(1e-8f).x, kMaxIrradiance);
    EXPECT_FLOAT_EQ(at(1e-8f).y, 1e26f);
    EXPECT_EQ(at(1e-8f).z, 0);
}

TEST(SampleLight, TheRangeWindowIsThatOfTheExtension) {
    Light light = pointLight();
    light.position = {};
    light.range = 2;
    const auto at = [&](float d) { return sampleLight(light, {d, 0, 0}).irradiance.x; };
    EXPECT_FLOAT_EQ(at(1), 100 * (1 - 1.f / 16));
    EXPECT_FLOAT_EQ(at(1.5f), 100 / 2.25f * (1 - 0.31640625f));
    EXPECT_EQ(at(2), 0);
    EXPECT_EQ(at(50), 0);
}

TEST(SampleLight, ASpotIsFullInsideItsInnerConeAndDarkOutsideItsOuter) {
    Light light = pointLight();
    light.kind = LightKind::Spot;
    light.position = {};
    light.direction = {0, -1, 0};
    light.color = glm::vec3(1);
    light.innerAngle = glm::radians(20.f);
    light.outerAngle = glm::radians(40.f);
    const auto at = [&](float degrees) {
        const float a = glm::radians(degrees);
        return sampleLight(light, {std::sin(a), -std::cos(a), 0}).irradiance.x;
    };
    EXPECT_NEAR(at(0), 100, 1e-3);
    EXPECT_NEAR(at(19.9f), 100, 1e-3);
    EXPECT_EQ(at(40.1f), 0);
    EXPECT_EQ(at(180), 0);
    // Between them the square of the linear ramp of the cosine.
    const double ramp = (std::cos(0.5) - std::cos(glm::radians(40.0))) /
                        (std::cos(glm::radians(20.0)) - std::cos(glm::radians(40.0)));
    EXPECT_NEAR(at(glm::degrees(0.5f)), 100 * ramp * ramp, 1e-2);
}

TEST(SampleLight, ASunIsTheSameEverywhere) {
    Light light;
    light.kind = LightKind::Directional;
    light.direction = {0, -0.6f, -0.8f};
    light.strength = 5;
    for (const glm::vec3 p : {glm::vec3(0), glm::vec3(1e6f, 3, -9)}) {
        const LightSample s = sampleLight(light, p);
        EXPECT_EQ(s.irradiance, glm::vec3(5));
        EXPECT_EQ(s.toLight, glm::vec3(0, 0.6f, 0.8f));
        EXPECT_TRUE(std::isinf(s.distance));
    }
}

TEST(SampleLight, NothingComesFromALightThatIsOffOrAtThePointItself) {
    Light light = pointLight();
    EXPECT_EQ(sampleLight(light, light.position).irradiance, glm::vec3(0));
    light.enabled = false;
    EXPECT_EQ(sampleLight(light, {}).irradiance, glm::vec3(0));
}

TEST(LightSpec, ReadsEveryKindWithItsFields) {
    const Result<Light> sun = parseLight("sun dir=0,-2,0 lux=12.5 color=1,0.5,0 name=Noon");
    ASSERT_TRUE(sun) << sun.error().message;
    EXPECT_EQ(sun->kind, LightKind::Directional);
    EXPECT_EQ(sun->direction, glm::vec3(0, -1, 0));
    EXPECT_EQ(sun->strength, 12.5f);
    EXPECT_EQ(sun->color, glm::vec3(1, 0.5f, 0));
    EXPECT_EQ(sun->name, "Noon");
    const Result<Light> point = parseLight("point  pos=1,-2,3e1 cd=7 range=4");
    ASSERT_TRUE(point) << point.error().message;
    EXPECT_EQ(point->kind, LightKind::Point);
    EXPECT_EQ(point->position, glm::vec3(1, -2, 30));
    EXPECT_EQ(point->strength, 7);
    EXPECT_EQ(point->range, 4);
    const Result<Light> spot = parseLight("spot pos=0,1,0 dir=1,0,0 cd=1 inner=10 outer=90");
    ASSERT_TRUE(spot) << spot.error().message;
    EXPECT_EQ(spot->kind, LightKind::Spot);
    EXPECT_NEAR(spot->innerAngle, 0.174533f, 1e-6f);
    EXPECT_NEAR(spot->outerAngle, 1.570796f, 1e-6f);
    const Result<Light> rect =
        parseLight("rect pos=1,2,3 dir=0,0,-4 size=2,0.5 nits=9 roll=90 color=1,0,1 name=Panel");
    ASSERT_TRUE(rect) << rect.error().message;
    EXPECT_EQ(rect->kind, LightKind::Rectangle);
    EXPECT_EQ(rect->position, glm::vec3(1, 2, 3));
    EXPECT_EQ(rect->direction, glm::vec3(0, 0, -1));
    EXPECT_EQ(rect->size, glm::vec2(2, 0.5f));
    EXPECT_EQ(rect->strength, 9);
    EXPECT_NEAR(rect->roll, 1.570796f, 1e-6f);
    EXPECT_EQ(rect->color, glm::vec3(1, 0, 1));
    EXPECT_EQ(rect->name, "Panel");
}

TEST(LightSpec, NamesTheWordItDoesNotUnderstand) {
    const std::pair<const char*, const char*> cases[] = {{"", "empty"},
                                                         {"lamp pos=0,0,0", "'lamp'"},
                                                         {"sun", nullptr},
                                                         {"sun pos=1,2,3", "'pos=1,2,3'"},
                                                         {"sun lux=bright", "'bright'"},
                                                         {"sun lux=1x", "'1x'"},
                                                         {"sun lux=nan", "'nan'"},
                                                         {"sun lux=1e99", "'1e99'"},
                                                         {"sun lux=-1", "negative"},
                                                         {"sun lux=2e10", "more than 1e+10"},
                                                         {"sun color=1,3e38,1", "more than 1e+10"},
                                                         {"sun dir=0,0,0", "zero"},
                                                         {"sun dir=0,1", "three numbers"},
                                                         {"point cd", "'cd'"},
                                                         {"point dir=0,1,0", "'dir=0,1,0'"},
                                                         {"point lux=1", "'lux=1'"},
                                                         {"point color=1,-1,1", "negative"},
                                                         {"spot inner=30 outer=30", "inner"},
                                                         {"spot outer=91", "90"},
                                                         {"spot size=1,1", "'size=1,1'"},
                                                         {"rect lux=1", "'lux=1'"},
                                                         {"sun lm=1", "'lm=1'"},
                                                         {"sun ev=99", "more than 1e+10"},
                                                         {"point kelvin=99", "'kelvin=99'"},
                                                         {"point roll=3", "'roll=3'"},
                                                         {"rect range=1", "'range=1'"},
                                                         {"rect size=1", "two numbers"},
                                                         {"rect size=0,1", "'size=0,1'"},
                                                         {"rect size=1,-1", "'size=1,-1'"},
                                                         {"rect size=1e7,1", "'size=1e7,1'"},
                                                         {"rect size=nan,1", "'nan'"},
                                                         {"rect nits=-1", "negative"},
                                                         {"rect roll=x", "'x'"},
                                                         {"rect dir=0,0,0", "zero"}};
    for (const auto& [spec, reason] : cases) {
        const Result<Light> light = parseLight(spec);
        EXPECT_EQ(bool(light), reason == nullptr) << spec;
        if (!light && reason) {
            EXPECT_NE(light.error().message.find(reason), std::string::npos)
                << light.error().message;
        }
    }
}

TEST(LightSpec, ASkyIsThreeNumbersThatAreNotNegative) {
    EXPECT_EQ(parseSky("0.5,1,2")->radiance, glm::vec3(0.5f, 1, 2));
    for (const char* bad : {"", "1", "1,2", "1,2,3,4", "1,2,-3", "a,b,c"})
        EXPECT_FALSE(parseSky(bad)) << bad;
}

} // namespace
} // namespace limn::light_test
