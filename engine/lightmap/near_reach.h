// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lightmap/lightmap_layout.h"
#include "engine/scene/scene.h"

#include <vector>

namespace limn {

/// Distance within which other surfaces light an instance in ways that its texels are too coarse
/// for: half the mean width of its texels [m], for each of Scene::instances. Texels
/// wider than twice the scene's mean count as that wide. 0 for instances without a lightmap.
std::vector<float> nearReaches(const Scene& scene, const LightmapLayout& layout);

/// Weight of a surface at distance `t` in what is near, for `reach` > 0: 1 up to half of the
/// reach, falling to 0 at its end.
inline float nearWeight(float t, float reach) {
    const float w = 2 - 2 * t / reach;
    return w < 0 ? 0 : w > 1 ? 1 : w;
}

} // namespace limn
