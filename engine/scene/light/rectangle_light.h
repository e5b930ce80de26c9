// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/light/light.h"

#include <glm/vec2.hpp>

namespace limn {

/// The rectangle that a light of kind Rectangle shines from, in world space. Its width lies
/// horizontal, along +X where it shines straight up or down, before it is turned by Light::roll.
struct LightRectangle {
    glm::vec3 centre{0};     ///< [m]
    glm::vec3 halfWidth{0};  ///< centre to the middle of an edge [m]
    glm::vec3 halfHeight{0}; ///< the same across [m]
    glm::vec3 normal{0};     ///< unit; it shines to this side only
    float area = 0;          ///< [m^2]

    /// uv in [0, 1]^2.
    glm::vec3 at(glm::vec2 uv) const {
        return centre + (2 * uv.x - 1) * halfWidth + (2 * uv.y - 1) * halfHeight;
    }
};
LightRectangle lightRectangle(const Light& light);

/// Irradiance [W m^-2] per unit of radiance at `p` on a plane with unit normal `n`, without shadow:
/// in [0, pi]; 0 behind the rectangle and in its plane. Its part below the receiver's horizon is
/// cut off.
/// Lambert. Photometria. 1760; Baum, Rushmeier, Winget. Improving Radiosity Solutions Through the
/// Use of Analytically Determined Form-Factors. 1989
float rectangleIrradiance(const LightRectangle& rectangle, glm::vec3 p, glm::vec3 n);

/// What the surface element at `onLight` adds to it, per unit of area [m^-2]: cos cos' / d^2, 0
/// where either side does not face the other.
float pointIrradiance(const LightRectangle& rectangle, glm::vec3 onLight, glm::vec3 p, glm::vec3 n);

/// A rectangle as seen from a point: places on it that are even in solid angle. Of one that is much
/// larger than its distance, or than the room that the point is in, even places on its area would
/// nearly all lie where they bring nothing.
/// Ureña, Fajardo, King. An Area-Preserving Parametrization for Spherical Rectangles. 2013
class SphericalRectangle {
public:
    SphericalRectangle(const LightRectangle& rectangle, glm::vec3 from);

    double solidAngle() const { return m_solidAngle; } ///< [sr], > 0, of either side

    /// For `uv` in [0, 1]^2.
    glm::vec3 at(glm::vec2 uv) const;

private:
    LightRectangle m_rectangle;
    glm::dvec3 m_from;
    glm::dvec3 m_x, m_y, m_z;      ///< unit, along the edges and towards the rectangle's plane
    double m_x0, m_x1, m_y0, m_y1; ///< of the edges, in that frame about `from` [m]
    double m_depth;                ///< of the plane, > 0 [m]
    double m_b0, m_b1, m_k;        ///< as the paper names them
    double m_solidAngle;
    bool m_small; ///< so small that rounding would show: even in area then, which is the same
};

} // namespace limn
