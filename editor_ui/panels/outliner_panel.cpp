// SPDX-License-Identifier: MIT
#include "editor_ui/panels/outliner_panel.h"

#include "editor_ui/document/document_edit.h"
#include "editor_ui/document/material_edit.h"
#include "editor_ui/document/object_rules.h"
#include "editor_ui/document/selection.h"
#include "editor_ui/document/tree_edit.h"
#include "editor_ui/editor_state.h"
#include "editor_ui/panels/action.h"
#include "editor_ui/panels/field.h"
#include "editor_ui/panels/icon.h"
#include "editor_ui/panels/material_choice.h"
#include "editor_ui/panels/theme.h"

#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <functional>
#include <map>

namespace limn {

namespace {

/// One line of the list. id 0: a heading.
struct Row {
    ObjectId id = 0;
    const char* heading = nullptr;
    std::size_t count = 0; ///< of a heading
    int depth = 0;
    bool hasChildren = false;
};

constexpr float kIndent = 15;

} // namespace

static std::string lowered(std::string text) {
    std::ranges::transform(text, text.begin(),
                           [](unsigned char c) { return char(std::tolower(c)); });
    return text;
}

static bool passes(const std::string& lowerFilter, const Object& object) {
    return lowerFilter.empty() ||
           lowered(objectName(object)).find(lowerFilter) != std::string::npos;
}

static void nodeRows(const EditorState& state, const std::string& filter, std::vector<Row>& rows) {
    std::map<ObjectId, std::vector<ObjectId>> children;
    for (const auto& [id, object] : state.document.objects)
        if (const auto* node = std::get_if<Node>(&object)) {
            if (!filter.empty() && passes(filter, object))
                rows.push_back({id});
            const bool orphan = node->parent && !state.document.objects.contains(node->parent);
            children[orphan ? 0 : node->parent].push_back(id);
        }
    if (!filter.empty()) // found nodes stand in a flat list
        return;
    const std::function<void(ObjectId, int)> add = [&](ObjectId parent, int depth) {
        for (ObjectId id : children[parent]) {
            const bool hasChildren = children.contains(id);
            rows.push_back({id, nullptr, 0, depth, hasChildren});
            if (hasChildren && !state.outliner.collapsed.contains(id))
                add(id, depth + 1);
        }
    };
    add(0, 0);
}

template <class T>
static void rowsOfKind(const EditorState& state, const std::string& filter,
                       std::vector<Row>& rows) {
    for (const auto& [id, object] : state.document.objects)
        if (std::holds_alternative<T>(object) && passes(filter, object))
            rows.push_back({id});
}

/// A filter looks into all sections.
static bool isClosed(const EditorState& state, const char* heading) {
    return state.outliner.filter.empty() && state.outliner.closed.contains(heading);
}

static std::vector<Row> visibleRows(const EditorState& state) {
    const std::string filter = lowered(state.outliner.filter);
    std::vector<Row> rows;
    const auto section = [&](const char* heading, const auto& fill) {
        const std::size_t headingIndex = rows.size();
        rows.push_back({0, heading});
        fill(state, filter, rows);
        rows[headingIndex].count = rows.size() - headingIndex - 1;
        if (rows[headingIndex].count == 0)
            rows.pop_back();
        else if (isClosed(state, heading))
            rows.resize(headingIndex + 1);
    };
    section("Lights", rowsOfKind<Light>);
    section("Objects", nodeRows);
    section("Cameras", rowsOfKind<Camera>);
    section("Environment", rowsOfKind<Sky>);
    section("Bounced light", [](auto&... arguments) {
        rowsOfKind<TechniqueChoice>(arguments...);
        rowsOfKind<RelightSettings>(arguments...);
    });
    section("Baking", rowsOfKind<BakeSettings>);
    section("Materials", rowsOfKind<Material>);
    return rows;
}

static Icon iconOf(const Object& object) {
    if (const auto* node = std::get_if<Node>(&object))
        return node->meshes.empty() ? Icon::Group : Icon::Mesh;
    if (const auto* light = std::get_if<Light>(&object))
        return light->kind == LightKind::Directional ? Icon::Sun
               : light->kind == LightKind::Spot      ? Icon::Spot
               : light->kind == LightKind::Rectangle ? Icon::Rectangle
                                                     : Icon::Point;
    if (std::holds_alternative<Material>(object))
        return Icon::Material;
    if (std::holds_alternative<Camera>(object))
        return Icon::Camera;
    return std::holds_alternative<Sky>(object) ? Icon::Sky : Icon::Settings;
}

static bool isSelected(const EditorState& state, ObjectId id) {
    return std::ranges::find(state.selection, id) != state.selection.end();
}

static void selectRange(EditorState& state, const std::vector<Row>& rows, ObjectId to) {
    const auto rowOf = [&](ObjectId id) { return std::ranges::find(rows, id, &Row::id); };
    auto first = rowOf(state.outliner.anchor), last = rowOf(to);
    if (first == rows.end() || last == rows.end())
        return;
    if (last < first)
        std::swap(first, last);
    state.selection.clear();
    for (auto row = first; row <= last; ++row)
        if (row->id && row->id != to)
            state.selection.push_back(row->id);
    state.selection.push_back(to);
}

static void clicked(EditorState& state, const std::vector<Row>& rows, ObjectId id) {
    const ImGuiIO& io = ImGui::GetIO();
    state.outliner.revealed = id;
    if (io.KeyShift && state.outliner.anchor) {
        selectRange(state, rows, id);
        return;
    }
    state.outliner.anchor = id;
    if (!io.KeyCtrl)
        state.selection = {id};
    else if (isSelected(state, id))
        std::erase(state.selection, id);
    else
        state.selection.push_back(id);
}

static void nameField(EditorState& state, ObjectId id) {
    if (state.outliner.focusName)
        ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(-FLT_MIN);
    const bool done =
        ImGui::InputText("##rename", &state.outliner.newName,
                         ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    const bool left = ImGui::IsItemDeactivated();
    if (done)
        rename(state, id, state.outliner.newName);
    if (done || (left && !state.outliner.focusName))
        state.outliner.renaming = 0;
    if (ImGui::IsItemActive())
        state.outliner.focusName = false;
}

/// A triangle that points right if `collapsed`, else down, in a line of text at `corner` [px].
static void triangle(ImVec2 corner, bool collapsed) {
    const float h = ImGui::GetTextLineHeight();
    const ImVec2 c(corner.x + h * 0.4f, corner.y + h * 0.5f);
    const float r = h * 0.22f;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (collapsed)
        list.AddTriangleFilled({c.x - r * 0.7f, c.y - r}, {c.x + r, c.y}, {c.x - r * 0.7f, c.y + r},
                               color::dim());
    else
        list.AddTriangleFilled({c.x - r, c.y - r * 0.7f}, {c.x + r, c.y - r * 0.7f}, {c.x, c.y + r},
                               color::dim());
}

static void expander(EditorState& state, const Row& row) {
    const float h = ImGui::GetTextLineHeight();
    if (!row.hasChildren) {
        ImGui::Dummy({h * 0.8f, h});
        return;
    }
    const bool collapsed = state.outliner.collapsed.contains(row.id);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    if (ImGui::InvisibleButton("##expand", {h * 0.8f, h})) {
        if (collapsed)
            state.outliner.collapsed.erase(row.id);
        else
            state.outliner.collapsed.insert(row.id);
    }
    triangle(corner, collapsed);
}

static bool isShown(const Object& object) {
    if (const auto* node = std::get_if<Node>(&object))
        return node->visible;
    if (const auto* light = std::get_if<Light>(&object))
        return light->enabled;
    return true;
}

static void eyeButton(EditorState& state, ObjectId id, const Object& object) {
    const float h = ImGui::GetTextLineHeight();
    ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - h);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const bool shown = isShown(object);
    const bool pressed = ImGui::InvisibleButton("##eye", {h, h});
    const bool hovered = ImGui::IsItemHovered();
    drawIcon(*ImGui::GetWindowDrawList(), shown ? Icon::Shown : Icon::Hidden,
             {corner.x + h / 2, corner.y + h / 2}, h * 0.9f,
             hovered ? ImGui::GetColorU32(ImGuiCol_Text) : color::dim());
    wrappedTooltip(shown ? "Shown. Click to hide (H)" : "Hidden. Click to show (H)");
    if (!pressed)
        return;
    const std::vector<ObjectId> selection = state.selection;
    state.selection = {id};
    toggleHidden(state);
    state.selection = selection;
}

static void contextMenu(EditorState& state, ObjectId id) {
    if (!ImGui::BeginPopupContextItem("##menu"))
        return;
    if (!isSelected(state, id))
        state.selection = {id};
    for (const char* actionId : {"edit.rename", "edit.copy", "edit.paste", "edit.duplicate",
                                 "edit.group", "edit.ungroup", "edit.unparent", "edit.hide",
                                 "edit.isolate", "edit.dynamic", "view.focus", "edit.delete"}) {
        const Action& action = actionById(actionId);
        if (ImGui::MenuItem(action.label, shortcutText(shortcutOf(state, action)).c_str(), false,
                            action.enabled(state)))
            runAction(state, action);
    }
    ImGui::EndPopup();
}

/// A node that is dragged onto another one comes below it, with all that is selected if it is. A
/// material that is dragged onto a node becomes that of it and all below it, or of the selection.
static void dragRow(EditorState& state, ObjectId id) {
    constexpr const char* kNodes = "nodes";
    if (std::holds_alternative<Material>(state.document.objects.at(id)))
        dragMaterial(state, id);
    if (!std::holds_alternative<Node>(state.document.objects.at(id)))
        return;
    if (const ObjectId material = droppedMaterial())
        assignMaterial(state,
                       isSelected(state, id) ? selectionWithChildren(state)
                                             : withChildren(state.document, {id}),
                       material);
    if (ImGui::BeginDragDropSource()) {
        ImGui::SetDragDropPayload(kNodes, &id, sizeof id);
        const std::string name = objectName(state.document.objects.at(id));
        elidedText("Put " + name + " below ...", ImGui::GetFontSize() * 20);
        ImGui::EndDragDropSource();
    }
    if (!ImGui::BeginDragDropTarget())
        return;
    if (const ImGuiPayload* payload = ImGui::AcceptDragDropPayload(kNodes)) {
        ObjectId dragged = 0;
        std::memcpy(&dragged, payload->Data, sizeof dragged);
        reparent(state, isSelected(state, dragged) ? state.selection : std::vector{dragged}, id);
    }
    ImGui::EndDragDropTarget();
}

static void objectRow(EditorState& state, const std::vector<Row>& rows, const Row& row) {
    const Object& object = state.document.objects.at(row.id);
    ImGui::PushID(int(row.id));
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + kIndent * uiScale() * float(row.depth));
    const ImVec2 start = ImGui::GetCursorPos();
    const bool hideable =
        std::holds_alternative<Node>(object) || std::holds_alternative<Light>(object);
    const float lineHeight = ImGui::GetTextLineHeight();
    const bool selected = isSelected(state, row.id);
    if (ImGui::Selectable("##row", selected, ImGuiSelectableFlags_AllowItemOverlap,
                          {0, lineHeight}))
        clicked(state, rows, row.id);
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0)) {
        state.selection = {row.id};
        runAction(state, actionById("edit.rename"));
    }
    dragRow(state, row.id);
    contextMenu(state, row.id);
    if (!state.document.objects.contains(row.id)) { // the menu deleted it
        ImGui::PopID();
        return;
    }
    ImGui::SetCursorPos(start);
    expander(state, row);
    ImGui::SameLine(0, 4);
    const bool shown = isShown(object);
    iconItem(iconOf(object), shown ? ImGui::GetColorU32(ImGuiCol_Text) : color::dim());
    ImGui::SameLine(0, 6);
    if (state.outliner.renaming == row.id) {
        nameField(state, row.id);
    } else {
        const float room = ImGui::GetWindowContentRegionMax().x - ImGui::GetCursorPosX() -
                           (hideable ? lineHeight + 8 : 0);
        ImGui::PushStyleColor(ImGuiCol_Text,
                              shown ? ImGui::GetColorU32(ImGuiCol_Text) : color::dim());
        elidedText(objectName(object), std::max(room, 10.f));
        ImGui::PopStyleColor();
        if (hideable)
            eyeButton(state, row.id, state.document.objects.at(row.id));
    }
    ImGui::PopID();
}

