// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/light/light.h"

namespace limn {

/// Intensity of a profile at a vertical and a horizontal angle [degrees] of a light of `strength`
/// [cd].
float profileIntensity(const LightProfile& profile, float strength, float vertical,
                       float horizontal);

/// A polar plot of the light's profile, as wide as the panel: the intensity by its vertical angle,
/// 0 degrees below, in the half planes of the horizontal angles 0 and 180 degrees, and, where it
/// depends on them, 90 and 270 degrees. Hovering shows the intensity in that direction [cd].
void profilePlot(const Light& light);

} // namespace limn
