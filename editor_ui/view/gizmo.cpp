// SPDX-License-Identifier: MIT
#include "editor_ui/view/gizmo.h"

#include "editor_ui/document/document_edit.h"
#include "editor_ui/editor_state.h"
#include "editor_ui/view/gizmo_drawing.h"
#include "editor_ui/view/light_handles.h"
#include "editor_ui/view/pivot.h"
#include "engine/scene/find_object.h"

#include <imgui.h>

#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr float kDragPixels = 4;      ///< from which a drag makes copies
constexpr float kReadoutPixels = 105; ///< from the pivot, so that the text is below the gizmo

DragKeys heldKeys(const GizmoSettings& settings) {
    const ImGuiIO& io = ImGui::GetIO();
    return {.snap = settings.snap != io.KeyCtrl, .fine = io.KeyShift};
}

const char* labelOf(const GizmoDrag& drag) {
    switch (drag.tool) {
    case Tool::Move:
        return "Move";
    case Tool::Rotate:
        return "Rotate";
    case Tool::Scale:
        return "Scale";
    case Tool::Select:
        break;
    }
    return "";
}

} // namespace

glm::vec2 mousePosition() {
    const ImVec2 m = ImGui::GetIO().MousePos;
    return {m.x, m.y};
}

/// Axes of the gizmo: of the world, of the active object (else of any that moves), or of the view.
/// None if they are those of an object and none moves.
static std::optional<glm::mat3> gizmoAxes(const EditorState& state) {
    switch (state.view.gizmo.space) {
    case GizmoSpace::World:
        break;
    case GizmoSpace::Local: {
        const ObjectsById movable = movableSelection(state);
        if (movable.empty())
            return {};
        const auto active = movable.find(activeId(state));
        return ownAxes(state.document,
                       active != movable.end() ? active->second : movable.begin()->second);
    }
    case GizmoSpace::View:
        return glm::transpose(glm::mat3(viewMatrix(state.view.camera)));
    }
    return glm::mat3(1);
}

static std::optional<GizmoFrame> selectionFrame(const EditorState& state) {
    const auto origin = selectionOrigin(state);
    if (!origin || !toPixel(state.view.picture(), *origin))
        return {};
    const auto axes = gizmoAxes(state);
    return axes ? std::optional(GizmoFrame{*origin, *axes}) : std::nullopt;
}

static GizmoDrag newDrag(EditorState& state, const GizmoFrame& frame) {
    commitGesture(state);
    return {.frame = frame,
            .start = mousePosition(),
            .objects = movableSelection(state),
            .selection = state.selection,
            .surface = state.view.picked ? state.view.picked->position : glm::vec3(0)};
}

void grabSelection(EditorState& state, Tool tool) {
    const auto frame = selectionFrame(state);
    if (!frame || movableSelection(state).empty())
        return;
    GizmoDrag drag = newDrag(state, *frame);
    drag.tool = tool;
    drag.handle = Handle::All;
    drag.grabbed = true;
    state.view.drag = std::move(drag);
}

void cancelDrag(EditorState& state) {
    cancelGesture(state);
    if (!state.view.drag)
        return;
    const GizmoDrag drag = std::move(*state.view.drag);
    state.view.drag.reset();
    state.selection = drag.selection;
    pruneSelection(state);
    if (pickedSurface(state))
        state.view.picked->position = drag.surface;
}

bool keyOfDrag(EditorState& state, const Shortcut& pressed) {
    auto& drag = state.view.drag;
    if (!drag || (pressed.mods & (kCtrl | kAlt)))
        return false;
    if (pressed.key == key::kEnter || pressed.key == key::kPadEnter)
        drag.reset();
    else if (pressed.key == key::kBackspace && !drag->typed.empty())
        drag->typed.pop_back();
    return true;
}

/// Copies the selection and drags the copies instead. Copying and dragging are one undo step.
static void makeCopies(EditorState& state, GizmoDrag& drag) {
    Copies copies = copiesOfSelection(state);
    drag.duplicates = false;
    drag.objects.clear();
    for (ObjectId id : copies.tops)
        drag.objects.emplace(id, copies.objects.at(id));
    beginCreation(state, std::move(copies.objects), labelOf(drag));
    state.selection = std::move(copies.tops);
}

static void typeCharacters(GizmoDrag& drag) {
    for (const ImWchar c : ImGui::GetIO().InputQueueCharacters)
        typeIntoDrag(drag, c);
}

static void moveSurface(EditorState& state, const GizmoDrag& drag,
                        const Manipulation& manipulation) {
    if (!pickedSurface(state))
        return;
    Light point;
    point.position = drag.surface;
    state.view.picked->position =
        std::get<Light>(manipulated(state.document, point, manipulation)).position;
}

/// What the drag has come to, below the gizmo.
static void drawResult(const Picture& picture, const GizmoDrag& drag,
                       const Manipulation& manipulation) {
    if (const auto pixel = toPixel(picture, drag.frame.origin + manipulation.move))
        drawReadout(*pixel + glm::vec2(0, kReadoutPixels), dragText(drag, manipulation));
}

