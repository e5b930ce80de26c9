// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/scene/image.h"

#include <cstdint>

namespace limn {

/// Error of a linear image against a reference of the same size; numeric metrics before any tone
/// mapping. x / 0 is infinite, 0 / 0 is 0. For SSIM and FLIP both images are exposed so that the
/// reference's mean becomes 0.18 and go through the ACES curve; FLIP assumes 67 pixels per degree.
struct Comparison {
    double nrmse = 0;  ///< rms(test - ref) / mean(ref), over all channels
    double relmse = 0; ///< mean of (t-r)^2 / (r^2 + 0.01 mean(r)^2), worst 0.1 % of pixels dropped
    double bias = 0;   ///< mean(test) / mean(ref) - 1
    double ssim = 0;   ///< on tone-mapped luminance; 1: equal
    double flip = 0;   ///< mean FLIP error on the tone-mapped image; 0: equal
    std::uint64_t invalidPixels = 0; ///< NaN, Inf in either; left out of the metrics
};

/// Fails when sizes differ, naming both.
Result<Comparison> compareImages(const ImageF& test, const ImageF& reference);

/// Signed relative error of luminance per pixel, (t - r) / (r + 0.05 mean(r)), as a diverging,
/// colour-blind-safe map: blue too dark, orange too bright, full at 50 %; invalid pixels magenta.
/// Sizes must be equal.
Image errorHeatmap(const ImageF& test, const ImageF& reference);

/// NaN and Inf pixels.
std::uint64_t countInvalidPixels(const ImageF& image);

} // namespace limn
