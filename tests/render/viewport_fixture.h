// SPDX-License-Identifier: MIT
#pragma once

#include "engine/render/viewport.h"
#include "tests/gpu/test_device.h"
#include "tests/trace/simple_scene.h"

#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include <glm/gtc/matrix_transform.hpp>

namespace limn {

constexpr float kPi = std::numbers::pi_v<float>;
/// Of itself, what rounding to halfs changes a coefficient of bounced light by at most.
constexpr float kHalf = 0x1p-11f;

/// A viewport on a validated device.
class ViewportTest : public DeviceTest {
protected:
    void SetUp() override {
        DeviceTest::SetUp();
        if (device)
            viewport = std::make_unique<Viewport>(*device);
    }
    void TearDown() override {
        viewport.reset();
        DeviceTest::TearDown();
    }

    ImageF draw(const Scene& scene, View view) {
        options.view = view;
        viewport->setScene(scene, layout);
        viewport->render(options);
        return viewport->readLinear();
    }

    /// Square pictures from above, y = 5, of the plane y = 0.
    ViewportOptions options{
        .camera = {.eye = {0, 5, 0}, .target = {0, 0, 0}, .fovY = 0.7f}, .width = 32, .height = 32};
    std::shared_ptr<LightmapLayout> layout;
    std::unique_ptr<Viewport> viewport;
};

/// Where the ray through the middle of pixel (x, y) meets the plane y = height.
inline glm::vec3 planePoint(const ViewportOptions& o, std::uint32_t x, std::uint32_t y,
                            float height = 0) {
    const float aspect = float(o.width) / float(o.height);
    const glm::vec3 d = rayDirection(o.camera, aspect, 2 * (float(x) + 0.5f) / float(o.width) - 1,
                                     1 - 2 * (float(y) + 0.5f) / float(o.height));
    return o.camera.eye + d * ((height - o.camera.eye.y) / d.y);
}

inline glm::vec3 pixel(const ImageF& image, std::uint32_t x, std::uint32_t y) {
    return image.rgb[std::size_t(y) * image.width + x];
}

/// The plane y = 0, 20 m wide, facing up, of albedo (0.2, 0.4, 0.8) unless told.
inline simple::SceneBuilder plane(glm::vec3 albedo = {0.2f, 0.4f, 0.8f}) {
    simple::SceneBuilder b;
    b.addMaterial(simple::lambert(albedo));
    b.add(simple::quad({-10, 0, 10}, {20, 0, 0}, {0, 0, -20}));
    return b;
}

inline void expectNear(glm::vec3 value, glm::vec3 expected, float relative,
                       const char* where = "") {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(value[c], expected[c], relative * std::max(std::abs(expected[c]), 1e-6f))
            << where << " channel " << c;
}

} // namespace limn
