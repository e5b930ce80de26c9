// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/light/rectangle_light.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>

namespace limn {

/// Irradiance per unit of radiance that arrives from a rectangle at surface point `p` with unit
/// normal `n`: rectangleIrradiance() times the share of `points` on it that `p` sees, even in solid
/// angle, each weighted by its cosine. Exact where all or nothing is seen. The points are
/// Hammersley's, shifted by `shift` in [0, 1)^2. Adds the shadow rays to `rays`.
float shadowedIrradiance(const TraceScene& trace, const LightRectangle& rectangle, glm::vec3 p,
                         glm::vec3 n, std::uint32_t points, glm::vec2 shift, std::uint64_t& rays);

} // namespace limn
