// SPDX-License-Identifier: MIT
#include "engine/rsm/reflective_shadow_map.h"

#include "engine/core/parallel.h"
#include "engine/math/sampling.h"
#include "engine/scene/light/rectangle_light.h"
#include "engine/scene/light/unit_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr float kWidestSpotView = 1.0471976f; ///< 60 degrees
constexpr float kMinCosine = 0.05f;           ///< of footprints of texels seen at a grazing angle

void addCube(std::vector<RsmView>& views, glm::vec3 origin, const glm::mat3& axes,
             std::uint32_t size, float power) {
    for (int face = 0; face < 6; ++face) {
        const int axis = face / 2;
        views.push_back({.origin = origin,
                         .forward = axes[axis] * (face % 2 == 0 ? 1.f : -1.f),
                         .right = axes[(axis + 1) % 3],
                         .up = axes[(axis + 2) % 3],
                         .size = size,
                         .power = power});
    }
}

/// Share of the light that leaves in a direction.
float emittedShare(const Light& light, glm::vec3 direction) {
    const float cosine = glm::dot(direction, light.direction);
    if (light.kind == LightKind::Rectangle)
        return std::max(cosine, 0.f);
    return light.kind != LightKind::Spot || cosine > std::cos(light.outerAngle) ? 1.f : 0.f;
}

/// Window of range and cone of a point or spot light at a point; 1 for others.
float windowAt(const Light& light, glm::vec3 p) {
    if (light.kind != LightKind::Point && light.kind != LightKind::Spot)
        return 1;
    const LightSample s = sampleLight(light, p);
    return s.irradiance.x * s.distance * s.distance;
}

/// What the texel at `place` of a view sees; none where that is dark. Counts the ray, if it needs
/// one. Does not set RsmTexel::view.
std::optional<RsmTexel> castTexel(const TraceScene& trace, const Scene& scene, const Light& light,
                                  const RsmView& view, glm::uvec2 place, std::uint32_t& rays) {
    const glm::vec2 ndc = (glm::vec2(place) + 0.5f) * (2 / float(view.size)) - 1.f;
    const glm::vec3 across = ndc.x * view.right + ndc.y * view.up;
    Ray ray{view.origin, view.forward};
    float spread = view.texelArea(), share = 1;
    if (view.parallel) {
        ray.origin += across;
    } else {
        const glm::vec3 way = view.forward + across;
        const float distance = glm::length(way);
        spread /= distance * distance * distance;
        ray.direction = way / distance;
        ray.tNear = trace.epsilonAt(view.origin); // a lamp on a wall is not hidden by it
        share = emittedShare(light, ray.direction);
    }
    if (!(share > 0))
        return {};
    ++rays;
    const Hit hit = trace.closestHit(ray, TraceMask::Seen);
    if (!hit)
        return {};
    const Instance& instance = scene.instances[hit.instance];
    if (!hit.frontFace && !isTwoSided(scene.materialOf(instance)))
        return {};
    RsmTexel seen{.place = place,
                  .instance = hit.instance,
                  .triangle = hit.triangle,
                  .u = hit.u,
                  .v = hit.v,
                  .position = hit.position,
                  .normal = hit.frontFace ? hit.geometricNormal : -hit.geometricNormal,
                  .direction = ray.direction,
                  .area = view.parallel ? spread : spread * hit.t * hit.t};
    seen.incident = view.power * spread * share * windowAt(light, hit.position);
    const float cosine = std::max(-glm::dot(seen.normal, ray.direction), kMinCosine);
    seen.albedo =
        surfaceMaterialOver(scene, instance, hit.triangle, hit.u, hit.v, seen.area / cosine).albedo;
    if (!(seen.incident > 0))
        return {};
    return seen;
}

} // namespace

std::vector<RsmView>
rsmViews(const Light& light, const Bounds& bounds, std::uint32_t size,
         const std::function<glm::vec3(glm::vec3 p, glm::vec3 normal)>& clearOf) {
    std::vector<RsmView> views;
    const glm::mat3 axes = basisAround(light.direction);
    switch (light.kind) {
    case LightKind::Directional: {
        const glm::vec3 half = bounds.size() * 0.5f;
        const float radius = glm::length(half);
        const auto extent = [&](glm::vec3 axis) {
            return glm::dot(glm::abs(axis), half) + 1e-4f * radius;
        };
        if (radius > 0)
            views.push_back({.origin = bounds.centre() - light.direction * (1.01f * radius),
                             .forward = light.direction,
                             .right = axes[0] * extent(axes[0]),
                             .up = axes[1] * extent(axes[1]),
                             .parallel = true,
                             .size = size});
        break;
    }
    case LightKind::Point:
        addCube(views, light.position, glm::mat3(1), size, 1);
        break;
    case LightKind::Spot:
        if (light.outerAngle <= kWidestSpotView)
            views.push_back({.origin = light.position,
                             .forward = light.direction,
                             .right = axes[0] * std::tan(light.outerAngle),
                             .up = axes[1] * std::tan(light.outerAngle),
                             .size = size});
        else
            addCube(views, light.position, axes, size, 1);
        break;
    case LightKind::Rectangle: {
        const LightRectangle rectangle = lightRectangle(light);
        for (const glm::vec2 uv :
             {glm::vec2(0.25f), glm::vec2(0.75f, 0.25f), glm::vec2(0.25f, 0.75f), glm::vec2(0.75f)})
            addCube(views, clearOf(rectangle.at(uv), rectangle.normal), axes,
                    std::max(size / 2, 1U), rectangle.area / 4);
        break;
    }
    }
    return views;
}

ReflectiveShadowMap castRsm(const TraceScene& trace, const Scene& scene, const Light& light,
                            std::uint32_t size, const Progress& progress, RsmTexels kept) {
    const Light unit = unitLight(light);
    struct Row {
        std::vector<RsmTexel> texels;
        std::uint32_t rays = 0;
    };
    const std::vector<RsmView> views =
        rsmViews(unit, scene.bounds, size,
                 [&](glm::vec3 p, glm::vec3 normal) { return trace.clearOf(p, normal); });
    const std::size_t rowsOfView = views.empty() ? 0 : views[0].size; // all have the same size
    std::vector<Row> rows(views.size() * rowsOfView);
    parallelRanges(rows.size(), 4, progress, "shadow map", [&](std::size_t begin, std::size_t end) {
        for (std::size_t r = begin; r < end; ++r) {
            const RsmView& view = views[r / rowsOfView];
            for (std::uint32_t x = 0; x < view.size; ++x) {
                auto seen = castTexel(trace, scene, unit, view, {x, std::uint32_t(r % rowsOfView)},
                                      rows[r].rays);
                if (!seen || (kept == RsmTexels::Diffuse && seen->albedo == glm::vec3(0)))
                    continue;
                seen->view = std::uint32_t(r / rowsOfView);
                rows[r].texels.push_back(*seen);
            }
        }
    });
    ReflectiveShadowMap map;
    for (const Row& row : rows) {
        map.texels.insert(map.texels.end(), row.texels.begin(), row.texels.end());
        map.rays += row.rays;
    }
    return map;
}

} // namespace limn
