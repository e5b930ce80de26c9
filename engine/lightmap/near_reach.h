// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lightmap/layout/lightmap_layout.h"
#include "engine/scene/scene.h"

#include <cstdint>
#include <vector>

namespace limn {

/// For each of Scene::instances, the distance within which light from other surfaces varies too
/// much for its texels: half their mean width [m], which is taken to be at most twice the scene's.
/// 0 for instances without a lightmap.
std::vector<float> nearReaches(const Scene& scene, const LightmapLayout& layout);

/// That distance at one point of an instance [m]. `reach`: nearReaches() of the instance; it
/// shrinks in proportion to the width of the texels, where finer ones replace those of the atlas.
float nearReachAt(const LightmapLayout& layout, float reach, std::uint32_t instance,
                  std::uint32_t mesh, std::uint32_t triangle, float u, float v, bool back);

/// Weight with which a surface at distance `t` counts as near, for `reach` > 0: 1 up to half the
/// reach, then falling linearly to 0 at the reach.
inline float nearWeight(float t, float reach) {
    const float w = 2 - 2 * t / reach;
    return w < 0 ? 0 : w > 1 ? 1 : w;
}

} // namespace limn
