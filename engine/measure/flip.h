// SPDX-License-Identifier: MIT
#pragma once

#include "engine/measure/gaussian_filter.h"
#include "engine/scene/image.h"

namespace limn {

/// Perceived difference per pixel of two images of equal size, in [0, 1]; 0: equal. Input is
/// display-referred linear Rec. 709 in [0, 1]: sRGB pixels after decoding.
/// Andersson et al. FLIP: A Difference Evaluator for Alternating Images. 2020 (the LDR metric).
Plane flipMap(const ImageF& test, const ImageF& reference, float pixelsPerDegree = 67);

} // namespace limn
