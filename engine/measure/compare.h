// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/scene/exposure.h"

#include <cstdint>

namespace limn {

/// Error of a linear image against a reference of the same size. Numeric metrics are computed
/// before any tone mapping; x / 0 is infinite, 0 / 0 is 0. For SSIM and FLIP both images are
/// exposed so that the reference's mean becomes kMiddleGrey, and mapped by the ACES curve; FLIP
/// assumes 67 pixels per degree.
struct Comparison {
    double nrmse = 0; ///< rms(test - ref) / mean(ref), over all channels
    double nrmseTrimmed =
        0;             ///< the same without the worst 1 % of the pixels; mean(ref) is that of all
    double relmse = 0; ///< mean of (t-r)^2 / (r^2 + 0.01 mean(r)^2), worst 0.1 % of pixels dropped
    double bias = 0;   ///< mean(test) / mean(ref) - 1
    double ssim = 0;   ///< on tone-mapped luminance; 1: equal
    double flip = 0;   ///< mean FLIP error on the tone-mapped image; 0: equal
    // These are 0 with a single reference, from which they cannot be estimated:
    double referenceNoise =
        0;                 ///< standard error of a pixel of the references' mean, rms / mean(ref)
    double nrmseNoise = 0; ///< standard error of `nrmse`, from noise that pixels do not share
    double biasNoise = 0;  ///< standard error of `bias`, likewise
    std::uint64_t invalidPixels = 0; ///< NaN or Inf in any image; left out of the metrics
};

/// Fails when sizes differ, naming both.
Result<Comparison> compareImages(const ImageF& test, const ImageF& reference);

/// Same against two references r1, r2 of independent noise (different seeds), whose noise does not
/// count as an error of `test`: nrmse^2 = mean((t - r1)(t - r2)) / mean(ref)^2, or 0 if that is
/// negative. nrmseTrimmed sorts these products; where their noise exceeds the error, the worst 1 %
/// are the noisiest ones and the figure is too low. All other metrics are against the mean of r1
/// and r2.
Result<Comparison> compareImages(const ImageF& test, const ImageF& reference,
                                 const ImageF& reference2);

/// Mean of all channels of all pixels; 0 for an empty image.
double meanOf(const ImageF& image);

/// (a + b) / 2. Sizes must be equal.
ImageF meanImage(const ImageF& a, const ImageF& b);

/// Signed relative error of luminance per pixel, (t - r) / (r + 0.05 mean(r)), as a diverging,
/// colour-blind-safe map: blue is too dark, orange too bright, saturated at 50 %; invalid pixels
/// are magenta. Sizes must be equal.
Image errorHeatmap(const ImageF& test, const ImageF& reference);

/// The FLIP error of each pixel, measured as Comparison::flip, in the viridis colours of 0 (dark
/// violet) to 1 (yellow); invalid pixels are magenta. Sizes must be equal.
Image flipHeatmap(const ImageF& test, const ImageF& reference);

/// The squared error of each pixel as Comparison::relmse has it, in the viridis colours of 10^-4
/// and less (dark violet) to 1 and more (yellow), logarithmic; invalid pixels are magenta. Sizes
/// must be equal.
Image squaredErrorHeatmap(const ImageF& test, const ImageF& reference);

/// Number of pixels with a NaN or Inf.
std::uint64_t countInvalidPixels(const ImageF& image);

} // namespace limn
