// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/light/light.h"

#include <glm/vec2.hpp>

namespace limn {

/// The rectangle of a light of kind Rectangle, in world space. Before Light::roll is applied, its
/// width is horizontal, or along +X if it shines straight up or down.
struct LightRectangle {
    glm::vec3 centre{0};     ///< [m]
    glm::vec3 halfWidth{0};  ///< from the centre to the middle of an edge [m]
    glm::vec3 halfHeight{0}; ///< the same for an adjacent edge [m]
    glm::vec3 normal{0};     ///< unit; it shines to this side only
    float area = 0;          ///< [m^2]

    /// Point at `uv` in [0, 1]^2.
    glm::vec3 at(glm::vec2 uv) const {
        return centre + (2 * uv.x - 1) * halfWidth + (2 * uv.y - 1) * halfHeight;
    }
};
LightRectangle lightRectangle(const Light& light);

/// Light::roll [rad] at which the rectangle's width points along `width`, of any length, as nearly
/// as it can.
float rollTowards(Light light, glm::vec3 width);

/// Unshadowed irradiance [W m^-2] per unit of radiance at `p` on a plane with unit normal `n`, in
/// [0, pi]; 0 behind the rectangle and in its plane. The part of the rectangle below the receiver's
/// horizon is clipped.
/// Lambert. Photometria. 1760; Baum, Rushmeier, Winget. Improving Radiosity Solutions Through the
/// Use of Analytically Determined Form-Factors. 1989
float rectangleIrradiance(const LightRectangle& rectangle, glm::vec3 p, glm::vec3 n);

/// Contribution of the surface element at `onLight` to rectangleIrradiance(), per unit of area
/// [m^-2]: cos cos' / d^2, or 0 if either side does not face the other.
float pointIrradiance(const LightRectangle& rectangle, glm::vec3 onLight, glm::vec3 p, glm::vec3 n);

/// A rectangle as seen from a point, for sampling points on it uniformly in solid angle. If the
/// rectangle is much larger than its distance, or than the room around the point, nearly all points
/// that are uniform in area would contribute next to nothing.
/// Ureña, Fajardo, King. An Area-Preserving Parametrization for Spherical Rectangles. 2013
class SphericalRectangle {
public:
    SphericalRectangle(const LightRectangle& rectangle, glm::vec3 from);

    double solidAngle() const { return m_solidAngle; } ///< [sr], > 0, of either side

    /// Point on the rectangle for `uv` in [0, 1]^2.
    glm::vec3 at(glm::vec2 uv) const;

private:
    LightRectangle m_rectangle;
    glm::dvec3 m_from;
    glm::dvec3 m_x, m_y, m_z;      ///< unit, along the edges and towards the rectangle's plane
    double m_x0, m_x1, m_y0, m_y1; ///< edges in that frame, relative to `from` [m]
    double m_depth;                ///< distance of the plane, > 0 [m]
    double m_b0, m_b1, m_k;        ///< named as in the paper
    double m_solidAngle;
    bool m_small; ///< so small that rounding would show; then sampled in area, which is equivalent
};

} // namespace limn
