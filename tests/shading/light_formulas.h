// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/light/light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

// Irradiance by formulas that are written out here in double precision and call no code of the
// engine, so that they tell whether light that the engine computes is right.
namespace limn::formulas {

inline constexpr double kPi = std::numbers::pi;

/// Irradiance at `p` on a plane with unit normal `n` from a directional, point or spot light of
/// white colour: E cos, or I cos / r^2 times the range window and the squared ramp of the cone that
/// KHR_lights_punctual defines.
inline double punctualIrradiance(const Light& light, glm::dvec3 p, glm::dvec3 n) {
    const glm::dvec3 axis(light.direction);
    if (light.kind == LightKind::Directional)
        return double(light.strength) * std::max(0.0, -glm::dot(axis, n));
    const glm::dvec3 way = glm::dvec3(light.position) - p;
    const double r = glm::length(way), cosTheta = std::max(0.0, glm::dot(way, n) / r);
    double E = double(light.strength) * cosTheta / (r * r);
    if (light.range > 0)
        E *= std::clamp(1 - std::pow(r / double(light.range), 4), 0.0, 1.0);
    if (light.kind == LightKind::Spot) {
        const double inner = std::cos(double(light.innerAngle)),
                     outer = std::cos(double(light.outerAngle)),
                     ramp = (glm::dot(-way, axis) / r - outer) / (inner - outer);
        E *= std::pow(std::clamp(ramp, 0.0, 1.0), 2);
    }
    return E;
}

/// Irradiance per unit of radiance at the origin, on a plane with unit normal `n`, from a polygon
/// of which all is above that plane: half the sum over its edges of the angle that the edge takes
/// times the cosine between `n` and the edge's plane.
/// Lambert. Photometria. 1760
inline double polygonIrradiance(std::span<const glm::dvec3> corners, glm::dvec3 n) {
    double sum = 0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 a = glm::normalize(corners[i]),
                         b = glm::normalize(corners[(i + 1) % corners.size()]);
        sum += std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0)) *
               glm::dot(n, glm::normalize(glm::cross(a, b)));
    }
    return std::abs(sum) / 2;
}

/// Corners of a light of kind Rectangle, relative to `p`. Its width is horizontal, or along +X if
/// it shines straight up or down; a roll turns the width towards cross(width, direction).
inline std::array<glm::dvec3, 4> cornersOf(const Light& light, glm::dvec3 p) {
    const glm::dvec3 axis(light.direction);
    const bool vertical = axis.x == 0 && axis.z == 0;
    const glm::dvec3 level =
        vertical ? glm::dvec3(1, 0, 0) : glm::normalize(glm::dvec3(-axis.z, 0, axis.x));
    const glm::dvec3 across = glm::cross(level, axis);
    const double c = std::cos(double(light.roll)), s = std::sin(double(light.roll));
    const glm::dvec3 u = (c * level + s * across) * (double(light.size.x) / 2),
                     v = (c * across - s * level) * (double(light.size.y) / 2),
                     centre = glm::dvec3(light.position) - p;
    return {centre - u - v, centre + u - v, centre + u + v, centre - u + v};
}

} // namespace limn::formulas
