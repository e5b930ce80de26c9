// SPDX-License-Identifier: MIT
#include "engine/shading/sky_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace limn {

static constexpr double kPi = std::numbers::pi;

static double brightness(glm::vec3 radiance) {
    return (double(radiance.x) + double(radiance.y) + double(radiance.z)) / 3;
}

SkyLight findSkyLight(const Sky& sky) {
    SkyLight light;
    if (!sky.showsImage())
        return light;
    const ImageF& image = sky.panorama->pixels;
    light.rows.resize(image.height);
    light.columns.resize(image.rgb.size());
    double sum = 0; // of brightness times solid angle, over pixels
    for (std::uint32_t row = 0; row < image.height; ++row) {
        const double height =
            std::cos(kPi * row / image.height) - std::cos(kPi * (row + 1) / image.height);
        const std::size_t first = std::size_t(row) * image.width;
        double across = 0;
        for (std::uint32_t x = 0; x < image.width; ++x)
            light.columns[first + x] =
                float(across += double(sky.strength) * brightness(image.rgb[first + x]));
        for (std::uint32_t x = 0; x < image.width && across > 0; ++x)
            light.columns[first + x] = float(double(light.columns[first + x]) / across);
        light.rows[row] = sum += across * height * 2 * kPi / image.width;
    }
    light.total = sum;
    if (!(sum > 0))
        return {};
    for (double& row : light.rows)
        row /= sum;
    return light;
}

/// The step of a cdf that contains `u`, and the position within it in [0, 1).
template <class Iterator>
static std::pair<std::size_t, double> invert(Iterator begin, Iterator end, double u) {
    const auto found = std::min(std::upper_bound(begin, end, u), end - 1);
    const double lower = found == begin ? 0.0 : double(*(found - 1)),
                 width = double(*found) - lower;
    return {std::size_t(found - begin),
            width > 0 ? std::clamp((u - lower) / width, 0.0, 1.0) : 0.5};
}

SkySample sampleSky(const SkyLight& light, const Sky& sky, glm::vec2 u) {
    const ImageF& image = sky.panorama->pixels;
    const auto [row, down] = invert(light.rows.begin(), light.rows.end(), double(u.x));
    const auto first = light.columns.begin() + std::ptrdiff_t(row * image.width);
    const auto [column, right] = invert(first, first + std::ptrdiff_t(image.width), double(u.y));
    // A point that is uniform in height across the pixel is uniform in solid angle.
    const double upper = std::cos(kPi * double(row) / image.height),
                 lower = std::cos(kPi * double(row + 1) / image.height);
    const double y = upper + down * (lower - upper), r = std::sqrt(std::max(1 - y * y, 0.0));
    const double azimuth =
        2 * kPi * ((double(column) + right) / image.width - 0.75) - double(sky.rotation);
    SkySample s;
    s.direction = glm::vec3(r * std::cos(azimuth), y, r * std::sin(azimuth));
    s.radiance = sky.strength * image.rgb[row * image.width + column];
    s.pdf = skyPdf(light, s.radiance);
    return s;
}

float skyPdf(const SkyLight& light, glm::vec3 radiance) {
    return light.empty() ? 0 : float(brightness(radiance) / light.total);
}

} // namespace limn
