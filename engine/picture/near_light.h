// SPDX-License-Identifier: MIT
#pragma once

#include "engine/field/indirect_field.h"
#include "engine/lightmap/layout/lightmap_layout.h"
#include "engine/picture/light_sink.h"
#include "engine/shading/sampler.h"
#include "engine/shading/surface_point.h"
#include "engine/trace/trace_scene.h"

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/gtc/constants.hpp>

namespace limn {

/// Input of the functions below, made by nearLight(). `layout` belongs to the field.
struct NearLight {
    const TraceScene& trace;
    const IndirectField& field;
    const LightmapLayout& layout;
    std::vector<float> reach; ///< nearReaches(); empty if there are no rays
    std::uint32_t rays = 0;   ///< number for each estimate; 0: no correction
};
NearLight nearLight(const TraceScene& trace, const IndirectField& field,
                    const LightmapLayout& layout, std::uint32_t rays);

/// A near surface, hit by one ray, whose radiance replaces the field's.
struct NearSurface {
    Hit hit;
    std::optional<SurfacePoint> point; ///< none: the black back of a one-sided surface
    glm::vec3 direction{0};            ///< direction of the ray, unit
    float weight = 0; ///< weight of its radiance less the field's in the irradiance to add [sr]
    Sampler sampler;  ///< for its direct light: pair(kNearPick), pair(kNearOnLight)
};
inline constexpr std::uint32_t kNearPick = 1, kNearOnLight = 2;

/// Finds the surfaces that near.rays rays from point `p`, found by `hit`, meet: static ones with a
/// lightmap, within reach. Emissive ones are left out, because lightmaps have finer texels near
/// them.
std::vector<NearSurface> findNearSurfaces(const NearLight& near, const Hit& hit,
                                          const SurfacePoint& p, const Sampler& sampler);

/// Walks an unbiased estimate of the irradiance [W m^-2] to add to the field's at point `p`: the
/// light that each near surface sends, less what the field says arrives from its direction. The
/// surface sends direct light with traced shadows and the field's light there. The estimate may be
/// negative. The sum of its mean and the field's irradiance is negative only where the field's
/// harmonics ring. The estimate is 0 where no surface is near.
///
/// Arikan, Forsyth, O'Brien. Fast and Detailed Approximate Global Illumination by Irradiance
/// Decomposition. 2005. They separate irradiance into near and distant light and sample the latter
/// alone; here the field has both and is a control variate of near light.
template <PixelSink Sink>
void walkNearLight(const NearLight& near, const Hit& hit, const SurfacePoint& p,
                   const Sampler& sampler, Sink& sink) {
    const Scene& scene = near.trace.scene();
    const FieldPoint receiver = fieldPoint(near.field, near.layout, scene, hit, p);
    const auto sentLight = [&](const NearSurface& s) {
        const LightNumbers numbers{s.sampler.pair(kNearPick).x, s.sampler.pair(kNearOnLight)};
        sink.nearDirectLight(*s.point, numbers, s.hit.instance);
        sink.fieldIrradiance(fieldPoint(near.field, near.layout, scene, s.hit, *s.point),
                             glm::vec3(1), GatherPart::Shown);
    };
    for (const NearSurface& s : findNearSurfaces(near, hit, p, sampler))
        sink.scaled(glm::vec3(s.weight), [&] {
            if (s.point && sink.reflects(s.hit.instance))
                sink.scaled(s.point->albedo / glm::pi<float>(), [&] { sentLight(s); });
            sink.fieldRadiance(receiver, s.direction, glm::vec3(-1));
        });
}

/// The value of the estimate that walkNearLight() walks.
glm::vec3 nearCorrection(const NearLight& near, const Hit& hit, const SurfacePoint& p,
                         const Sampler& sampler);

} // namespace limn
