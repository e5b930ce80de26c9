// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/scene.h"

namespace limn {

/// Share of the incoming light that a reflection may lose because bands are missing: hardly more
/// than the eye can distinguish.
inline constexpr float kReflectionLoss = 0.02f;

/// Number of bands of bounced light with which a surface of this material reflects it to within
/// kReflectionLoss, in [min(3, maxBands), maxBands]. It is the smallest number for which
/// lobeLosses() times the reflected share of light, as root mean square over viewing angles, is
/// below that limit. A surface that needs more than 3 is a glossy receiver. Values on less than 1 %
/// of a texture's texels do not count, and a textured metal counts as bright as its factor.
int receiverBands(const Assets& assets, const Material& material, int maxBands);

/// Maximum of receiverBands() over the surfaces of the scene.
int receiverBands(const Scene& scene, int maxBands);

} // namespace limn
