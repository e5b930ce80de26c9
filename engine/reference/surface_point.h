// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/surface/specular.h"
#include "engine/trace/trace_scene.h"

#include <optional>

namespace limn {

/// A Lambertian surface point as a ray met it. Normals look to the side the ray came from.
struct SurfacePoint {
    glm::vec3 position{0};
    glm::vec3 geometricNormal{0}; ///< unit
    glm::vec3 normal{0};          ///< unit, interpolated from the vertices; the cosine of shading
    glm::vec3 albedo{0};
    glm::vec3 emission{0}; ///< [nits]
};

/// Nothing for the back of a one-sided surface: it is black and blocks. A double-sided surface
/// reflects and emits on both sides.
std::optional<SurfacePoint> surfacePoint(const TraceScene& trace, const Hit& hit);

/// A surface point as the eye sees it.
struct GlossyPoint {
    SurfacePoint surface;
    Gloss gloss;
    glm::vec3 toEye{0}; ///< unit

    /// Radiance to the eye of what comes straight from a light: diffuse and glossy.
    glm::vec3 reflect(glm::vec3 irradiance, glm::vec3 toLight) const;
};

/// `p` as the ray that found it by `hit` sees it.
GlossyPoint glossyPoint(const TraceScene& trace, const Hit& hit, const Ray& ray,
                        const SurfacePoint& p);

/// Just outside the surface, where rays to its front start.
glm::vec3 rayOrigin(const TraceScene& trace, const SurfacePoint& p);

} // namespace limn
