// SPDX-License-Identifier: MIT
#include "editor_ui/panels/viewport_panel.h"

#include "editor_ui/document/document_edit.h"
#include "editor_ui/panels/compare_overlay.h"
#include "editor_ui/panels/explain_panel.h"
#include "editor_ui/panels/goals_panel.h"
#include "editor_ui/panels/icon.h"
#include "editor_ui/panels/overlay_panel.h"
#include "editor_ui/panels/picture_label.h"
#include "editor_ui/panels/theme.h"
#include "editor_ui/panels/viewport_corner.h"
#include "editor_ui/view/camera_control.h"
#include "editor_ui/view/gizmo.h"
#include "editor_ui/view/icon_scales.h"
#include "editor_ui/view/light_placement.h"
#include "editor_ui/view/picking.h"
#include "editor_ui/view/pivot.h"
#include "engine/scene/find_object.h"
#include "engine/scene/light/rectangle_light.h"
#include "engine/scene/placement.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_set>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

namespace limn {

namespace {

constexpr int kLeft = 0, kRight = 1, kMiddle = 2;
constexpr float kRadiansPerPixel = 0.006f;
constexpr float kClickPixels = 4;
constexpr std::size_t kMaxBoxes = 200;

} // namespace

static int buttonOf(const EditorState& state) {
    if (state.view.navigation == Navigation::Fly)
        return kRight;
    return ImGui::IsMouseDown(kMiddle) ? kMiddle : kLeft;
}

static void startNavigation(EditorState& state) {
    const ImGuiIO& io = ImGui::GetIO();
    Navigation& navigation = state.view.navigation;
    if (navigation != Navigation::None || state.view.drag)
        return;
    if (ImGui::IsMouseClicked(kMiddle))
        navigation = io.KeyShift ? Navigation::Pan : Navigation::Orbit;
    else if (ImGui::IsMouseClicked(kLeft) && io.KeyAlt && !overHandle(state))
        navigation = Navigation::Orbit;
    else if (ImGui::IsMouseClicked(kRight))
        navigation = Navigation::Fly;
    if (navigation != Navigation::Orbit && navigation != Navigation::Pan)
        return;
    state.view.pivot = pivotUnder(state, mousePosition());
    setTargetDepth(state.view.camera, state.view.pivot);
}

static void flyKeys(EditorState& state) {
    const ImGuiIO& io = ImGui::GetIO();
    const auto axis = [](char plus, char minus) {
        return float(ImGui::IsKeyDown(key::of(plus))) - float(ImGui::IsKeyDown(key::of(minus)));
    };
    const glm::vec3 direction(axis('D', 'A'), axis('E', 'Q'), axis('W', 'S'));
    state.view.animating = direction != glm::vec3(0);
    const float pace = io.KeyShift ? 4.f : io.KeyCtrl ? 0.25f : 1.f;
    const float step =
        state.view.flySpeed * pace * std::min(io.DeltaTime, 0.1f); // after a sleep: no leap
    fly(state.view.camera, direction.x * step, direction.y * step, direction.z * step);
}

static void navigate(EditorState& state) {
    ViewState& view = state.view;
    const ImGuiIO& io = ImGui::GetIO();
    view.animating = false;
    if (view.navigation == Navigation::None)
        return;
    if (!ImGui::IsMouseDown(buttonOf(state))) {
        view.navigation = Navigation::None;
        return;
    }
    const glm::vec2 d(io.MouseDelta.x, io.MouseDelta.y);
    switch (view.navigation) {
    case Navigation::None:
        break;
    case Navigation::Orbit:
        if (d != glm::vec2(0))
            orbit(view.camera, view.pivot, -d.x * kRadiansPerPixel, d.y * kRadiansPerPixel);
        break;
    case Navigation::Pan:
        if (d != glm::vec2(0))
            pan(view.camera, -d.x / view.size.y, d.y / view.size.y);
        break;
    case Navigation::Fly:
        if (d != glm::vec2(0))
            look(view.camera, d.x * kRadiansPerPixel / 2, -d.y * kRadiansPerPixel / 2);
        flyKeys(state);
        break;
    }
}

static void wheel(EditorState& state) {
    const float steps = ImGui::GetIO().MouseWheel;
    if (steps == 0)
        return;
    if (state.view.navigation == Navigation::Fly)
        state.view.flySpeed = std::clamp(state.view.flySpeed * std::pow(1.2f, steps), 1e-3f, 1e4f);
    else
        zoom(state.view.camera, pivotUnder(state, mousePosition()), steps);
}

static void press(EditorState& state) {
    if (!ImGui::IsMouseClicked(kLeft) || state.view.navigation != Navigation::None ||
        state.view.drag)
        return;
    state.view.pressed = true;
    state.view.pressedAt = mousePosition();
}

static void release(EditorState& state) {
    ViewState& view = state.view;
    if (!view.pressed || ImGui::IsMouseDown(kLeft))
        return;
    view.pressed = false;
    const ImGuiIO& io = ImGui::GetIO();
    if (glm::length(mousePosition() - view.pressedAt) > kClickPixels)
        return;
    if (view.placing) {
        placeAtPixel(state, *view.placing, view.pressedAt);
        view.placing.reset();
        return;
    }
    pick(state, view.pressedAt, io.KeyCtrl || io.KeyShift);
    const OverlayKind* overlay = state.overlay.options.kind;
    if (overlay && overlay->pick != OverlayPick::None)
        pickAt(state, view.pressedAt);
    if (state.explain.shown)
        explainAt(state, view.pressedAt);
}

static Icon lightIcon(LightKind kind) {
    switch (kind) {
    case LightKind::Directional:
        return Icon::Sun;
    case LightKind::Point:
        return Icon::Point;
    case LightKind::Spot:
        return Icon::Spot;
    case LightKind::Rectangle:
        return Icon::Rectangle;
    }
    return Icon::Point;
}

static void directionLine(ImDrawList& list, const Picture& picture, const Light& light,
                          ImU32 color) {
    const float length = 0.7f * arrowLength(picture, light.position);
    const auto from = toPixel(picture, light.position);
    const auto to = toPixel(picture, light.position + light.direction * length);
    if (from && to)
        list.AddLine({from->x, from->y}, {to->x, to->y}, color, 1.5f);
}

static void rectangleOutline(ImDrawList& list, const Picture& picture, const Light& light,
                             ImU32 color) {
    const LightRectangle rectangle = lightRectangle(light);
    std::array<std::optional<glm::vec2>, 4> corner;
    for (std::size_t i = 0; i < 4; ++i)
        corner[i] = toPixel(picture, rectangle.at({i == 1 || i == 2, i >= 2}));
    for (std::size_t i = 0; i < 4; ++i)
        if (const auto& a = corner[i], &b = corner[(i + 1) % 4]; a && b)
            list.AddLine({a->x, a->y}, {b->x, b->y}, color, 1.5f);
}

/// Icons that would cover one another shrink, to dots at last; selected ones keep their size.
static void lightIcons(const EditorState& state) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const Picture picture = state.view.picture();
    std::vector<std::pair<ObjectId, const Light*>> lights;
    std::vector<glm::vec2> places;
    for (const auto& [id, object] : state.document.objects) {
        const auto* light = std::get_if<Light>(&object);
        const auto pixel = light ? toPixel(picture, light->position) : std::nullopt;
        if (!pixel)
            continue;
        lights.emplace_back(id, light);
        places.push_back(*pixel);
    }
    const std::vector<float> scales = iconScales(places, 24 * uiScale());
    const std::unordered_set<ObjectId> chosen(state.selection.begin(), state.selection.end());
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const auto& [id, light] = lights[i];
        const bool selected = chosen.contains(id) || id == state.explain.hovered;
        const float shrink = selected ? 1 : scales[i], scale = shrink * uiScale();
        const ImU32 ink = selected         ? color::kHandleLit
                          : light->enabled ? IM_COL32(255, 255, 255, 230)
                                           : IM_COL32(150, 150, 150, 200);
        const ImVec2 centre(places[i].x, places[i].y);
        if (light->kind == LightKind::Rectangle)
            rectangleOutline(list, picture, *light, ink);
        list.AddCircleFilled(centre, 12 * scale, color::kGround);
        if (selected)
            list.AddCircle(centre, 12.5f * scale, ink, 0, 1.5f);
        if (selected && light->kind != LightKind::Point)
            directionLine(list, picture, *light, ink);
        if (shrink > 0.5f)
            drawIcon(list, lightIcon(light->kind), centre, 15 * scale, ink);
        else // a shape would be a smudge
            list.AddCircleFilled(centre, 8 * scale, ink);
    }
}

