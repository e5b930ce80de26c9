// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/mesh/bounds.h"

#include <cstdint>
#include <vector>

#include <glm/mat4x4.hpp>

namespace limn::render {

/// The camera parameters that cascades depend on.
struct ShadowCamera {
    glm::vec3 eye{0};
    glm::vec3 forward{0, 0, -1}; ///< unit
    float tanCorner = 1; ///< tangent of the angle between `forward` and a corner of the picture
    float nearest = 0;   ///< lower bound of the distance to the nearest visible surface [m]
    float pixel = 0;     ///< width of a pixel at a distance of 1 m [m]
};

/// Maximum number of cascades per directional light.
constexpr std::uint32_t kMaxCascades = 4;

/// Factor by which a cascade's texels are finer than those of the one before it. The first one's
/// are finer by it than those of the whole scene's map, which has twice as many texels across.
constexpr float kCascadeRatio = 2.5f;

/// Cascades end once texels are at most this wide [pixels]: finer maps are not worth their time.
constexpr float kTexelPixels = 4;

/// Projections of shadow maps around the nearer parts of what `camera` sees, coarse ones first. The
/// depth range of each contains all of `bounds` (1 near, 0 far). Cascades that would end before the
/// nearest visible surface are left out, and so are those after one whose texels are nowhere in
/// sight wider than kTexelPixels pixels. If the camera moves or turns a little, the result is
/// bit-identical; if it moves further, the projections shift by whole texels of any map whose size
/// is a multiple of 16 texels, so that shadows do not crawl. `direction` is the unit direction in
/// which the light travels.
std::vector<glm::mat4> cascadeProjections(glm::vec3 direction, const Bounds& bounds,
                                          const ShadowCamera& camera);

} // namespace limn::render
