// SPDX-License-Identifier: MIT
#include "engine/rsm/gpu/rsm_maps.h"

#include "engine/scene/light/photometry.h"
#include "engine/scene/light/unit_light.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

namespace limn {

namespace {

static_assert(std::uint32_t(LightKind::Directional) == RSM_LIGHT_SUN &&
              std::uint32_t(LightKind::Point) == RSM_LIGHT_POINT &&
              std::uint32_t(LightKind::Spot) == RSM_LIGHT_SPOT &&
              std::uint32_t(LightKind::Rectangle) == RSM_LIGHT_RECTANGLE);

constexpr float kNear = 1e-5f; // near plane, of the distance of the farthest corner of the scene

/// Moves a point off a surface by more than positions there are rounded.
glm::vec3 clearOf(glm::vec3 p, glm::vec3 normal, const Bounds& bounds) {
    const float coordinate = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    return p + normal * (0x1p-19f * coordinate + 0x1p-20f * glm::length(bounds.size()));
}

/// Distances of the scene's farthest corner, along the view and in all.
struct Reach {
    float along = 0, distance = 0;
};

Reach reachOf(const RsmView& view, const Bounds& bounds) {
    Reach reach;
    for (int k = 0; k < 8; ++k) {
        const glm::vec3 corner((k & 1) ? bounds.upper.x : bounds.lower.x,
                               (k & 2) ? bounds.upper.y : bounds.lower.y,
                               (k & 4) ? bounds.upper.z : bounds.lower.z);
        reach.along = std::max(reach.along, glm::dot(corner - view.origin, view.forward));
        reach.distance = std::max(reach.distance, glm::length(corner - view.origin));
    }
    return reach;
}

/// The distance of which a view's depths are a share, as GpuRsmView::depthUnit.
float depthUnit(const RsmView& view, const Bounds& bounds) {
    const Reach reach = reachOf(view, bounds);
    return view.parallel ? 1.01f * reach.along : std::max(kNear * reach.distance, 1e-11f);
}

/// The projection whose texels are those of the view. Depth is 1 - distance / unit of a parallel
/// view and unit / distance of others.
glm::mat4 toClip(const RsmView& view, float unit) {
    const auto row = [&](glm::vec3 axis, float at0) {
        return glm::vec4(axis, at0 - glm::dot(axis, view.origin));
    };
    const glm::vec4 x = row(view.right / glm::dot(view.right, view.right), 0),
                    y = row(view.up / glm::dot(view.up, view.up), 0);
    const glm::vec4 z = view.parallel ? row(-view.forward / unit, 1) : glm::vec4(0, 0, 0, unit);
    const glm::vec4 w = view.parallel ? glm::vec4(0, 0, 0, 1) : row(view.forward, 0);
    return glm::transpose(glm::mat4(x, y, z, w));
}

shared::GpuRsmView forShaders(const Light& light, const RsmView& view, float unit) {
    const float cosOuter = std::cos(light.outerAngle),
                cosInner = std::max(std::cos(light.innerAngle), cosOuter + 1e-4f);
    return {.origin = view.origin,
            .power = view.power,
            .forward = view.forward,
            .texelArea = view.texelArea(),
            .right = view.right,
            .depthUnit = unit,
            .up = view.up,
            .mapSize = view.size,
            .direction = light.direction,
            .kind = std::uint32_t(light.kind),
            .range = light.range,
            .cosOuter = cosOuter,
            .spotScale = 1 / (cosInner - cosOuter),
            .parallel = view.parallel};
}

} // namespace

std::vector<DrawnRsmView> drawnRsmViews(const Light& light, const Bounds& bounds,
                                        std::uint32_t size) {
    std::vector<RsmView> views = rsmViews(light, bounds, size, [&](glm::vec3 p, glm::vec3 normal) {
        return clearOf(p, normal, bounds);
    });
    for (RsmView& view : views) // shaders know no profiles
        view.power *= withoutProfile(unitLight(light)).strength;
    std::vector<DrawnRsmView> drawn;
    for (std::uint32_t k = 0; k < views.size(); ++k) {
        RsmView view = views[k];
        if (light.kind == LightKind::Rectangle && glm::dot(view.forward, light.direction) < -0.99f)
            continue; // it sends nothing behind itself
        const bool turned = glm::dot(glm::cross(view.right, view.up), view.forward) > 0;
        if (turned)
            std::swap(view.right, view.up); // the same texels, in another order
        const float unit = depthUnit(view, bounds);
        drawn.push_back({view, {toClip(view, unit)}, forShaders(light, view, unit), k, turned});
    }
    return drawn;
}

void writeRsmImages(gpu::Device& device, VkDescriptorSet set, const SurfaceMap& map) {
    gpu::writeTexture(device, set, RSM_ALBEDO, map.albedo, map.sampler);
    gpu::writeTexture(device, set, RSM_SURFACE, map.surface, map.sampler);
    gpu::writeTexture(device, set, RSM_DEPTH, map.depth, map.sampler);
}

} // namespace limn