static void boxOutline(ImDrawList& list, const Picture& picture, const Bounds& b,
                       const glm::mat4& toWorld, ImU32 color, float width) {
    std::array<std::optional<glm::vec2>, 8> corner;
    for (std::size_t i = 0; i < 8; ++i)
        corner[i] = toPixel(picture, toWorld * glm::vec4(i & 1 ? b.upper.x : b.lower.x,
                                                         i & 2 ? b.upper.y : b.lower.y,
                                                         i & 4 ? b.upper.z : b.lower.z, 1));
    for (std::size_t i = 0; i < 8; ++i)
        for (std::size_t bit : {1u, 2u, 4u})
            if (!(i & bit) && corner[i] && corner[i | bit])
                list.AddLine({corner[i]->x, corner[i]->y}, {corner[i | bit]->x, corner[i | bit]->y},
                             color, width);
}

/// Box of the node's meshes in its own space, or of the one that was clicked.
static std::optional<Bounds> meshBox(const EditorState& state, ObjectId id, const Node& node) {
    const PickedSurface* picked = id == activeId(state) ? pickedSurface(state) : nullptr;
    std::optional<Bounds> box;
    for (std::uint32_t mesh : node.meshes) {
        if (mesh >= state.meshBounds.size() || (picked && picked->mesh != mesh))
            continue;
        const Bounds& b = state.meshBounds[mesh];
        box = box ? Bounds{glm::min(box->lower, b.lower), glm::max(box->upper, b.upper)} : b;
    }
    return box;
}

