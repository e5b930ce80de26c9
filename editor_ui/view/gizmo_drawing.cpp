// SPDX-License-Identifier: MIT
#include "editor_ui/view/gizmo_drawing.h"

#include "editor_ui/panels/theme.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace limn {

namespace {

constexpr ImU32 kWhite = IM_COL32(235, 235, 235, 255);
constexpr int kRingSteps = 64;

ImVec2 toIm(glm::vec2 v) {
    return {v.x, v.y};
}

ImU32 handleColor(Handle handle, Handle lit) {
    if (handle == lit)
        return color::kHandleLit;
    switch (handle) {
    case Handle::X:
    case Handle::YZ:
        return color::kAxisX;
    case Handle::Y:
    case Handle::ZX:
        return color::kAxisY;
    case Handle::Z:
    case Handle::XY:
        return color::kAxisZ;
    case Handle::All:
        return kWhite;
    case Handle::None:
        break;
    }
    return 0;
}

} // namespace

/// X, Y or Z on a dark disc.
static void drawLetter(ImDrawList& list, Handle axis, glm::vec2 centre, ImU32 color) {
    const char* name = axis == Handle::X ? "X" : axis == Handle::Y ? "Y" : "Z";
    const ImVec2 size = ImGui::CalcTextSize(name);
    list.AddCircleFilled(toIm(centre), size.y * 0.55f, color::kGround);
    list.AddText({centre.x - size.x / 2, centre.y - size.y / 2}, color, name);
}

/// An axis that ends in an arrow, or in a square for scale.
static void drawAxis(ImDrawList& list, const Picture& picture, Tool tool, Handle handle,
                     const GizmoFrame& frame, ImU32 color) {
    const float length = arrowLength(picture, frame.origin);
    const auto from = toPixel(picture, frame.origin),
               to = toPixel(picture, arrowTip(handle, frame, length));
    if (!from || !to)
        return;
    const glm::vec2 d = *to - *from;
    const float pixels = glm::length(d);
    if (pixels < 6)
        return;
    const glm::vec2 along = d / pixels, across(-along.y, along.x);
    list.AddLine(toIm(*from), toIm(*to - along * 8.f), color, 3);
    if (tool == Tool::Scale)
        list.AddRectFilled({to->x - 6, to->y - 6}, {to->x + 6, to->y + 6}, color);
    else
        list.AddTriangleFilled(toIm(*to + along * 4.f), toIm(*to - along * 11.f + across * 6.f),
                               toIm(*to - along * 11.f - across * 6.f), color);
    drawLetter(list, handle, *to + along * (16 * uiScale()), color);
}

static void drawPlane(ImDrawList& list, const Picture& picture, Handle handle,
                      const GizmoFrame& frame, ImU32 color) {
    ImVec2 quad[4];
    std::size_t i = 0;
    for (glm::vec3 corner : planeHandle(handle, frame, arrowLength(picture, frame.origin))) {
        const auto p = toPixel(picture, corner);
        if (!p)
            return;
        quad[i++] = toIm(*p);
    }
    list.AddQuadFilled(quad[0], quad[1], quad[2], quad[3], (color & 0x00FFFFFF) | 0x50000000);
    list.AddQuad(quad[0], quad[1], quad[2], quad[3], color, 1.5f);
}

/// The half of a ring that faces the eye, and its letter an eighth of a turn from its middle.
static void drawRing(ImDrawList& list, const Picture& picture, Handle handle,
                     const GizmoFrame& frame, ImU32 color) {
    const float radius = arrowLength(picture, frame.origin);
    const glm::vec3 normal = frame.axes * handleAxis(handle);
    const glm::vec3 eye = towardsEye(picture, frame.origin);
    for (int i = 0; i < kRingSteps; ++i) {
        const auto pointAt = [&](int step) {
            return ringPoint(frame.origin, normal, radius,
                             glm::two_pi<float>() * float(step) / kRingSteps);
        };
        if (glm::dot(pointAt(i) + pointAt(i + 1) - 2.f * frame.origin, eye) < -0.04f * radius)
            continue;
        const auto a = toPixel(picture, pointAt(i)), b = toPixel(picture, pointAt(i + 1));
        if (a && b)
            list.AddLine(toIm(*a), toIm(*b), color, 3);
    }
    const glm::vec3 inPlane = eye - normal * glm::dot(eye, normal);
    const glm::vec3 middle = glm::length(inPlane) > 0.1f ? glm::normalize(inPlane)
                                                         : frame.axes[handle == Handle::X ? 1 : 0];
    const glm::vec3 side = glm::normalize(middle + glm::cross(normal, middle));
    if (const auto pixel = toPixel(picture, frame.origin + side * radius))
        drawLetter(list, handle, *pixel, color);
}

/// Rings of Rotate and Scale, a disc of Move.
static void drawAll(ImDrawList& list, const Picture& picture, Tool tool, const GizmoFrame& frame,
                    ImU32 color) {
    const auto middle = toPixel(picture, frame.origin);
    const auto rim = toPixel(
        picture,
        arrowTip(Handle::X, {frame.origin, glm::transpose(glm::mat3(viewMatrix(picture.camera)))},
                 arrowLength(picture, frame.origin)));
    if (!middle || !rim)
        return;
    if (tool == Tool::Move)
        list.AddCircle(toIm(*middle), 8, color, 0, 2);
    else
        list.AddCircle(toIm(*middle), kOuterRing * glm::length(*rim - *middle), color, 96, 1.5f);
}

void drawGizmo(const Picture& picture, Tool tool, const GizmoFrame& frame, Handle lit) {
    if (tool == Tool::Select)
        return;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    drawAll(list, picture, tool, frame, handleColor(Handle::All, lit));
    if (tool != Tool::Rotate)
        for (Handle h : {Handle::YZ, Handle::ZX, Handle::XY})
            drawPlane(list, picture, h, frame, handleColor(h, lit));
    for (Handle h : {Handle::X, Handle::Y, Handle::Z})
        if (tool == Tool::Rotate)
            drawRing(list, picture, h, frame, handleColor(h, lit));
        else
            drawAxis(list, picture, tool, h, frame, handleColor(h, lit));
}

void drawReadout(glm::vec2 pixel, const std::string& text) {
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const ImVec2 lower = ImGui::GetWindowPos(), extent = ImGui::GetWindowSize();
    const ImVec2 from(std::clamp(pixel.x + 16, lower.x + 5,
                                 std::max(lower.x + extent.x - size.x - 5, lower.x + 5)),
                      std::clamp(pixel.y + 16, lower.y + 3,
                                 std::max(lower.y + extent.y - size.y - 3, lower.y + 3)));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({from.x - 5, from.y - 3}, {from.x + size.x + 5, from.y + size.y + 3},
                       color::kGround, 3);
    list.AddText(from, IM_COL32_WHITE, text.c_str());
}

} // namespace limn
