// SPDX-License-Identifier: MIT
#include "engine/render/shadows/shadow_maps.h"

#include "engine/scene/light/rectangle_light.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace limn::render {

namespace {

// A spot wider than this would waste most of one map on its rim.
constexpr float kWidestSpot = 1.2f; // [rad], half-angle

// Texels beyond a face's edge that filtering near the edge may read: two, plus the offset by the
// bias.
constexpr float kMarginTexels = 4;

glm::vec3 upFor(glm::vec3 axis) {
    return std::abs(axis.y) > 0.9f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
}

std::array<glm::vec3, 8> corners(const Bounds& b) {
    std::array<glm::vec3, 8> out;
    for (int i = 0; i < 8; ++i)
        out[std::size_t(i)] = {(i & 1) ? b.upper.x : b.lower.x, (i & 2) ? b.upper.y : b.lower.y,
                               (i & 4) ? b.upper.z : b.lower.z};
    return out;
}

// Orthographic view fitted to the scene's axis-aligned bounding box in light space.
ShadowView directionalView(const ShadowKey& key, const Bounds& bounds, std::uint32_t mapSize) {
    const glm::mat4 toLight = directionalFrame(key.direction);
    auto [lower, upper] = boundsInFrame(bounds, toLight);
    const glm::vec3 size = glm::max(upper - lower, glm::vec3(1e-6f * (1 + glm::length(upper))));
    const glm::vec3 margin(glm::vec2(size) * (kMarginTexels / float(mapSize)), 0.01f * size.z);
    lower -= margin;
    upper += margin;
    // orthoRH_ZO maps distance zNear to depth 0; the arguments are swapped for depth 1 near.
    const glm::mat4 projection =
        glm::orthoRH_ZO(lower.x, upper.x, lower.y, upper.y, -lower.z, -upper.z);
    ShadowView v;
    v.toClip = projection * toLight;
    v.gpu.axis = glm::vec4(key.direction, 0);
    v.gpu.texelSize = std::max(upper.x - lower.x, upper.y - lower.y) / float(mapSize);
    v.gpu.perspective = 0;
    return v;
}

ShadowView perspectiveView(glm::vec3 eye, glm::vec3 axis, float tanHalf, const Bounds& bounds,
                           std::uint32_t mapSize) {
    float zFar = 0;
    for (glm::vec3 p : corners(bounds))
        zFar = std::max(zFar, glm::length(p - eye));
    zFar = std::max(zFar * 1.01f, 1e-6f);
    // Depth runs from 1 to 0 in floating point, so a near plane this close costs no precision.
    const float zNear = zFar * float(SHADOW_NEAR);
    const float wide = tanHalf * (1 + 2 * kMarginTexels / float(mapSize));
    ShadowView v;
    v.toClip = glm::perspectiveRH_ZO(2 * std::atan(wide), 1.f, zFar, zNear) *
               glm::lookAtRH(eye, eye + axis, upFor(axis));
    v.gpu.axis = glm::vec4(axis, glm::dot(axis, eye));
    v.gpu.texelSize = 2 * wide / float(mapSize);
    v.gpu.perspective = 1;
    v.gpu.zFar = zFar;
    return v;
}

} // namespace

glm::mat4 directionalFrame(glm::vec3 direction) {
    return glm::lookAtRH(glm::vec3(0), direction, upFor(direction));
}

Bounds boundsInFrame(const Bounds& bounds, const glm::mat4& frame) {
    return boundsOf(corners(bounds) | std::views::transform([&](glm::vec3 p) {
                        return glm::vec3(frame * glm::vec4(p, 1));
                    }));
}

ShadowKey shadowKey(const Light& light) {
    ShadowKey key{.kind = light.kind};
    if (light.kind != LightKind::Directional)
        key.position = light.position;
    if (light.kind == LightKind::Directional || light.kind == LightKind::Spot)
        key.direction = light.direction;
    if (light.kind == LightKind::Spot)
        key.outerAngle = light.outerAngle;
    if (light.kind == LightKind::Rectangle) {
        const LightRectangle r = lightRectangle(light);
        key.halfWidth = r.halfWidth;
        key.halfHeight = r.halfHeight;
    }
    return key;
}

bool ShadowKeyOrder::operator()(const ShadowKey& a, const ShadowKey& b) const {
    const auto numbers = [](const ShadowKey& k) {
        return std::array{float(k.kind),  k.position.x,  k.position.y,  k.position.z,
                          k.direction.x,  k.direction.y, k.direction.z, k.outerAngle,
                          k.halfWidth.x,  k.halfWidth.y, k.halfWidth.z, k.halfHeight.x,
                          k.halfHeight.y, k.halfHeight.z};
    };
    return numbers(a) < numbers(b);
}

std::uint32_t shadowViewCount(const ShadowKey& key) {
    const bool narrow = key.kind == LightKind::Spot && key.outerAngle <= kWidestSpot;
    return key.kind == LightKind::Directional || narrow ? SHADOW_SINGLE
           : key.kind == LightKind::Rectangle           ? SHADOW_RECTANGLE
                                                        : SHADOW_CUBE;
}

// In the order of cubeFace() in direct.frag.
static void addCube(glm::vec3 eye, const Bounds& bounds, std::uint32_t mapSize,
                    std::vector<ShadowView>& views) {
    for (glm::vec3 axis : {glm::vec3(1, 0, 0), glm::vec3(-1, 0, 0), glm::vec3(0, 1, 0),
                           glm::vec3(0, -1, 0), glm::vec3(0, 0, 1), glm::vec3(0, 0, -1)})
        views.push_back(perspectiveView(eye, axis, 1, bounds, mapSize));
}

std::vector<ShadowView> shadowViews(const ShadowKey& key, const Bounds& bounds,
                                    std::uint32_t mapSize) {
    if (key.kind == LightKind::Directional)
        return {directionalView(key, bounds, mapSize)};
    if (shadowViewCount(key) == SHADOW_SINGLE)
        return {perspectiveView(key.position, key.direction, std::tan(key.outerAngle), bounds,
                                mapSize)};
    std::vector<ShadowView> views;
    if (key.kind == LightKind::Rectangle) // in the order of quarter() in rectangle_shadow.glsl
        for (int k = 0; k < 4; ++k)
            addCube(key.position + ((k & 1) ? 0.5f : -0.5f) * key.halfWidth +
                        ((k & 2) ? 0.5f : -0.5f) * key.halfHeight,
                    bounds, mapSize, views);
    else
        addCube(key.position, bounds, mapSize, views);
    return views;
}

} // namespace limn::render
