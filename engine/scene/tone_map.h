// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/image.h"
#include "engine/scene/view.h"

namespace limn {

/// Maps scene-referred linear Rec. 709 >= 0 to display-referred linear in [0, 1], with the same
/// curves as shaders/viewport/tonemap.frag.
glm::vec3 toneMapped(glm::vec3 color, Tonemap curve);

/// The sRGB transfer function, linear [0, 1] to encoded.
float encodeSrgb(float linear);

/// Converts `image` times 2^exposureEv to 8 bits per channel. NaN becomes black.
Image toneMappedImage(const ImageF& image, Tonemap curve, float exposureEv);

} // namespace limn
