// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/format/bake.h"

#include <vector>

namespace limn {

/// Irradiance [W m^-2] that each surfel reads from its caches if every sender has a radiosity of 1
/// W m^-2: 1 in a closed room, less where rays are lost. The truncation to few bands may add more
/// at a surfel whose normal differs from its caches'.
std::vector<float> furnaceIrradiance(const Surfels& surfels, const Caches& caches, int bands);

/// Lowers Surfels::cacheWeight so that no surfel has a furnaceIrradiance() above 1. Since nearly
/// all links add light and hardly any subtract some, bounces then die out at any albedo below 1.
void limitGain(const Caches& caches, int bands, Surfels& surfels);

} // namespace limn
