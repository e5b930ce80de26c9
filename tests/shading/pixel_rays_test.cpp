// SPDX-License-Identifier: MIT
#include "engine/shading/pixel_rays.h"

#include <gtest/gtest.h>

#include <cmath>

namespace limn::pixel_rays_test {

// A pinhole that looks along -Z with +Y up: the picture's plane at distance 1 reaches from -t to t
// upwards and from -a t to a t to the right, where t is the tangent of half the field of view and a
// the aspect ratio.
TEST(PixelRays, AreThoseOfAPinhole) {
    const Camera camera{.eye = {1, 2, 3}, .target = {1, 2, -4}, .fovY = 0.8f};
    const PixelRays rays(camera, 300, 200);
    const float t = std::tan(0.4f), a = 1.5f;
    const auto expectRay = [&](glm::vec2 pixel, glm::vec3 through) {
        const Ray ray = rays.through(pixel);
        EXPECT_EQ(ray.origin, camera.eye);
        EXPECT_LT(glm::length(ray.direction - glm::normalize(through)), 1e-6f);
    };
    expectRay({0, 0}, {-a * t, t, -1}); // the upper left corner
    expectRay({300, 200}, {a * t, -t, -1});
    expectRay({150, 100}, {0, 0, -1});
    expectRay({225, 100}, {a * t / 2, 0, -1});
    expectRay({150, 50}, {0, t / 2, -1});
}

} // namespace limn::pixel_rays_test
