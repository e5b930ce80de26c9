// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/technique.h"

namespace limn {

/// The same bounced light everywhere and from everywhere: the sky's mean radiance, or a constant.
/// Nothing is precomputed, traced or occluded. It is the least that a technique can be: what the
/// others are worth shows beside it.
extern const Technique kAmbientTechnique;

} // namespace limn