/// Box of a node's meshes in the world, or nothing if the id is no node's.
static void nodeBox(const EditorState& state, Placements& placements, ObjectId id, ImU32 color,
                    float width) {
    const auto* node = findObjectAs<Node>(state.document, id);
    if (const auto box = node ? meshBox(state, id, *node) : std::nullopt)
        boxOutline(*ImGui::GetWindowDrawList(), state.view.picture(), *box,
                   glm::mat4(placements.of(id).toWorld), color, width);
}

/// A box for each selected node, so that a picked one can be seen; one box for a large selection.
/// Another one for the row under the mouse in the table that explains a pixel.
static void selectionBoxes(const EditorState& state) {
    constexpr ImU32 kInk = IM_COL32(255, 225, 110, 130);
    Placements placements(state.document);
    if (state.selection.size() > kMaxBoxes)
        boxOutline(*ImGui::GetWindowDrawList(), state.view.picture(), selectionBounds(state),
                   glm::mat4(1), kInk, 1);
    else
        for (ObjectId id : state.selection)
            nodeBox(state, placements, id, kInk, 1);
    nodeBox(state, placements, state.explain.hovered, color::kAccent, 2);
}

/// A cross at the surface whose light the table explains.
static void explainedPoint(const EditorState& state) {
    if (!state.explain.shown || !state.explain.pick)
        return;
    const auto pixel = toPixel(state.view.picture(), state.explain.pick->point);
    if (!pixel)
        return;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (const auto& [color, width] : {std::pair(IM_COL32(20, 22, 26, 255), 4.f),
                                       std::pair(IM_COL32(255, 255, 255, 255), 2.f)}) {
        list.AddLine({pixel->x - 7, pixel->y}, {pixel->x + 7, pixel->y}, color, width);
        list.AddLine({pixel->x, pixel->y - 7}, {pixel->x, pixel->y + 7}, color, width);
    }
}

