// SPDX-License-Identifier: MIT
#pragma once

#include "engine/gallery/gallery.h"

namespace limn {

/// A street in the sun. Before one row of houses stand red, green and blue planes, and a dynamic
/// orange car, "Car", that light the shaded fronts of the houses opposite. There is no sky. Made
/// after the scene of Bischoff, Schwandt, Broll. A Real-Time Global Illumination Approach for High
/// Resolution Reflective Shadow Maps in Open World Scenes. 2017, figure 6.
GeneratedScene colouredStreet();

} // namespace limn
