// SPDX-License-Identifier: MIT
#include "engine/runtime/rectangle.h"

#include <algorithm>

namespace limn::runtime {

namespace {

constexpr double kExactPi = 3.14159265358979323846;

/// Angle of an edge as seen from the origin, times the cosine between n and the normal of the plane
/// through the origin and the edge.
double edgeIntegral(Vec3 a, Vec3 b, Vec3 n) {
    const Vec3 across = cross(a, b);
    const double size = length(across);
    return size > 0 ? std::atan2(size, dot(a, b)) * dot(across, n) / size : 0;
}

} // namespace

Rectangle::Rectangle(const limnrt_light& light) {
    const Vec3 d = vec3(light.direction);
    const Vec3 level{-d.z, 0, d.x}; // cross(d, +Y)
    const double size = length(level);
    const Vec3 right = size > 1e-6 ? level * (1 / size) : Vec3{1, 0, 0};
    Vec3 up = cross(right, d);
    up = up * (1 / length(up));
    const double c = std::cos(double(light.roll)), s = std::sin(double(light.roll));
    centre = vec3(light.position);
    halfWidth = (right * c + up * s) * (double(light.width) / 2);
    halfHeight = (up * c - right * s) * (double(light.height) / 2);
    normal = d;
    area = double(light.width) * double(light.height);
}

double rectangleIrradiance(const Rectangle& r, Vec3 p, Vec3 n) {
    constexpr double kFar = 1e5; // from here on a point: the angles below nearly cancel
    const Vec3 centre = r.centre - p, u = r.halfWidth, v = r.halfHeight;
    if (!(dot(centre, r.normal) < 0))
        return 0;
    const double distance = length(centre);
    if (distance > kFar * (length(u) + length(v))) {
        const double d2 = distance * distance;
        return r.area * std::max(dot(centre, n), 0.0) * -dot(centre, r.normal) / (d2 * d2);
    }
    const Vec3 quad[4] = {centre - u - v, centre + u - v, centre + u + v, centre - u + v};
    Vec3 seen[5]; // a quad that one plane has cut
    int count = 0;
    for (int i = 0; i < 4; ++i) {
        const Vec3 a = quad[i], b = quad[(i + 1) % 4];
        const double ha = dot(n, a), hb = dot(n, b);
        if (ha >= 0)
            seen[count++] = a;
        if ((ha > 0 && hb < 0) || (ha < 0 && hb > 0))
            seen[count++] = a + (b - a) * (ha / (ha - hb));
    }
    double sum = 0;
    for (int i = 0; i < count; ++i)
        sum += edgeIntegral(seen[i], seen[(i + 1) % count], n);
    return std::clamp(std::fabs(sum) / 2, 0.0, kExactPi); // of either winding
}

SphericalRectangle::SphericalRectangle(const Rectangle& r, Vec3 from)
    : m_rectangle(r), m_from(from) {
    const Vec3 way = r.centre - from;
    const double halfWidth = length(r.halfWidth), halfHeight = length(r.halfHeight);
    m_x = r.halfWidth * (1 / halfWidth);
    m_y = r.halfHeight * (1 / halfHeight);
    m_z = cross(m_x, m_y);
    if (dot(way, m_z) < 0)
        m_z = -m_z;
    const double x = dot(way, m_x), y = dot(way, m_y);
    m_x0 = x - halfWidth, m_x1 = x + halfWidth;
    m_y0 = y - halfHeight, m_y1 = y + halfHeight;
    m_depth = dot(way, m_z);
    // The z of the normals of the planes through `from` and the edges y0, x1, y1, x0.
    const auto steepness = [this](double edge) { return edge / std::hypot(edge, m_depth); };
    const double n0 = -steepness(m_y0), n1 = steepness(m_x1), n2 = steepness(m_y1),
                 n3 = -steepness(m_x0);
    const auto angle = [](double a, double b) { return std::acos(std::clamp(-a * b, -1.0, 1.0)); };
    const double g2 = angle(n2, n3), g3 = angle(n3, n0);
    m_solidAngle = angle(n0, n1) + angle(n1, n2) + g2 + g3 - 2 * kExactPi;
    m_b0 = n0;
    m_b1 = n2;
    m_k = 2 * kExactPi - g2 - g3;
    m_small = !(m_solidAngle > 1e-6 && m_depth > 0);
}

Vec3 SphericalRectangle::at(double u, double v) const {
    if (m_small)
        return m_rectangle.at(u, v);
    const double au = u * m_solidAngle + m_k;
    const double fu = (std::cos(au) * m_b0 - m_b1) / std::sin(au);
    const double cu = std::clamp(std::copysign(1 / std::hypot(fu, m_b0), fu), -1.0, 1.0);
    const double x = std::clamp(cu * m_depth / std::sqrt(std::max(1 - cu * cu, 1e-30)), m_x0, m_x1);
    const double d = std::hypot(x, m_depth);
    const double h0 = m_y0 / std::hypot(d, m_y0), h1 = m_y1 / std::hypot(d, m_y1);
    const double h = h0 + v * (h1 - h0), h2 = h * h;
    const double y = h2 < 1 - 1e-12 ? h * d / std::sqrt(1 - h2) : m_y1;
    return m_from + m_x * x + m_y * std::clamp(y, m_y0, m_y1) + m_z * m_depth;
}

} // namespace limn::runtime
