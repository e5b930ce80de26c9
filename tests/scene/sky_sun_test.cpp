// SPDX-License-Identifier: MIT
#include "engine/scene/sky_sun.h"

#include <gtest/gtest.h>

#include <cmath>

#include <glm/geometric.hpp>

namespace limn::sky_sun_test {
namespace {

/// A sky of radiance 1 with a disc of 2 degrees' diameter around `towards`, before rotation.
Sky skyWithSun(glm::vec3 towards, glm::vec3 radiance, float rotation = 0) {
    ImageF image{1440, 720, std::vector<glm::vec3>(1440 * 720, glm::vec3(1))};
    for (std::uint32_t y = 0; y < image.height; ++y)
        for (std::uint32_t x = 0; x < image.width; ++x) {
            const float polar = 3.14159265f * (float(y) + 0.5f) / 720,
                        azimuth = 2 * 3.14159265f * ((float(x) + 0.5f) / 1440 - 0.75f);
            const glm::vec3 d(std::sin(polar) * std::cos(azimuth), std::cos(polar),
                              std::sin(polar) * std::sin(azimuth));
            if (glm::dot(d, towards) > std::cos(3.14159265f / 180))
                image.rgb[y * image.width + x] = radiance;
        }
    Sky sky{.kind = SkyKind::Image, .image = "x.hdr", .rotation = rotation};
    sky.panorama = makeSkyImage(std::move(image));
    return sky;
}

TEST(SkySun, BecomesALightOfTheSameIrradiance) {
    const glm::vec3 towards = glm::normalize(glm::vec3(0.3f, 0.8f, -0.5f));
    Sky sky = skyWithSun(towards, {4001, 2001, 1001});
    sky.strength = 2;
    const std::optional<Light> sun = extractSun(sky);
    ASSERT_TRUE(sun);
    EXPECT_EQ(sun->kind, LightKind::Directional);
    EXPECT_GT(glm::dot(sun->direction, -towards), std::cos(0.002f));
    // A disc of half-angle a and radiance L has the irradiance pi L sin^2 a.
    const float disc = 3.14159265f * std::pow(std::sin(3.14159265f / 180), 2.f);
    const glm::vec3 E = sun->color * sun->strength;
    EXPECT_NEAR(E.x, 2 * 4000 * disc, 0.02f * 8000 * disc);
    EXPECT_NEAR(E.y / E.x, 0.5f, 1e-3f);
    EXPECT_NEAR(E.z / E.x, 0.25f, 1e-3f);
    for (const glm::vec3& p : sky.panorama->pixels.rgb)
        ASSERT_NEAR(p.x, 1, 1e-4f);
    EXPECT_NE(sky.image, "x.hdr");
    EXPECT_FALSE(extractSun(sky)); // it is gone
}

/// The light comes from where the rotated sky shows it.
TEST(SkySun, TurnsWithItsSky) {
    for (const float rotation : {0.f, 1.f, -2.5f}) {
        Sky sky = skyWithSun(glm::normalize(glm::vec3(1, 1, 0.2f)), glm::vec3(5000), rotation);
        const Sky before = sky;
        const std::optional<Light> sun = extractSun(sky);
        ASSERT_TRUE(sun);
        EXPECT_EQ(skyRadiance(before, -sun->direction), glm::vec3(5000)) << rotation;
        EXPECT_NEAR(skyRadiance(sky, -sun->direction).x, 1, 1e-4f);
    }
}

TEST(SkySun, IsNotFoundWhereThereIsNone) {
    Sky even = skyWithSun({0, 1, 0}, glm::vec3(1)), weak = skyWithSun({0, 1, 0}, glm::vec3(60)),
        plain{.radiance = {1, 1, 1}};
    EXPECT_FALSE(extractSun(even));
    EXPECT_FALSE(extractSun(weak)); // a hundredth of the light
    EXPECT_FALSE(extractSun(plain));
    EXPECT_EQ(even.image, "x.hdr");
}

} // namespace
} // namespace limn::sky_sun_test
