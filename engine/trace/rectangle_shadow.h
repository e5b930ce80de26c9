// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/light/rectangle_light.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>

namespace limn {

/// Point `i` of `points` in the unit square, Hammersley's shifted by `shift` in [0, 1)^2. None lies
/// on the edge, where walls that bound a light would hide it.
glm::vec2 pointOnLight(std::uint32_t i, std::uint32_t points, glm::vec2 shift);

/// A surface point that a rectangle lights. Its normals are unit vectors.
struct RectangleReceiver {
    glm::vec3 position;
    glm::vec3 geometricNormal; ///< below whose plane nothing is visible
    glm::vec3 normal;          ///< that of cosines

    /// A point with a single normal.
    static RectangleReceiver flat(glm::vec3 position, glm::vec3 normal) {
        return {position, normal, normal};
    }
};

/// Irradiance per unit of radiance from a rectangle, with shadow: rectangleIrradiance() times the
/// visible share of `points` points on it, which are uniform in solid angle and weighted by their
/// cosines. Exact if all or nothing is visible. Adds the number of shadow rays to `rays`.
float shadowedIrradiance(const TraceScene& trace, const LightRectangle& rectangle,
                         const RectangleReceiver& receiver, std::uint32_t points, glm::vec2 shift,
                         std::uint64_t& rays);

} // namespace limn
