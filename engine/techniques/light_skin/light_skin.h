// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/technique.h"

namespace limn {

/// LightSkin with bidirectional reflective shadow maps: one bounce of the scene's lights, gathered
/// into two proxy lights at caches on the objects. Nothing is precomputed but these caches, which
/// are made in the update.
extern const Technique kLightSkinTechnique;

} // namespace limn
