// SPDX-License-Identifier: MIT
#include "engine/render/position_error.h"

#include "engine/scene/camera.h"

#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace limn::position_error_test {
namespace {

constexpr double kWidth = 320, kHeight = 180;
constexpr std::uint32_t kBits = 8;

/// From the picture's middle to its edges, 1 m deep; the view looks down -Z.
struct Picture {
    glm::dvec3 right, up;
};

Picture picture() {
    const Camera camera{.eye = {0, 0, 0}, .target = {0, 0, -1}, .fovY = 0.9f};
    const float aspect = float(kWidth / kHeight);
    const glm::vec3 centre = rayDirection(camera, aspect, 0, 0);
    return {rayDirection(camera, aspect, 1, 0) - centre,
            rayDirection(camera, aspect, 0, 1) - centre};
}

/// Pixel and depth of a point, and back.
glm::dvec3 toPixel(const Picture& v, glm::dvec3 p) {
    const double z = -p.z;
    return {0.5 * kWidth * (1 + p.x / (z * v.right.x)), 0.5 * kHeight * (1 - p.y / (z * v.up.y)),
            z};
}

glm::dvec3 toPoint(const Picture& v, glm::dvec2 pixel, double z) {
    return {(2 * pixel.x / kWidth - 1) * v.right.x * z, (1 - 2 * pixel.y / kHeight) * v.up.y * z,
            -z};
}

/// Depth of a triangle in a pixel: one over it is linear in the picture. Negative: not covered.
double rasterise(const std::array<glm::dvec3, 3>& corner, glm::dvec2 at) {
    const auto cross = [](glm::dvec2 a, glm::dvec2 b) { return a.x * b.y - a.y * b.x; };
    const glm::dvec2 a = corner[0], b = corner[1], c = corner[2];
    const double area = cross(b - a, c - a);
    const double u = cross(at - a, c - a) / area, w = cross(b - a, at - a) / area;
    if (!(u >= 0 && w >= 0 && u + w <= 1))
        return -1;
    return 1 / ((1 - u - w) / corner[0].z + u / corner[1].z + w / corner[2].z);
}

TEST(PositionError, BoundsWhatSnappedVerticesMove) {
    const Picture v = picture();
    const double bound =
        render::positionError(v.right, v.up, 1.f / glm::vec2(kWidth, kHeight), kBits);
    const double step = 1.0 / (1u << kBits);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0, 1);
    double most = 0;
    int covered = 0;
    for (int i = 0; i < 20000; ++i) {
        std::array<glm::dvec3, 3> point, corner;
        for (int k = 0; k < 3; ++k) {
            point[k] =
                toPoint(v, {kWidth * (2 * unit(random) - 0.5), kHeight * (2 * unit(random) - 0.5)},
                        1 + 9 * unit(random));
            corner[k] = toPixel(v, point[k]);
            corner[k].x = std::round(corner[k].x / step) * step;
            corner[k].y = std::round(corner[k].y / step) * step;
        }
        const glm::dvec2 at = {std::floor(kWidth * unit(random)) + 0.5,
                               std::floor(kHeight * unit(random)) + 0.5};
        const double z = rasterise(corner, at);
        if (z < 0)
            continue;
        const glm::dvec3 n = glm::normalize(glm::cross(point[1] - point[0], point[2] - point[0]));
        const double off = std::abs(glm::dot(toPoint(v, at, z) - point[0], n)) / z;
        ASSERT_LE(off, bound * (1 + 1e-6));
        most = std::max(most, off);
        ++covered;
    }
    EXPECT_GT(covered, 2000);
    EXPECT_GT(most, 0.5 * bound); // so the bound is no looser than it has to be
}

TEST(PositionError, HalvesWithEachBitAndWithTwiceThePixels) {
    const Picture v = picture();
    const glm::vec2 size(1 / 320.f, 1 / 180.f);
    const float e = render::positionError(v.right, v.up, size, kBits);
    EXPECT_FLOAT_EQ(render::positionError(v.right, v.up, size, kBits + 1), 0.5f * e);
    EXPECT_FLOAT_EQ(render::positionError(v.right, v.up, 0.5f * size, kBits), 0.5f * e);
}

} // namespace
} // namespace limn::position_error_test
