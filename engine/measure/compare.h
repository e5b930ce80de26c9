// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/scene/image.h"

#include <cstdint>

namespace limn {

/// Error of a linear image against a reference of the same size; numeric metrics before any tone mapping.
struct Comparison {
    double nrmse = 0;  ///< rms(test - ref) / mean(ref), over all channels
    double relmse = 0; ///< mean of (t-r)^2 / (r^2 + 0.01 mean(r)^2), worst 0.1 % of pixels dropped
    double bias = 0;   ///< mean(test) / mean(ref) - 1
    double ssim = 0;   ///< on tone-mapped luminance; 1: equal
    double flip = 0;   ///< mean FLIP error on the tone-mapped image; 0: equal
    std::uint64_t invalidPixels = 0; ///< NaN, Inf in either; left out of the metrics
};

/// Fails when sizes differ.
Result<Comparison> compareImages(const ImageF& test, const ImageF& reference);

/// Signed relative error per pixel as a diverging, colour-blind-safe map (blue: too dark, orange: too bright).
Image errorHeatmap(const ImageF& test, const ImageF& reference);

/// NaN and Inf pixels.
std::uint64_t countInvalidPixels(const ImageF& image);

} // namespace limn
