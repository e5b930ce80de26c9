// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/mesh/bounds.h"

#include <cstdint>
#include <vector>

#include <glm/mat4x4.hpp>

namespace limn::render {

/// What a camera sees, as far as shadow maps that follow it need to know.
struct ShadowCamera {
    glm::vec3 eye{0};
    glm::vec3 forward{0, 0, -1}; ///< unit
    float tanCorner = 1;         ///< of the angle between `forward` and a corner of the picture
    float nearest = 0;           ///< no surface in sight is nearer to the eye [m]
    float pixel = 0;             ///< how wide a pixel is at a distance of 1 m [m]
};

/// Cascades of one directional light, at most.
constexpr std::uint32_t kMaxCascades = 4;

/// Each cascade has texels so many times as fine as those of the one before; the first, as those of
/// the map of the whole scene, where a cascade has half as many texels across.
constexpr float kCascadeRatio = 2.5f;

/// Finer maps are not worth their time.
constexpr float kTexelPixels = 4;

/// Projections of shadow maps round the nearer parts of what `camera` sees, coarse ones first, each
/// with all of `bounds` in its depth range (1 near, 0 far). Those that would lie before all that is
/// in sight are left out, and so are those after one whose texels are nowhere in sight wider than
/// kTexelPixels pixels. A camera that moves or turns a little gives the same bits; one that moves
/// further shifts them by whole texels of any map of a multiple of 16 texels, so that shadows do
/// not crawl. `direction`: unit, the way the light travels.
std::vector<glm::mat4> cascadeProjections(glm::vec3 direction, const Bounds& bounds,
                                          const ShadowCamera& camera);

} // namespace limn::render
