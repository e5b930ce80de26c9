// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

namespace limn {

/// Of the light that arrives so much may be missing in a reflection for want of bands: hardly more
/// than the eye tells apart.
inline constexpr float kReflectionLoss = 0.02f;

/// Bands that bounced light needs so that a surface of this material reflects it to within
/// kReflectionLoss: the least for which lobeLosses() times the share of light that is reflected,
/// root of the mean square over angles of view, is below it, in [min(3, most), most]. A surface
/// that needs more than 3 is a glossy receiver. What a texture holds on less than 1 % of its texels
/// does not count, and a textured metal counts as bright as its factor.
int receiverBands(const Assets& assets, const Material& material, int most);

/// The most bands that any surface of the scene needs.
int receiverBands(const Scene& scene, int most);

} // namespace limn
