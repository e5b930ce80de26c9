// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/image.h"
#include "engine/scene/view.h"

namespace limn {

/// Scene-referred linear Rec. 709 >= 0 to display-referred linear in [0, 1]; the same curves as
/// shaders/viewport/tonemap.frag.
glm::vec3 toneMapped(glm::vec3 color, Tonemap curve);

/// The sRGB transfer function, linear [0, 1] to encoded.
float encodeSrgb(float linear);

/// 8-bit picture of `image` times 2^exposureEv. NaN becomes black.
Image toneMappedImage(const ImageF& image, Tonemap curve, float exposureEv);

} // namespace limn