/// Text on a dark ground in the middle of the picture's width, wrapped to it, at height `y` [px].
static void pictureText(const EditorState& state, const char* text, float y, ImU32 ink) {
    const float wrap = std::max(state.view.size.x - 32, 50.f);
    pictureLabel({state.view.origin.x + state.view.size.x / 2, state.view.origin.y + y}, {0.5f, 0},
                 text, ink, wrap, {.margin = {8, 4}, .rounding = 4});
}

/// What the colours of an inspection mean, where nothing else is said there.
static void inspectionLabel(const EditorState& state) {
    if (state.view.inspection == Inspection::InvalidPixels && !state.view.placing)
        pictureText(state, "Pixels that are NaN or Inf, and those around them, are magenta", 12,
                    IM_COL32_WHITE);
}

/// Where a light would stand if one clicked now.
static void placingHint(const EditorState& state, bool hovered) {
    if (!state.view.placing)
        return;
    const LightKind* kind = std::get_if<LightKind>(&*state.view.placing);
    pictureText(state,
                kind ? "Click where the light goes. Enter: before the camera. Esc: none"
                     : "Click the surface it stands on. Enter: before the camera. Esc: none",
                12, IM_COL32_WHITE);
    const auto pixel =
        hovered && kind
            ? toPixel(state.view.picture(), lightAtPixel(state, *kind, mousePosition()).position)
            : std::nullopt;
    if (!pixel)
        return;
    const glm::vec2 mouse = mousePosition();
    const ImVec2 centre(pixel->x, pixel->y);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddLine({mouse.x, mouse.y}, centre, color::kHandleLit, 1.5f);
    list.AddCircleFilled(centre, 12, color::kGround);
    drawIcon(list, lightIcon(*kind), centre, 15, color::kHandleLit);
}

void viewportPanel(EditorState& state) {
    const ImVec2 origin = ImGui::GetCursorScreenPos(), size = ImGui::GetContentRegionAvail();
    state.view.origin = {origin.x, origin.y};
    state.view.size = {std::max(size.x, 1.f), std::max(size.y, 1.f)};
    const bool over = ImGui::IsWindowHovered();
    ImGui::PushClipRect(origin, {origin.x + size.x, origin.y + size.y}, true);
    const bool axes = axisWidget(state, over);
    ImGui::PopClipRect();
    const bool hovered = !compareHandle(state, over && !axes) && over && !axes;
    if (hovered)
        startNavigation(state);
    navigate(state);
    if (hovered)
        wheel(state);
    ImGui::PushClipRect(origin, {origin.x + size.x, origin.y + size.y}, true);
    selectionBoxes(state);
    explainedPoint(state);
    if (state.explain.shown)
        goalMarks(state);
    if (state.view.showLights)
        lightIcons(state);
    const bool clickTaken = useGizmo(state, hovered && state.view.navigation == Navigation::None &&
                                                !state.view.placing);
    compareOverlay(state);
    pictureReadout(state);
    const bool resting = hovered && state.view.navigation == Navigation::None;
    placingHint(state, resting);
    inspectionLabel(state);
    if (resting && !state.view.placing && !state.view.drag && !state.view.pressed)
        overlayNumbers(state);
    ImGui::PopClipRect();
    if (hovered && !clickTaken)
        press(state);
    release(state);
}

} // namespace limn
