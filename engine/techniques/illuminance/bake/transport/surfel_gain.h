// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/bake/bake.h"

#include <vector>

namespace limn {

/// Per surfel the irradiance [W m^-2] that it reads from its caches where every sender has a
/// radiosity of 1 W m^-2: 1 in a closed room, less where rays are lost. The error of the bands may
/// bring more to a surfel that does not look where its caches do.
std::vector<float> furnaceIrradiance(const Surfels& surfels, const Caches& caches, int bands);

/// Lowers Surfels::cacheWeight so that no surfel reads more than 1 there. As nearly all links bring
/// light and hardly any take some away, bounces then die out at any albedo below 1.
void limitGain(const Caches& caches, int bands, Surfels& surfels);

} // namespace limn
