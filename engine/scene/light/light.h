// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/light/light_profile.h"

#include <cstdint>
#include <string>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace limn {

enum class LightKind : std::uint8_t { Directional, Point, Spot, Rectangle };

/// Upper limit of colour, strength, emission and the sky's radiance, so that sums of light stay
/// within float. The sun's disc has 1.6e9 nits.
inline constexpr float kMaxLight = 1e10f;

/// Maximum irradiance per colour channel from a point or spot light, so that sums over lights and
/// surfaces stay within float.
inline constexpr float kMaxIrradiance = 1e28f;

/// Limits of a Rectangle's edge lengths [m].
inline constexpr float kMinLightSize = 1e-6f, kMaxLightSize = 1e6f;

/// A light in world space. Photometric values are used as radiometric ones, without a factor of
/// 683.
struct Light {
    std::string name = "Light";
    LightKind kind = LightKind::Point;
    bool enabled = true;
    glm::vec3 position{0}; ///< [m]; Rectangle: of its middle; ignored by Directional
    glm::vec3 direction{0, -1,
                        0}; ///< unit, the way light travels; ignored by Point without profile
    glm::vec3 color{1};     ///< linear Rec. 709, [0, kMaxLight]
    float strength = 100;   ///< Directional: irradiance [lux]. Point, Spot: intensity [cd],
                            ///< with a profile where that is largest.
                            ///< Rectangle: radiance [nits]. [0, kMaxLight]
    float range = 0;        ///< [m]; 0: unlimited. Window max(min(1-(d/r)^4, 1), 0) of
                            ///< KHR_lights_punctual. Point, Spot
    float innerAngle = 0;   ///< Spot: half-angle of full strength [rad]
    float outerAngle = 0.7853982f; ///< Spot: half-angle where it ends [rad], (innerAngle, pi/2]
    glm::vec2 size{1};             ///< Rectangle: width and height [m]
    float roll = 0;                ///< Rectangle, profile: turn about `direction`, from
                                   ///< LightRectangle [rad]
    ProfileRef profile;            ///< Point, Spot: times the cone; none: the same to all sides

    bool operator==(const Light&) const = default;
};

/// The light's profile if its kind has one, else null.
const LightProfile* profileOf(const Light& light);

/// Unit axes of the profile in the world, for profileShare(): those of lightRectangle().
glm::mat3 profileAxes(const Light& light);

/// Unshadowed light from a directional, point or spot light at a point.
struct LightSample {
    glm::vec3 irradiance{0}; ///< on a plane facing the light [W m^-2]; multiply by cos
    glm::vec3 toLight{0};    ///< unit
    float distance = 0;      ///< [m]; infinity for Directional
};

/// Light from `light` at world point `p`. The irradiance stops growing within 10 nm of the light
/// and stays below kMaxIrradiance. It is zero out of range, outside the cone, at d = 0, for lights
/// that are off, and for a Rectangle, which rectangle_light.h handles.
LightSample sampleLight(const Light& light, glm::vec3 p);

} // namespace limn
