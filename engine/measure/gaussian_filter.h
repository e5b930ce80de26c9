// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

namespace limn {

/// One channel of an image, row by row.
struct Plane {
    std::uint32_t width = 0, height = 0;
    std::vector<float> values; ///< width * height
};

/// Convolves with kernelX along rows and kernelY along columns. Both have odd length, with the
/// weight of offset 0 in the middle. Pixels beyond the border repeat the outermost one.
Plane convolve(const Plane& plane, const std::vector<float>& kernelX,
               const std::vector<float>& kernelY);

/// Normalised kernel exp(-x^2 / (2 sigma^2)) for x = -radius ... radius [pixels], with sum 1.
std::vector<float> gaussianKernel(float sigma, int radius);

} // namespace limn
