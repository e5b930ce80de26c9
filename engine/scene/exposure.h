// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/image.h"

#include <optional>

namespace limn {

/// Where exposures put the mean of a picture.
inline constexpr float kMiddleGrey = 0.18f;

/// Limit of exposures in the editor [EV], of either sign: full sun needs -16, moonlight 11.
inline constexpr float kMaxExposureEv = 20;

/// EV100 of a camera whose picture is white where light times 2^exposureEv is 1, and the inverse,
/// which has the same form. A saturation-based sensitivity puts white at 1.2 * 2^EV100 nits.
/// Lagarde, de Rousiers. Moving Frostbite to Physically Based Rendering. 2014
float ev100Of(float exposureEv);
float exposureOfEv100(float ev100);

/// Limits of f-numbers and sensitivities in the editor.
inline constexpr float kMinAperture = 0.5f, kMaxAperture = 64, kMinIso = 1, kMaxIso = 1e6f;

/// A camera's settings but for the shutter time, which follows from the exposure.
struct CameraExposure {
    float aperture = 8; ///< f-number, > 0
    float iso = 100;    ///< sensitivity, > 0

    bool operator==(const CameraExposure&) const = default;
};

/// Shutter time of an exposure [s], and the inverse: EV100 = log2(N^2 / t * 100 / ISO).
float shutterOf(const CameraExposure& camera, float exposureEv);
float exposureOfShutter(const CameraExposure& camera, float seconds);

/// Exposure at which the picture's typical luminance is kMiddleGrey [EV], within +-kMaxExposureEv:
/// the geometric mean of all lit pixels but the darkest tenth and the brightest one, so that lamps
/// and cracks do not matter. Black, NaN and infinite pixels are left out; nothing if all are.
std::optional<float> meteredExposure(const ImageF& linear);

} // namespace limn
