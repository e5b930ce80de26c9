// SPDX-License-Identifier: MIT
#pragma once

#include "engine/runtime/limn_runtime.h"
#include "engine/runtime/vectors.h"

namespace limn::runtime {

/// The rectangle of a light. Before the light's roll its width is horizontal, or along +X where it
/// shines straight up or down.
struct Rectangle {
    Vec3 centre, halfWidth,
        halfHeight; ///< the halves lead from the centre to the edges' middles [m]
    Vec3 normal;    ///< unit; it shines to this side only
    double area;    ///< [m^2]

    explicit Rectangle(const limnrt_light& light);
    Vec3 at(double u, double v) const {
        return centre + halfWidth * (2 * u - 1) + halfHeight * (2 * v - 1);
    }
};

/// Unshadowed irradiance at `p` on a plane with unit normal `n` per unit of radiance, in [0, pi];
/// what lies below the plane's horizon is clipped. Lambert. Photometria. 1760; Baum, Rushmeier,
/// Winget. Improving Radiosity Solutions Through the Use of Analytically Determined Form-Factors.
/// 1989
double rectangleIrradiance(const Rectangle& r, Vec3 p, Vec3 n);

/// Points of a rectangle, uniform in solid angle as seen from a point. Ureña, Fajardo, King. An
/// Area-Preserving Parametrization for Spherical Rectangles. 2013
class SphericalRectangle {
public:
    SphericalRectangle(const Rectangle& r, Vec3 from);
    Vec3 at(double u, double v) const;

private:
    const Rectangle& m_rectangle;
    Vec3 m_from, m_x, m_y, m_z; ///< the point and a frame: along the edges, towards the plane
    double m_x0, m_x1, m_y0, m_y1, m_depth; ///< edges and distance of the plane in it [m]
    double m_b0, m_b1, m_k, m_solidAngle;   ///< named as in the paper
    bool m_small; ///< rounding would show; sampled in area, which is then the same
};

} // namespace limn::runtime
