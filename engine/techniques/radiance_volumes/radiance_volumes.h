// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/technique.h"

namespace limn {

/// Dynamic radiance volumes: one bounce of the scene's lights, gathered by caches that lie around
/// what the view shows. Nothing is precomputed.
extern const Technique kRadianceVolumesTechnique;

} // namespace limn
