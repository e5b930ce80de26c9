// SPDX-License-Identifier: MIT
#pragma once

#include "engine/scene/surface/specular.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <optional>

namespace limn {

/// Sum of the channels, which is above 0 where there is light of any color.
inline float channelSum(glm::vec3 light) {
    return light.x + light.y + light.z;
}

/// A Lambertian surface point at a ray's hit. Its normals face the side that the ray came from.
struct SurfacePoint {
    glm::vec3 position{0};
    glm::vec3 geometricNormal{0}; ///< unit
    glm::vec3 normal{0};          ///< unit, that of shading; see NormalDetail
    glm::vec3 albedo{0};
    glm::vec3 emission{0}; ///< [nits]
};

/// What normals of shading follow.
enum class NormalDetail : std::uint8_t {
    Map, ///< the vertices' normals, bent by the normal map where there is one
    Mesh ///< the vertices' normals alone: texels are wider than the details of normal maps
};

/// Unit normal of shading at a hit, on the side that the ray came from.
glm::vec3 shadingNormalAt(const Scene& scene, const Hit& hit,
                          NormalDetail detail = NormalDetail::Map);

/// Surface point at a hit. Returns std::nullopt for the back of a one-sided surface, which is black
/// and blocks light. A double-sided surface reflects and emits on both sides.
std::optional<SurfacePoint> surfacePoint(const TraceScene& trace, const Hit& hit,
                                         NormalDetail detail = NormalDetail::Map);

/// A surface point with its reflection towards the eye.
struct GlossyPoint {
    SurfacePoint surface;
    Gloss gloss;
    glm::vec3 toEye{0}; ///< unit

    /// Radiance towards the eye, diffuse and glossy, of direct light from direction `toLight`.
    glm::vec3 reflect(glm::vec3 irradiance, glm::vec3 toLight) const;
};

/// Surface point `p`, found by `ray` with `hit`, as seen from the ray's origin.
GlossyPoint glossyPoint(const TraceScene& trace, const Hit& hit, const Ray& ray,
                        const SurfacePoint& p);

/// Point just outside the surface where rays on its front side start.
glm::vec3 rayOrigin(const TraceScene& trace, const SurfacePoint& p);

} // namespace limn
