// SPDX-License-Identifier: MIT
#include "editor_ui/view/gizmo.h"

#include "editor_ui/document/document_edit.h"
#include "editor_ui/editor_state.h"
#include "editor_ui/panels/theme.h"

#include <imgui.h>

#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>

namespace limn {

namespace {

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
    case Handle::None:
        break;
    }
    return 0;
}

} // namespace

static void drawArrow(ImDrawList& list, const Picture& picture, Handle handle, glm::vec3 origin,
                      ImU32 color) {
    const float length = arrowLength(picture, origin);
    const auto from = toPixel(picture, origin),
               to = toPixel(picture, arrowTip(handle, origin, length));
    if (!from || !to)
        return;
    const glm::vec2 d = *to - *from;
    const float pixels = glm::length(d);
    if (pixels < 6)
        return;
    const glm::vec2 along = d / pixels, across(-along.y, along.x);
    list.AddLine(toIm(*from), toIm(*to - along * 8.f), color, 3);
    list.AddTriangleFilled(toIm(*to + along * 4.f), toIm(*to - along * 11.f + across * 6.f),
                           toIm(*to - along * 11.f - across * 6.f), color);
}

static void drawPlane(ImDrawList& list, const Picture& picture, Handle handle, glm::vec3 origin,
                      ImU32 color) {
    ImVec2 quad[4];
    std::size_t i = 0;
    for (glm::vec3 corner : planeHandle(handle, origin, arrowLength(picture, origin))) {
        const auto p = toPixel(picture, corner);
        if (!p)
            return;
        quad[i++] = toIm(*p);
    }
    list.AddQuadFilled(quad[0], quad[1], quad[2], quad[3], (color & 0x00FFFFFF) | 0x50000000);
    list.AddQuad(quad[0], quad[1], quad[2], quad[3], color, 1.5f);
}

static void draw(const Picture& picture, glm::vec3 origin, Handle lit) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (Handle h : {Handle::YZ, Handle::ZX, Handle::XY})
        drawPlane(list, picture, h, origin, handleColor(h, lit));
    for (Handle h : {Handle::X, Handle::Y, Handle::Z})
        drawArrow(list, picture, h, origin, handleColor(h, lit));
}

static void drawReadout(const Picture& picture, glm::vec3 origin, glm::vec3 moved) {
    const auto at = toPixel(picture, origin);
    if (!at)
        return;
    const std::string text = fmt::format("{:+.3f}  {:+.3f}  {:+.3f} m", moved.x, moved.y, moved.z);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const ImVec2 from(at->x + 16, at->y + 16);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({from.x - 5, from.y - 3}, {from.x + size.x + 5, from.y + size.y + 3},
                       IM_COL32(20, 22, 26, 200), 3);
    list.AddText(from, IM_COL32_WHITE, text.c_str());
}

static void startDrag(EditorState& state, Handle handle, glm::vec3 origin, glm::vec2 mouse) {
    commitGesture(state);
    state.view.drag = GizmoDrag{handle, origin, mouse, movableSelection(state),
                                state.view.picked ? state.view.picked->position : glm::vec3(0)};
}

/// A round step of about a tenth of the arrow [m].
static float snapStep(const Picture& picture, glm::vec3 origin) {
    return std::pow(10.f, std::floor(std::log10(arrowLength(picture, origin))));
}

static glm::vec3 wantedDisplacement(const Picture& picture, const GizmoDrag& drag, glm::vec2 mouse,
                                    bool& known) {
    const auto d = dragDisplacement(picture, drag.handle, drag.origin, drag.start, mouse);
    known = d.has_value();
    if (!known)
        return glm::vec3(0);
    const ImGuiIO& io = ImGui::GetIO();
    if (io.KeyCtrl)
        return snapped(*d, snapStep(picture, drag.origin));
    return io.KeyShift ? *d * 0.1f : *d;
}

static void continueDrag(EditorState& state, const Picture& picture, glm::vec2 mouse) {
    const GizmoDrag& drag = *state.view.drag;
    bool known = false;
    const glm::vec3 d = wantedDisplacement(picture, drag, mouse, known);
    if (!known)
        return;
    ObjectsById seen;
    for (const auto& [id, start] : drag.objects) {
        Object* object = findObject(state, id);
        if (!object)
            continue;
        seen.emplace(id, *object);
        *object = displaced(state.document, start, d);
    }
    trackEdits(state, seen, "Move");
    if (pickedSurface(state))
        state.view.picked->position = drag.surface + d;
    drawReadout(picture, drag.origin + d, d);
}

void moveGizmo(EditorState& state, bool mouseHere) {
    const Picture picture = state.view.picture();
    const glm::vec2 mouse(ImGui::GetIO().MousePos.x, ImGui::GetIO().MousePos.y);
    if (state.view.drag && !ImGui::IsMouseDown(0))
        state.view.drag.reset();
    if (state.view.drag)
        continueDrag(state, picture, mouse);
    const auto place = state.view.tool == Tool::Move ? selectionOrigin(state) : std::nullopt;
    if (!place || !toPixel(picture, *place)) {
        state.view.drag.reset();
        return;
    }
    const glm::vec3 origin = *place;
    Handle lit = state.view.drag ? state.view.drag->handle : Handle::None;
    if (!state.view.drag && mouseHere) {
        lit = handleAt(picture, origin, mouse);
        if (lit != Handle::None && ImGui::IsMouseClicked(0) && !ImGui::GetIO().KeyAlt)
            startDrag(state, lit, origin, mouse);
    }
    draw(picture, origin, lit);
}

} // namespace limn
