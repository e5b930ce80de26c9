// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace limn {

/// How a lamp's intensity varies with direction, as a photometer measured it from afar. Vertical
/// angles are counted from the light's direction. Horizontal ones are counted about it from the
/// width of lightRectangle() towards its height, which is counterclockwise for who looks along the
/// light's direction from behind the lamp. Between its angles a profile is bilinear; beyond its
/// vertical ones it is dark.
/// CIE 121. The Photometry and Goniophotometry of Luminaires. 1996: the system C, gamma
struct LightProfile {
    std::string name; ///< of the luminaire; for people

    /// Intensity in the direction in which it is largest, as measured [cd].
    float peak = 1;

    /// Vertical angles of the first and the last row [degrees], [0, 180].
    float firstVertical = 0, lastVertical = 180;

    std::uint32_t rows = 0;    ///< evenly spaced vertical angles, [2, kMaxProfileRows]
    std::uint32_t columns = 0; ///< horizontal angles, evenly around the circle from 0,
                               ///< [1, kMaxProfileColumns]; 1: the same all around

    /// Intensities relative to the largest, [0, 1]: share[column * rows + row].
    std::vector<float> share;

    bool operator==(const LightProfile&) const = default;
};
inline constexpr std::uint32_t kMaxProfileRows = 721, kMaxProfileColumns = 720;

/// Why a profile is not one, naming the field; empty if it is.
std::string profileDefect(const LightProfile& profile);

/// Relative intensity, [0, 1], in a unit direction away from the light. Columns of `axes`: the
/// directions of the horizontal angles 0 and 90 degrees, and the light's direction.
float profileShare(const LightProfile& profile, const glm::mat3& axes, glm::vec3 direction);

/// Mean of the profile over all horizontal angles at a vertical one [rad].
double meanShare(const LightProfile& profile, double vertical);

/// Integral of the profile over all directions [sr], in closed form. Times the intensity in the
/// brightest direction it is the luminous flux.
double profileSolidAngle(const LightProfile& profile);

/// A profile that lights share, or none. Equal if the profiles are.
struct ProfileRef {
    std::shared_ptr<const LightProfile> profile;

    explicit operator bool() const { return profile != nullptr; }
    const LightProfile& operator*() const { return *profile; }
    const LightProfile* operator->() const { return profile.get(); }
    bool operator==(const ProfileRef& other) const {
        return profile == other.profile || (profile && other.profile && *profile == *other.profile);
    }
};

} // namespace limn
