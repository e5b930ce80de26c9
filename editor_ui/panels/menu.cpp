// SPDX-License-Identifier: MIT
#include "editor_ui/panels/menu.h"

#include "editor_ui/editor_state.h"
#include "editor_ui/panels/action.h"
#include "editor_ui/panels/field.h"
#include "editor_ui/panels/snap_steps.h"
#include "engine/techniques/technique_table.h"

#include <imgui.h>

#include <algorithm>
#include <cfloat>
#include <filesystem>
#include <string>
#include <vector>

namespace limn {

// Menus are short enough for a window 480 px high, which is 720 px at 144 dpi; a test opens them
// all.
static constexpr MenuPlace kMenus[] = {{Menu::File, "File", {}},
                                       {Menu::Edit, "Edit", {}},
                                       {Menu::Transform, "Transform", Menu::Edit},
                                       {Menu::Visibility, "Visibility", Menu::Edit},
                                       {Menu::Hierarchy, "Hierarchy", Menu::Edit},
                                       {Menu::Add, "Add", {}},
                                       {Menu::View, "View", {}},
                                       {Menu::Picture, "Picture", Menu::View},
                                       {Menu::Overlay, "Overlay", Menu::View},
                                       {Menu::Compare, "Compare", Menu::View},
                                       {Menu::Camera, "Camera", Menu::View},
                                       {Menu::Tool, "Tool", Menu::View},
                                       {Menu::Gizmo, "Gizmo", Menu::View},
                                       {Menu::Workspace, "Workspace", Menu::View},
                                       {Menu::Bake, "Bake", {}},
                                       {Menu::Help, "Help", {}}};

std::span<const MenuPlace> menuPlaces() {
    return kMenus;
}

static const MenuPlace& placeOf(Menu menu) {
    return kMenus[std::size_t(menu)];
}

Menu topMenu(Menu menu) {
    while (const auto parent = placeOf(menu).parent)
        menu = *parent;
    return menu;
}

static bool isFirstOfMenu(const Action& action) {
    return &*std::ranges::find(actions(), action.menu, &Action::menu) == &action;
}

static void actionItem(EditorState& state, const Action& action) {
    const std::string label = actionLabel(state, action);
    const std::string keys = shortcutText(shortcutOf(state, action));
    const bool checked = action.checked && action.checked(state);
    if (ImGui::MenuItem((label + "###" + action.id).c_str(), keys.c_str(), checked,
                        action.enabled(state)))
        runAction(state, action);
}

static void recentMenu(EditorState& state) {
    if (!ImGui::BeginMenu("Recent", !state.recent.empty()))
        return;
    for (const std::string& path : std::vector<std::string>(state.recent)) {
        const std::string name = std::filesystem::path(path).filename().string();
        if (ImGui::MenuItem((name + "##" + path).c_str()))
            state.requests.push_back({Request::Kind::Open, path});
        wrappedTooltip(path.c_str());
    }
    ImGui::EndMenu();
}

/// The overlays of each technique in a submenu.
static void overlayRows(EditorState& state) {
    actionItem(state, overlayAction(nullptr));
    for (const Technique* technique : techniques()) {
        if (technique->overlays.empty() || !ImGui::BeginMenu(technique->label))
            continue;
        for (const OverlayKind& kind : technique->overlays)
            actionItem(state, overlayAction(&kind));
        ImGui::EndMenu();
    }
}

static void menu(EditorState& state, const MenuPlace& place);

/// The menu's actions, and each submenu where the table of actions has the first of its own.
static void rows(EditorState& state, Menu which) {
    bool first = true;
    for (const Action& action : actions()) {
        const MenuPlace& place = placeOf(action.menu);
        const bool submenu = place.parent == which && isFirstOfMenu(action);
        if (!submenu && action.menu != which)
            continue;
        if (action.separator && !first)
            ImGui::Separator();
        first = false;
        if (submenu)
            menu(state, place);
        else
            actionItem(state, action);
        if (action.id == "file.open")
            recentMenu(state);
    }
}

static void menu(EditorState& state, const MenuPlace& place) {
    if (!ImGui::BeginMenu(place.label))
        return;
    if (place.menu == Menu::Overlay)
        overlayRows(state);
    else
        rows(state, place.menu);
    if (place.menu == Menu::Gizmo)
        snapSteps(state.view.gizmo);
    ImGui::EndMenu();
}

void menus(EditorState& state) {
    const ImGuiViewport& screen = *ImGui::GetMainViewport();
    const float bar = ImGui::GetWindowPos().y + ImGui::GetWindowHeight();
    const float room =
        screen.Pos.y + screen.Size.y - bar - ImGui::GetStyle().DisplaySafeAreaPadding.y;
    for (const MenuPlace& place : kMenus) {
        if (place.parent)
            continue;
        // ImGui moves a menu that is taller than the room over the bar, where the release of the
        // button that opened it hits one of its rows. A menu of at most the room scrolls instead.
        ImGui::SetNextWindowSizeConstraints({0, 0}, {FLT_MAX, std::max(room, 1.f)});
        menu(state, place);
    }
}

} // namespace limn
