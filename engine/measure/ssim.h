// SPDX-License-Identifier: MIT
#pragma once

#include "engine/measure/gaussian_filter.h"

namespace limn {

/// Structural similarity per pixel of two planes of equal size with values in [0, 1]; 1: equal.
/// Gaussian window of sigma 1.5 over 11 x 11 pixels, K1 = 0.01, K2 = 0.03.
/// Wang et al. Image Quality Assessment: From Error Visibility to Structural Similarity. 2004
Plane ssimMap(const Plane& a, const Plane& b);

} // namespace limn
