// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lightmap/lightmap_layout.h"
#include "engine/scene/scene.h"

#include <vector>

namespace limn {

/// For each of Scene::instances, the distance within which light from other surfaces varies too
/// much for its texels: half their mean width [m], which is taken to be at most twice the scene's.
/// 0 for instances without a lightmap.
std::vector<float> nearReaches(const Scene& scene, const LightmapLayout& layout);

/// Weight with which a surface at distance `t` counts as near, for `reach` > 0: 1 up to half the
/// reach, then falling linearly to 0 at the reach.
inline float nearWeight(float t, float reach) {
    const float w = 2 - 2 * t / reach;
    return w < 0 ? 0 : w > 1 ? 1 : w;
}

} // namespace limn
