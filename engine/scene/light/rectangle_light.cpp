// SPDX-License-Identifier: MIT
#include "engine/scene/light/rectangle_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace limn {

namespace {

// From this many times its size on, a rectangle is treated as a point: the angles of Lambert's
// formula nearly cancel there, and the error of the approximation is the inverse squared.
constexpr double kFar = 1e5;

/// A convex polygon as seen from the origin.
struct Polygon {
    std::array<glm::dvec3, 5> corner; ///< a quad that one plane has cut
    int count = 0;
};

// Clips a polygon by one plane through the origin. Sutherland, Hodgman. Reentrant Polygon Clipping.
// 1974
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

// Angle of an edge as seen from the origin, times the cosine between n and the normal of the plane
// through the origin and the edge.
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

float rollTowards(Light light, glm::vec3 width) {
    light.roll = 0;
    const LightRectangle level = lightRectangle(light);
    return std::atan2(glm::dot(width, glm::normalize(level.halfHeight)),
                      glm::dot(width, glm::normalize(level.halfWidth)));
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
    // Accepts either winding.
    return float(std::clamp(std::abs(sum) / 2, 0.0, std::numbers::pi));
}

SphericalRectangle::SphericalRectangle(const LightRectangle& r, glm::vec3 from)
    : m_rectangle(r), m_from(from) {
    const glm::dvec3 way = glm::dvec3(r.centre) - m_from, u(r.halfWidth), v(r.halfHeight);
    const double halfWidth = glm::length(u), halfHeight = glm::length(v);
    m_x = u / halfWidth;
    m_y = v / halfHeight;
    m_z = glm::cross(m_x, m_y);
    if (glm::dot(way, m_z) < 0)
        m_z = -m_z;
    const double x = glm::dot(way, m_x), y = glm::dot(way, m_y);
    m_x0 = x - halfWidth;
    m_x1 = x + halfWidth;
    m_y0 = y - halfHeight;
    m_y1 = y + halfHeight;
    m_depth = glm::dot(way, m_z);
    // The z of the normals of the planes through `from` and the edges y0, x1, y1, x0.
    const auto steepness = [this](double edge) { return edge / std::hypot(edge, m_depth); };
    const double n0 = -steepness(m_y0), n1 = steepness(m_x1), n2 = steepness(m_y1),
                 n3 = -steepness(m_x0);
    const auto angle = [](double a, double b) { return std::acos(std::clamp(-a * b, -1.0, 1.0)); };
    const double g2 = angle(n2, n3), g3 = angle(n3, n0);
    m_solidAngle = angle(n0, n1) + angle(n1, n2) + g2 + g3 - 2 * std::numbers::pi;
    m_b0 = n0;
    m_b1 = n2;
    m_k = 2 * std::numbers::pi - g2 - g3;
    constexpr double kSmall = 1e-6; // the angles' sum is exact to 1e-15
    m_small = !(m_solidAngle > kSmall && m_depth > 0);
    if (m_small)
        m_solidAngle = double(r.area) * m_depth / std::pow(std::max(glm::length(way), 1e-30), 3);
}

glm::vec3 SphericalRectangle::at(glm::vec2 uv) const {
    if (m_small)
        return m_rectangle.at(uv);
    const double au = double(uv.x) * m_solidAngle + m_k;
    const double fu = (std::cos(au) * m_b0 - m_b1) / std::sin(au);
    const double cu = std::clamp(std::copysign(1 / std::hypot(fu, m_b0), fu), -1.0, 1.0);
    const double x = std::clamp(cu * m_depth / std::sqrt(std::max(1 - cu * cu, 1e-30)), m_x0, m_x1);
    const double d = std::hypot(x, m_depth);
    const double h0 = m_y0 / std::hypot(d, m_y0), h1 = m_y1 / std::hypot(d, m_y1);
    const double h = h0 + double(uv.y) * (h1 - h0), h2 = h * h;
    const double y = h2 < 1 - 1e-12 ? h * d / std::sqrt(1 - h2) : m_y1;
    return glm::vec3(m_from + x * m_x + std::clamp(y, m_y0, m_y1) * m_y + m_depth * m_z);
}

float pointIrradiance(const LightRectangle& r, glm::vec3 onLight, glm::vec3 p, glm::vec3 n) {
    const glm::dvec3 way = glm::dvec3(onLight) - glm::dvec3(p);
    const double d2 = glm::dot(way, way);
    const double cosines = std::max(glm::dot(way, glm::dvec3(n)), 0.0) *
                           std::max(-glm::dot(way, glm::dvec3(r.normal)), 0.0);
    return cosines > 0 ? float(std::min(cosines / (d2 * d2), 1e30)) : 0;
}

} // namespace limn