/// Opens or closes its section when clicked.
static void headingRow(EditorState& state, const Row& row) {
    const float h = ImGui::GetTextLineHeight();
    const ImVec2 start = ImGui::GetCursorPos(), corner = ImGui::GetCursorScreenPos();
    std::set<std::string>& closed = state.outliner.closed;
    if (ImGui::Selectable((std::string("##") + row.heading).c_str(), false, 0, {0, h}) &&
        !closed.erase(row.heading))
        closed.insert(row.heading);
    triangle(corner, isClosed(state, row.heading));
    ImGui::SetCursorPos({start.x + h, start.y});
    ImGui::PushStyleColor(ImGuiCol_Text, color::dim());
    ImGui::Text("%s  %zu", row.heading, row.count);
    ImGui::PopStyleColor();
}

/// Scrolls to what was selected elsewhere (picked in the picture, added, undone).
static void reveal(EditorState& state, const std::vector<Row>& rows) {
    const ObjectId active = activeId(state);
    if (active == state.outliner.revealed)
        return;
    state.outliner.revealed = active;
    const auto row = std::ranges::find(rows, active, &Row::id);
    if (active == 0 || row == rows.end())
        return;
    const float y = float(row - rows.begin()) * ImGui::GetTextLineHeightWithSpacing();
    if (y < ImGui::GetScrollY() || y > ImGui::GetScrollY() + ImGui::GetWindowHeight() - 30)
        ImGui::SetScrollY(std::max(y - ImGui::GetWindowHeight() / 2, 0.f));
}

void outlinerPanel(EditorState& state) {
    ImGui::SetNextItemWidth(-FLT_MIN);
    ImGui::InputTextWithHint("##filter", "Filter by name", &state.outliner.filter);
    wrappedTooltip("Shows only objects whose name contains this text");
    if (!ImGui::BeginChild("rows")) {
        ImGui::EndChild();
        return;
    }
    const std::vector<Row> rows = visibleRows(state);
    if (rows.empty())
        ImGui::TextDisabled(state.outliner.filter.empty() ? "Nothing here yet" : "No name matches");
    reveal(state, rows);
    ImGuiListClipper clipper;
    clipper.Begin(int(rows.size()), ImGui::GetTextLineHeightWithSpacing());
    while (clipper.Step())
        for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
            const Row& row = rows[std::size_t(i)];
            if (row.id == 0)
                headingRow(state, row);
            else if (state.document.objects.contains(row.id)) // a menu above may have deleted it
                objectRow(state, rows, row);
        }
    ImGui::EndChild();
}

} // namespace limn
