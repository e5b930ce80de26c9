// SPDX-License-Identifier: MIT
#include "editor_ui/view/light_handles.h"

#include "editor_ui/document/light_angles.h"
#include "editor_ui/document/object_rules.h"
#include "editor_ui/panels/theme.h"
#include "engine/scene/light/rectangle_light.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>

namespace limn {

namespace {

constexpr float kGripPixels = 8;
constexpr float kReach = 1.6f;       ///< of direction and cone, in lengths of an arrow
constexpr float kInnerReach = 1.2f;  ///< of the inner cone, whose grip may lie on the direction
constexpr float kAlongSight = 0.95f; ///< cosine from which a light counts as seen from its front
constexpr float kMinCone = 0.5f;     ///< [degrees], as in the inspector
constexpr int kCircleSteps = 48;

/// A unit vector across the light's direction, in the picture's plane where there is one.
glm::vec3 acrossLight(const Picture& picture, const Light& light) {
    const glm::vec3 eye = towardsEye(picture, light.position);
    const glm::vec3 across = glm::cross(light.direction, eye);
    if (glm::length(across) > 0.1f)
        return glm::normalize(across);
    const glm::vec3 other =
        std::abs(light.direction.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    return glm::normalize(glm::cross(light.direction, other));
}

/// Where the cone's grip is; the inner one's is opposite.
glm::vec3 coneSide(const Picture& picture, const Light& light, LightPart part) {
    return acrossLight(picture, light) * (part == LightPart::InnerCone ? -1.f : 1.f);
}

float reachOf(const Picture& picture, const Light& light, LightPart part) {
    return (part == LightPart::InnerCone ? kInnerReach : kReach) *
           arrowLength(picture, light.position);
}

float angleOf(const Light& light, LightPart part) {
    return part == LightPart::InnerCone ? light.innerAngle : light.outerAngle;
}

glm::vec3 conePoint(const Light& light, glm::vec3 across, float angle, float reach) {
    return light.position + (light.direction * std::cos(angle) + across * std::sin(angle)) * reach;
}

/// The direction in which the range is shown.
glm::vec3 rangeAxis(const Picture& picture, const Light& light) {
    const glm::mat3 view = glm::transpose(glm::mat3(viewMatrix(picture.camera)));
    return light.kind == LightKind::Point ? view[0] : light.direction;
}

GizmoFrame frameAlong(glm::vec3 origin, glm::vec3 axis) {
    return {origin, {axis, axis, axis}}; // only its X is dragged
}

} // namespace

std::vector<LightGrip> lightGrips(const Picture& picture, const Light& light) {
    std::vector<LightGrip> grips;
    if (hasDirection(light))
        grips.push_back(
            {LightPart::Direction,
             light.position + light.direction * reachOf(picture, light, LightPart::Direction)});
    if (light.kind == LightKind::Spot)
        for (LightPart part : {LightPart::OuterCone, LightPart::InnerCone})
            grips.push_back({part, conePoint(light, coneSide(picture, light, part),
                                             angleOf(light, part), reachOf(picture, light, part))});
    if (light.kind == LightKind::Rectangle) {
        const LightRectangle r = lightRectangle(light);
        grips.push_back({LightPart::Width, r.centre + r.halfWidth});
        grips.push_back({LightPart::Height, r.centre + r.halfHeight});
    }
    const bool limited = light.kind == LightKind::Point || light.kind == LightKind::Spot;
    if (limited && light.range > 0)
        grips.push_back(
            {LightPart::Range, light.position + rangeAxis(picture, light) * light.range});
    return grips;
}

/// A grip and its pixel in the picture.
struct ShownGrip {
    LightGrip grip;
    glm::vec2 pixel;
};

/// The grips in front of the camera that do not lie on the handle that moves the light, as those of
/// a small or far rectangle do.
static std::vector<ShownGrip> shownGrips(const Picture& picture, const Light& light) {
    std::vector<ShownGrip> shown;
    const auto middle = toPixel(picture, light.position);
    if (!middle)
        return shown;
    for (const LightGrip& grip : lightGrips(picture, light)) {
        const auto pixel = toPixel(picture, grip.position);
        if (pixel && glm::length(*pixel - *middle) >= 2 * kGripPixels)
            shown.push_back({grip, *pixel});
    }
    return shown;
}

LightPart lightPartAt(const Picture& picture, const Light& light, glm::vec2 mouse) {
    LightPart found = LightPart::None;
    float best = kGripPixels;
    for (const auto& [grip, pixel] : shownGrips(picture, light))
        if (const float d = glm::length(pixel - mouse); d < best)
            best = d, found = grip.part;
    return found;
}

/// Angle from the light's direction at which the mouse is, on the side of the cone's grip [rad].
static std::optional<float> angleAt(const Picture& picture, const Light& light, LightPart part,
                                    glm::vec2 start, glm::vec2 now) {
    const float reach = reachOf(picture, light, part), angle = angleOf(light, part);
    const glm::vec3 across = coneSide(picture, light, part);
    const glm::vec3 eye = towardsEye(picture, light.position);
    const bool fromFront = std::abs(glm::dot(light.direction, eye)) > kAlongSight;
    // Seen from its front a cone is a circle, whose radius is dragged; else a wedge.
    const glm::vec3 grip = conePoint(light, across, angle, reach);
    const GizmoFrame frame{grip, {across, light.direction, glm::cross(across, light.direction)}};
    const auto moved = fromFront ? dragDisplacement(picture, Handle::X, frame, start, now)
                                 : dragDisplacement(picture, Handle::XY, frame, start, now);
    if (!moved)
        return {};
    const glm::vec3 offset = grip + *moved - light.position;
    const float depth = glm::dot(offset, light.direction);
    return std::atan2(std::max(glm::dot(offset, across), 0.f),
                      fromFront ? std::max(depth, 0.1f * reach) : depth);
}

static std::optional<Light> draggedCone(const Picture& picture, Light light, LightPart part,
                                        glm::vec2 start, glm::vec2 now) {
    const auto angle = angleAt(picture, light, part, start, now);
    if (!angle)
        return {};
    if (part == LightPart::OuterCone)
        light.outerAngle = std::clamp(*angle, glm::radians(kMinCone), glm::half_pi<float>());
    else
        light.innerAngle = *angle;
    light.innerAngle = std::min(light.innerAngle, 0.99f * light.outerAngle);
    return light;
}

static std::optional<Light> aimedLight(const Picture& picture, Light light, glm::vec2 now,
                                       std::optional<glm::vec3> aim) {
    if (!aim) {
        const glm::vec3 ray = pixelDirection(picture, now), eye = picture.camera.eye;
        const glm::vec3 sight = -towardsEye(picture, light.position);
        const float facing = glm::dot(ray, sight);
        if (!(facing > 0.01f))
            return {};
        aim = eye + ray * (glm::length(light.position - eye) / facing);
    }
    const glm::vec3 direction = *aim - light.position;
    if (!(glm::length(direction) > 1e-6f))
        return {};
    light.direction = glm::normalize(direction);
    return light;
}

/// The light's `length` after a drag of its grip, which lies length / times from `origin`.
static std::optional<float> draggedLength(const Picture& picture, glm::vec3 origin, glm::vec3 axis,
                                          float length, float times, glm::vec2 start,
                                          glm::vec2 now) {
    const glm::vec3 grip = origin + axis * (length / times);
    const auto moved = dragDisplacement(picture, Handle::X, frameAlong(grip, axis), start, now);
    return moved ? std::optional(std::abs(length + times * glm::dot(*moved, axis))) : std::nullopt;
}

static std::optional<Light> draggedSize(const Picture& picture, Light light, int side,
                                        glm::vec2 start, glm::vec2 now) {
    const LightRectangle r = lightRectangle(light);
    const glm::vec3 axis = glm::normalize(side == 0 ? r.halfWidth : r.halfHeight);
    const auto size = draggedLength(picture, light.position, axis, light.size[side], 2, start, now);
    if (!size)
        return {};
    light.size[side] = std::clamp(*size, kMinLightSize, kMaxLightSize);
    return light;
}

static std::optional<Light> draggedRange(const Picture& picture, Light light, glm::vec2 start,
                                         glm::vec2 now) {
    const auto range = draggedLength(picture, light.position, rangeAxis(picture, light),
                                     light.range, 1, start, now);
    if (!range)
        return {};
    light.range = std::max(*range, 1e-3f * light.range); // 0 would be no limit at all
    return light;
}

static std::optional<Light> dragged(const Picture& picture, const Light& light, LightPart part,
                                    glm::vec2 start, glm::vec2 now, std::optional<glm::vec3> aim) {
    switch (part) {
    case LightPart::Direction:
        return aimedLight(picture, light, now, aim);
    case LightPart::OuterCone:
    case LightPart::InnerCone:
        return draggedCone(picture, light, part, start, now);
    case LightPart::Range:
        return draggedRange(picture, light, start, now);
    case LightPart::Width:
    case LightPart::Height:
        return draggedSize(picture, light, part == LightPart::Width ? 0 : 1, start, now);
    case LightPart::None:
        break;
    }
    return {};
}

std::optional<Light> draggedLight(const Picture& picture, const Light& light, LightPart part,
                                  glm::vec2 start, glm::vec2 now, std::optional<glm::vec3> aim) {
    const auto after = dragged(picture, light, part, start, now, aim);
    return after && isValid(*after) ? after : std::nullopt;
}

static void drawLine(const Picture& picture, glm::vec3 from, glm::vec3 to, ImU32 color,
                     float width) {
    const auto a = toPixel(picture, from), b = toPixel(picture, to);
    if (a && b)
        ImGui::GetWindowDrawList()->AddLine({a->x, a->y}, {b->x, b->y}, color, width);
}

static void drawCone(const Picture& picture, const Light& light, LightPart part, ImU32 color,
                     float width) {
    const float reach = reachOf(picture, light, part), angle = angleOf(light, part);
    const glm::vec3 middle = light.position + light.direction * (reach * std::cos(angle));
    const auto pointAt = [&](int step) {
        return ringPoint(middle, light.direction, reach * std::sin(angle),
                         glm::two_pi<float>() * float(step) / kCircleSteps);
    };
    for (int i = 0; i < kCircleSteps; ++i)
        drawLine(picture, pointAt(i), pointAt(i + 1), color, width);
    const glm::vec3 across = acrossLight(picture, light);
    for (float side : {-1.f, 1.f})
        drawLine(picture, light.position, conePoint(light, side * across, angle, reach), color,
                 width);
}

void drawLightHandles(const Picture& picture, const Light& light, LightPart lit) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    constexpr ImU32 kFaint = IM_COL32(255, 225, 110, 150);
    if (light.kind == LightKind::Spot) {
        drawCone(picture, light, LightPart::OuterCone, kFaint, 1.5f);
        drawCone(picture, light, LightPart::InnerCone, kFaint, 1);
    }
    for (const auto& [grip, pixel] : shownGrips(picture, light)) {
        if (grip.part == LightPart::Direction || grip.part == LightPart::Range)
            drawLine(picture, light.position, grip.position, kFaint, 1);
        const ImU32 ink = grip.part == lit ? color::kHandleLit : IM_COL32(235, 235, 235, 255);
        const ImVec2 centre(pixel.x, pixel.y);
        list.AddCircleFilled(centre, 6.5f, color::kGround);
        list.AddCircleFilled(centre, 4.5f, ink);
    }
}

const char* lightPartLabel(LightPart part) {
    switch (part) {
    case LightPart::Direction:
        return "Light direction";
    case LightPart::OuterCone:
        return "Light cone";
    case LightPart::InnerCone:
        return "Light inner cone";
    case LightPart::Range:
        return "Light range";
    case LightPart::Width:
    case LightPart::Height:
        return "Light size";
    case LightPart::None:
        break;
    }
    return "";
}

std::string lightPartText(const Light& light, LightPart part) {
    switch (part) {
    case LightPart::Direction: {
        const LightAngles angles = lightAngles(light.direction);
        return fmt::format("Elevation {:.1f}\u00b0, azimuth {:.1f}\u00b0", angles.elevation,
                           angles.azimuth);
    }
    case LightPart::OuterCone:
        return fmt::format("Cone {:.1f}\u00b0", glm::degrees(light.outerAngle));
    case LightPart::InnerCone:
        return fmt::format("Full inside {:.1f}\u00b0", glm::degrees(light.innerAngle));
    case LightPart::Range:
        return fmt::format("Range {:.3f} m", light.range);
    case LightPart::Width:
        return fmt::format("Width {:.3f} m", light.size.x);
    case LightPart::Height:
        return fmt::format("Height {:.3f} m", light.size.y);
    case LightPart::None:
        break;
    }
    return {};
}

} // namespace limn
