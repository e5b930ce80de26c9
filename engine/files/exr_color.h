// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"
#include "engine/scene/image.h"

#include <ImfChromaticities.h>

namespace limn {

/// Converts an image from the given primaries and white to Rec. 709, so that white stays white
/// (Lam. Metamerism and Colour Constancy. 1985: the transform that is called Bradford's). Leaves
/// every bit as it is where they are those of Rec. 709. Fails where no colours can be made of them.
Result<void> toRec709(ImageF& image, const Imf::Chromaticities& from);

} // namespace limn
