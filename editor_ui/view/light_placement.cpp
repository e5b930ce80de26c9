// SPDX-License-Identifier: MIT
#include "editor_ui/view/light_placement.h"

#include "editor_ui/document/light_angles.h"
#include "editor_ui/document/object_rules.h"
#include "editor_ui/editor_state.h"
#include "editor_ui/view/camera_control.h"
#include "editor_ui/view/picking.h"
#include "editor_ui/view/pivot.h"
#include "engine/math/sampling.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr std::uint32_t kProbeRays = 64;
constexpr float kIrradiance = 5, kSunIrradiance = 10; // at 0 EV [W m^-2]
constexpr float kSpotGain = 3;         // a spot lights one side; it may be brighter there
constexpr float kRectangleSide = 0.2f; // of the distance to what it lights

/// How far off a surface a light stands, as a fraction of the free distance before the surface.
float clearance(LightKind kind) {
    return kind == LightKind::Rectangle ? 0.01f : 0.1f;
}

} // namespace

/// Radius of the scene; 1 m for a scene without extent.
static float sceneRadius(const EditorState& state) {
    const float radius = glm::length(state.sceneBounds.size()) / 2;
    return radius > 0 && std::isfinite(radius) ? radius : 1;
}

/// Distance from `from` to the nearest surface along the unit vector `direction`, at most the
/// scene's diameter [m].
static float freeDistance(const EditorState& state, glm::vec3 from, glm::vec3 direction) {
    const float maxDistance = 2 * sceneRadius(state);
    if (!state.trace)
        return maxDistance;
    const Hit hit = state.trace->closestHit({from, direction}, TraceMask::Seen);
    return hit ? std::min(hit.t, maxDistance) : maxDistance;
}

/// Distance from `from` along the unit vector `direction` to the side of the scene's box; at least
/// a tenth of its diameter, for surfaces that are its side [m].
static float distanceToBounds(const EditorState& state, glm::vec3 from, glm::vec3 direction) {
    float nearest = 2 * sceneRadius(state);
    for (int axis = 0; axis < 3; ++axis)
        if (const float d = direction[axis]; std::abs(d) > 1e-6f) {
            const Bounds& b = state.sceneBounds;
            nearest = std::min(nearest, ((d > 0 ? b.upper : b.lower)[axis] - from[axis]) / d);
        }
    return std::max(nearest, 0.2f * sceneRadius(state));
}

/// Median of the free distances around a point [m].
static float medianDistance(const EditorState& state, glm::vec3 from) {
    const DirectionSet directions(kProbeRays, true, 0);
    std::vector<float> distances(kProbeRays);
    for (std::uint32_t i = 0; i < kProbeRays; ++i)
        distances[i] = freeDistance(state, from, directions[i]);
    std::ranges::nth_element(distances, distances.begin() + kProbeRays / 2);
    return distances[kProbeRays / 2];
}

float roundedToTwoDigits(float value) {
    if (!(value > 0))
        return 0;
    const float unit = std::pow(10.f, std::floor(std::log10(value)) - 1);
    return std::round(value / unit) * unit;
}

static Light fitted(const EditorState& state, Light light) {
    const float exposed = std::exp2(-state.view.exposureEv);
    const float distance = medianDistance(state, light.position);
    const float intensity = kIrradiance * exposed * distance * distance;
    switch (light.kind) {
    case LightKind::Directional:
        light.strength = kSunIrradiance * exposed;
        break;
    case LightKind::Point:
        light.strength = intensity;
        break;
    case LightKind::Spot:
        light.strength = kSpotGain * intensity;
        break;
    case LightKind::Rectangle: {
        const float side =
            std::clamp(roundedToTwoDigits(kRectangleSide * distance), kMinLightSize, kMaxLightSize);
        light.size = glm::vec2(side);
        light.strength = intensity / (side * side);
        break;
    }
    }
    light.strength = std::min(roundedToTwoDigits(light.strength), kMaxLight);
    return light;
}

static Light newLight(LightKind kind) {
    Light light;
    light.kind = kind;
    const bool sun = kind == LightKind::Directional;
    light.name = sun ? "Sun" : lightKindName(kind);
    if (sun)
        light.direction = kNewSunDirection;
    return light;
}

Light lightAtPixel(const EditorState& state, LightKind kind, glm::vec2 pixel) {
    Light light = newLight(kind);
    const Hit hit = hitUnder(state, pixel);
    if (!hit) {
        light.position = pivotUnder(state, pixel);
        return fitted(state, light);
    }
    const glm::vec3 normal = hit.frontFace ? hit.geometricNormal : -hit.geometricNormal;
    // The ray's end may lie behind the surface by rounding; it begins clear of it.
    const glm::vec3 start = hit.position + normal * (1e-4f * sceneRadius(state));
    const float room =
        std::min(freeDistance(state, start, normal), distanceToBounds(state, start, normal));
    light.position = start + normal * (clearance(kind) * room);
    if (kind != LightKind::Directional)
        light.direction = normal;
    return fitted(state, light);
}

Light lightBeforeCamera(const EditorState& state, LightKind kind) {
    const ViewState& view = state.view;
    const glm::vec3 ahead = forward(view.camera);
    const glm::vec3 seen = pivotUnder(state, view.origin + view.size * 0.5f);
    const float back = std::min(glm::length(seen - view.camera.eye), 0.5f * sceneRadius(state)) / 2;
    Light light = newLight(kind);
    light.position = seen - ahead * back;
    return fitted(state, light);
}

} // namespace limn
