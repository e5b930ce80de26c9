// SPDX-License-Identifier: MIT
#include "engine/scene/sky_sun.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr double kPi = std::numbers::pi;
/// Angles around the brightest direction [rad]: the sun with its glow lies within the first, and
/// the sky around it between the others.
constexpr double kSunRadius = 3 * kPi / 180, kRingBegin = 4 * kPi / 180, kRingEnd = 8 * kPi / 180;
/// A sun is so many times as bright as the ring, and brings this share of the sky's light.
constexpr double kSunContrast = 10, kMinSunShare = 0.05;

double grey(glm::dvec3 c) {
    return (c.x + c.y + c.z) / 3;
}

/// A panorama's pixels with their directions, before it is rotated, and solid angles [sr].
struct Panorama {
    const ImageF& image;

    glm::dvec3 direction(std::uint32_t x, std::uint32_t y) const {
        const double polar = kPi * (y + 0.5) / image.height,
                     azimuth = 2 * kPi * ((x + 0.5) / image.width - 0.75);
        return {std::sin(polar) * std::cos(azimuth), std::cos(polar),
                std::sin(polar) * std::sin(azimuth)};
    }
    double solidAngle(std::uint32_t y) const {
        return 2 * kPi / image.width *
               (std::cos(kPi * y / image.height) - std::cos(kPi * (y + 1) / image.height));
    }
    glm::dvec3 radiance(std::size_t pixel) const { return glm::dvec3(image.rgb[pixel]); }
    /// Calls visit(pixel, direction, solid angle) for each.
    template <class Visit>
    void forEach(const Visit& visit) const {
        for (std::uint32_t y = 0; y < image.height; ++y)
            for (std::uint32_t x = 0; x < image.width; ++x)
                visit(std::size_t(y) * image.width + x, direction(x, y), solidAngle(y));
    }
};

/// What is cut out of a panorama.
struct Sun {
    glm::dvec3 around{0};     ///< mean radiance of the ring
    glm::dvec3 irradiance{0}; ///< on a plane that faces it
    glm::dvec3 direction{0};  ///< unit, towards it
    std::vector<std::size_t> pixels;
};

std::optional<Sun> findSun(const Panorama& panorama) {
    const auto brightest = std::size_t(
        std::ranges::max_element(panorama.image.rgb, {}, [](glm::vec3 c) { return grey(c); }) -
        panorama.image.rgb.begin());
    const auto middle = panorama.direction(std::uint32_t(brightest % panorama.image.width),
                                           std::uint32_t(brightest / panorama.image.width));
    Sun sun;
    double ring = 0, all = 0;
    panorama.forEach([&](std::size_t p, const glm::dvec3& d, double solidAngle) {
        all += grey(panorama.radiance(p)) * solidAngle;
        const double angle = std::acos(std::clamp(glm::dot(d, middle), -1., 1.));
        if (angle >= kRingBegin && angle < kRingEnd) {
            sun.around += panorama.radiance(p) * solidAngle;
            ring += solidAngle;
        }
    });
    if (!(ring > 0)) // pixels are wider than the ring
        return {};
    sun.around /= ring;
    glm::dvec3 towards(0);
    double power = 0;
    panorama.forEach([&](std::size_t p, const glm::dvec3& d, double solidAngle) {
        const glm::dvec3 excess = panorama.radiance(p) - sun.around;
        const bool isNear = glm::dot(d, middle) > std::cos(kSunRadius);
        if (!isNear || !(grey(excess) > (kSunContrast - 1) * grey(sun.around)))
            return;
        towards += grey(excess) * solidAngle * d;
        power += grey(excess) * solidAngle;
        sun.irradiance += glm::max(excess, glm::dvec3(0)) * solidAngle;
        sun.pixels.push_back(p);
    });
    if (!(power > kMinSunShare * all))
        return {};
    sun.direction = glm::normalize(towards);
    // A plane that faces the middle sees pixels beside it under their cosines.
    sun.irradiance *= glm::length(towards) / power;
    return sun;
}

} // namespace

std::optional<Light> extractSun(Sky& sky) {
    if (!sky.showsImage())
        return {};
    ImageF image = sky.panorama->pixels;
    const std::optional<Sun> sun = findSun({image});
    if (!sun)
        return {};
    for (const std::size_t p : sun->pixels)
        image.rgb[p] = glm::vec3(sun->around);
    sky.panorama = makeSkyImage(std::move(image));
    sky.image += kWithoutSun;
    Light light{.name = "Sun", .kind = LightKind::Directional};
    const double c = std::cos(double(sky.rotation)), s = std::sin(double(sky.rotation));
    const glm::dvec3 d = sun->direction;
    light.direction = -glm::vec3(glm::dvec3(c * d.x + s * d.z, d.y, c * d.z - s * d.x));
    const double strongest = std::max({sun->irradiance.x, sun->irradiance.y, sun->irradiance.z});
    light.color = glm::vec3(sun->irradiance / strongest);
    light.strength = float(std::min(strongest * double(sky.strength), double(kMaxLight)));
    return light;
}

} // namespace limn
