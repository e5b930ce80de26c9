// SPDX-License-Identifier: MIT
#include "engine/scene/rectangle_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace limn {

namespace {

// From so many times its size on, a rectangle is a point: the angles of Lambert's formula nearly
// cancel there, and the error of taking it for a point is the square of the inverse.
constexpr double kFar = 1e5;

/// A convex polygon as seen from the origin.
struct Polygon {
    std::array<glm::dvec3, 5> corner; ///< a quad that one plane has cut
    int count = 0;
};

// Sutherland, Hodgman. Reentrant Polygon Clipping. 1974, for one plane through the origin.
Polygon aboveHorizon(const std::array<glm::dvec3, 4>& quad, glm::dvec3 n) {
    Polygon out;
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec3 a = quad[i], b = quad[(i + 1) % 4];
        const double ha = glm::dot(n, a), hb = glm::dot(n, b);
        if (ha >= 0)
            out.corner[std::size_t(out.count++)] = a;
        if ((ha > 0 && hb < 0) || (ha < 0 && hb > 0))
            out.corner[std::size_t(out.count++)] = a + (b - a) * (ha / (ha - hb));
    }
    return out;
}

// The angle of an edge as seen from the origin, times the cosine of n and the normal of the plane
// that holds both.
double edgeIntegral(glm::dvec3 a, glm::dvec3 b, glm::dvec3 n) {
    const glm::dvec3 across = glm::cross(a, b);
    const double length = glm::length(across);
    return length > 0 ? std::atan2(length, glm::dot(a, b)) * glm::dot(across, n) / length : 0;
}

} // namespace

LightRectangle lightRectangle(const Light& light) {
    const glm::vec3 d = light.direction;
    const glm::vec3 level(-d.z, 0, d.x); // cross(d, +Y)
    const float length = glm::length(level);
    const glm::vec3 right = length > 1e-6f ? level / length : glm::vec3(1, 0, 0);
    const glm::vec3 up = glm::normalize(glm::cross(right, d));
    const float c = std::cos(light.roll), s = std::sin(light.roll);
    LightRectangle r;
    r.centre = light.position;
    r.halfWidth = (c * right + s * up) * (light.size.x / 2);
    r.halfHeight = (c * up - s * right) * (light.size.y / 2);
    r.normal = d;
    r.area = light.size.x * light.size.y;
    return r;
}

float rectangleIrradiance(const LightRectangle& r, glm::vec3 p, glm::vec3 n) {
    const glm::dvec3 centre = glm::dvec3(r.centre) - glm::dvec3(p);
    const glm::dvec3 u(r.halfWidth), v(r.halfHeight), normal(n);
    if (!(glm::dot(centre, glm::dvec3(r.normal)) < 0))
        return 0;
    if (glm::length(centre) > kFar * (glm::length(u) + glm::length(v)))
        return r.area * pointIrradiance(r, r.centre, p, n);
    const Polygon seen =
        aboveHorizon({centre - u - v, centre + u - v, centre + u + v, centre - u + v}, normal);
    double sum = 0;
    for (int i = 0; i < seen.count; ++i)
        sum += edgeIntegral(seen.corner[std::size_t(i)],
                            seen.corner[std::size_t((i + 1) % seen.count)], normal);
    // Either way round.
    return float(std::clamp(std::abs(sum) / 2, 0.0, std::numbers::pi));
}

float pointIrradiance(const LightRectangle& r, glm::vec3 onLight, glm::vec3 p, glm::vec3 n) {
    const glm::dvec3 way = glm::dvec3(onLight) - glm::dvec3(p);
    const double d2 = glm::dot(way, way);
    const double cosines = std::max(glm::dot(way, glm::dvec3(n)), 0.0) *
                           std::max(-glm::dot(way, glm::dvec3(r.normal)), 0.0);
    return cosines > 0 ? float(std::min(cosines / (d2 * d2), 1e30)) : 0;
}

} // namespace limn
