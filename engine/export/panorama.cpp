// SPDX-License-Identifier: MIT
#include "engine/export/panorama.h"

#include "engine/core/parallel.h"
#include "engine/export/probe_cube.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/vec2.hpp>

namespace limn {

namespace {

constexpr std::uint32_t kMaxHeight = 512;

/// Direction at a place of the image, in [0, 1]^2 from its upper left corner.
glm::vec3 directionAt(double x, double y) {
    const double turn = 2 * std::numbers::pi * (x - 0.5), down = std::numbers::pi * y;
    return {std::sin(down) * std::cos(turn), std::cos(down), std::sin(down) * std::sin(turn)};
}

/// Rows that show all of the sky; columns are as many for a gradient as engines like, and twice as
/// many for an image.
glm::uvec2 sizeFor(const Sky& sky) {
    if (sky.showsImage()) {
        const std::uint32_t height =
            std::clamp(sky.panorama->pixels.height, 2U, kMaxHeight) / 2 * 2;
        return {2 * height, height};
    }
    return sky.kind == SkyKind::Gradient ? glm::uvec2(8, 256) : glm::uvec2(4, 2);
}

bool isBlack(const ImageF& image) {
    return std::ranges::all_of(image.rgb, [](glm::vec3 v) { return v == glm::vec3(0); });
}

} // namespace

glm::vec3 panoramaDirection(std::uint32_t width, std::uint32_t height, std::size_t pixel) {
    return directionAt((double(pixel % width) + 0.5) / width,
                       (double(pixel / width) + 0.5) / height);
}

ImageF skyPanorama(const Sky& sky) {
    const glm::uvec2 size = sizeFor(sky);
    ImageF image{size.x, size.y, {}};
    image.rgb.resize(std::size_t(size.x) * size.y);
    // The panorama may have more pixels: each of these is the mean of a few.
    const std::uint32_t side =
        sky.showsImage() ? (sky.panorama->pixels.height + size.y - 1) / size.y : 1;
    parallelRanges(image.rgb.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t pixel = begin; pixel < end; ++pixel) {
            glm::dvec3 sum(0);
            for (std::uint32_t k = 0; k < side * side; ++k) {
                const double x = double(pixel % size.x) + (k % side + 0.5) / side;
                const double y = double(pixel / size.x) + (k / side + 0.5) / side;
                sum += glm::dvec3(skyRadiance(sky, directionAt(x / size.x, y / size.y)));
            }
            image.rgb[pixel] = glm::vec3(sum / double(side * side));
        }
    });
    return isBlack(image) ? ImageF{} : image;
}

ImageF panoramaSeenFrom(const ExportScene& scene, glm::vec3 p, std::uint32_t width,
                        std::uint32_t height, const Progress& progress) {
    ImageF image{width, height, {}};
    image.rgb.resize(std::size_t(width) * height);
    parallelRanges(
        image.rgb.size(), 64, progress, "reflections", [&](std::size_t begin, std::size_t end) {
            for (std::size_t k = begin; k < end; ++k)
                image.rgb[k] = radianceSeen(scene, p, panoramaDirection(width, height, k));
        });
    return image;
}

} // namespace limn