/// Returns what the drag does, if anything.
static std::optional<Manipulation> dragSelection(EditorState& state, const Picture& picture) {
    GizmoDrag& drag = *state.view.drag;
    typeCharacters(drag);
    const glm::vec2 mouse = mousePosition();
    if (drag.duplicates && glm::length(mouse - drag.start) > kDragPixels)
        makeCopies(state, drag);
    const auto manipulation =
        dragManipulation(picture, drag, state.view.gizmo, mouse, heldKeys(state.view.gizmo));
    if (!manipulation || drag.duplicates)
        return {};
    ObjectsById seen, after;
    for (const auto& [id, start] : drag.objects)
        if (const Object* object = findObject(state, id)) {
            seen.emplace(id, *object);
            after.emplace(id, manipulated(state.document, start, *manipulation));
        }
    for (auto& [id, object] : after)
        state.document.objects.at(id) = std::move(object);
    trackEdits(state, seen, labelOf(drag));
    moveSurface(state, drag, *manipulation);
    return manipulation;
}

static void dragLight(EditorState& state, const Picture& picture) {
    const GizmoDrag& drag = *state.view.drag;
    const auto& [id, start] = *drag.objects.begin();
    Object* object = findObject(state, id);
    const auto* light = std::get_if<Light>(&start);
    const glm::vec2 mouse = mousePosition();
    const auto aim = drag.part == LightPart::Direction ? surfaceUnder(state, mouse) : std::nullopt;
    const auto after =
        light ? draggedLight(picture, *light, drag.part, drag.start, mouse, aim) : std::nullopt;
    if (!object || !after)
        return;
    Object seen = *object;
    *object = *after;
    trackEdit(state, id, seen, lightPartLabel(drag.part));
    drawReadout(mouse, lightPartText(*after, drag.part));
}

/// Returns true if the drag ended by a click.
static bool endDrag(EditorState& state) {
    if (!state.view.drag->grabbed) {
        if (!ImGui::IsMouseDown(ImGuiMouseButton_Left))
            state.view.drag.reset();
        return false;
    }
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Right)) {
        cancelDrag(state);
        return true;
    }
    if (!ImGui::IsMouseClicked(ImGuiMouseButton_Left))
        return false;
    state.view.drag.reset();
    return true;
}

static void startDrag(EditorState& state, const GizmoFrame& frame, Handle handle) {
    GizmoDrag drag = newDrag(state, frame);
    drag.tool = state.view.tool;
    drag.handle = handle;
    drag.duplicates = ImGui::GetIO().KeyAlt;
    state.view.drag = std::move(drag);
}

static void startLightDrag(EditorState& state, LightPart part) {
    GizmoDrag drag = newDrag(state, {});
    drag.part = part;
    state.view.drag = std::move(drag);
}

/// The light whose handles are shown: the only selected object.
static const Light* handledLight(const EditorState& state) {
    return state.selection.size() == 1 ? findObjectAs<Light>(state.document, activeId(state))
                                       : nullptr;
}

/// Draws the handles of the selected light. Returns the one under the mouse.
static LightPart lightHandles(EditorState& state, const Picture& picture, bool mouseHere) {
    const Light* light = handledLight(state);
    if (!light || !toPixel(picture, light->position))
        return LightPart::None;
    const bool dragged = state.view.drag.has_value();
    const LightPart lit = dragged     ? state.view.drag->part
                          : mouseHere ? lightPartAt(picture, *light, mousePosition())
                                      : LightPart::None;
    drawLightHandles(picture, *light, lit);
    if (lit != LightPart::None && !dragged)
        drawReadout(mousePosition(), lightPartText(*light, lit));
    return dragged ? LightPart::None : lit;
}

bool overHandle(const EditorState& state) {
    const Picture picture = state.view.picture();
    const Light* light = handledLight(state);
    if (light && toPixel(picture, light->position) &&
        lightPartAt(picture, *light, mousePosition()) != LightPart::None)
        return true;
    const auto frame = selectionFrame(state);
    return frame && handleAt(picture, state.view.tool, *frame, mousePosition()) != Handle::None;
}

bool useGizmo(EditorState& state, bool mouseHere) {
    const Picture picture = state.view.picture();
    const bool clicked = state.view.drag && endDrag(state);
    auto& drag = state.view.drag;
    std::optional<Manipulation> manipulation;
    if (drag && drag->part == LightPart::None)
        manipulation = dragSelection(state, picture);
    else if (drag)
        dragLight(state, picture);
    const LightPart part = lightHandles(state, picture, mouseHere && !clicked);
    const auto frame = selectionFrame(state);
    if (!frame) {
        if (drag && !drag->grabbed)
            drag.reset();
        return clicked;
    }
    const Tool tool = drag && drag->part == LightPart::None ? drag->tool : state.view.tool;
    Handle lit = drag ? drag->handle : Handle::None;
    const bool free = !drag && mouseHere && !clicked;
    if (free && part == LightPart::None)
        lit = handleAt(picture, tool, *frame, mousePosition());
    if (free && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
        if (part != LightPart::None)
            startLightDrag(state, part);
        else if (lit != Handle::None)
            startDrag(state, *frame, lit);
    }
    // During a rotation the axes stay those about which it turns, although the selection
    // already has other ones.
    const bool turning = drag && drag->part == LightPart::None;
    drawGizmo(picture, tool, {frame->origin, turning ? drag->frame.axes : frame->axes}, lit);
    if (drag && manipulation)
        drawResult(picture, *drag, *manipulation);
    return clicked;
}

} // namespace limn
