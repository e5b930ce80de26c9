// SPDX-License-Identifier: MIT
#include "editor_ui/editor.h"

#include "editor_ui/editor_state.h"
#include "editor_ui/panels/action.h"
#include "editor_ui/panels/bottom_panel.h"
#include "editor_ui/panels/chrome.h"
#include "editor_ui/panels/help_sheet.h"
#include "editor_ui/panels/inspector_panel.h"
#include "editor_ui/panels/key_map.h"
#include "editor_ui/panels/no_light_hint.h"
#include "editor_ui/panels/notice.h"
#include "editor_ui/panels/outliner_panel.h"
#include "editor_ui/panels/overlay_panel.h"
#include "editor_ui/panels/palette.h"
#include "editor_ui/panels/save_dialog.h"
#include "editor_ui/panels/start_screen.h"
#include "editor_ui/panels/theme.h"
#include "editor_ui/panels/timeline.h"
#include "editor_ui/panels/viewport_panel.h"
#include "editor_ui/view/gizmo.h"

#include <imgui.h>
#include <imgui_internal.h> // ClearActiveID, ClosePopupToLevel

#include <algorithm>
#include <cmath>
#include <string_view>

namespace limn {

namespace {

struct Rect {
    float x = 0, y = 0, w = 0, h = 0;
};

/// Rectangles of all panels, which tile the window.
struct Places {
    Rect left, right, bottom, bar, picture, timeline, status;
};

constexpr float kSplitter = 5, kMinPanel = 150, kMinPicture = 160; ///< at 96 dpi [px]

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse |
                                    ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoBringToFrontOnFocus;
constexpr ImGuiWindowFlags kNoScroll =
    ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse;

} // namespace

static float splitterWidth() {
    return std::floor(kSplitter * uiScale());
}

/// Sizes of the panels on the screen [px]: within the window, the picture never smaller than
/// kMinPicture where there is room.
static LayoutState fitted(LayoutState layout, float width, float height) {
    const float scale = uiScale();
    const float picture = kMinPicture * scale, panel = kMinPanel * scale;
    const float sides = std::max(width - picture - 2 * splitterWidth(), 2 * 20.f);
    layout.left = std::clamp(layout.left * scale, std::min(panel, sides / 2), sides / 2);
    layout.right =
        std::clamp(layout.right * scale, std::min(panel, sides / 2), sides - layout.left);
    const float maxBottom = std::max(height - picture, 20.f);
    layout.bottom = layout.bottomOpen ? std::clamp(layout.bottom * scale,
                                                   std::min(80 * scale, maxBottom), maxBottom)
                                      : std::min(closedBottomHeight(), maxBottom);
    return layout;
}

/// `animated`: there is a row for the time below the picture.
static Places placesOf(const LayoutState& layout, float menuHeight, bool animated) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float frame = ImGui::GetFrameHeight();
    const float splitter = splitterWidth(), scale = uiScale();
    const float statusHeight = frame + 10 * scale, barHeight = frame + 12 * scale;
    const float top = menuHeight, height = std::max(display.y - top - statusHeight, 1.f);
    const float upper = std::max(height - layout.bottom - splitter, 1.f);
    const float middleX = layout.left + splitter;
    const float middleW = std::max(display.x - layout.left - layout.right - 2 * splitter, 1.f);
    Places p;
    p.left = {0, top, layout.left, upper};
    p.right = {display.x - layout.right, top, layout.right, upper};
    p.bar = {middleX, top, middleW, barHeight};
    const float timeHeight = animated ? barHeight : 0;
    p.picture = {middleX, top + barHeight, middleW, std::max(upper - barHeight - timeHeight, 1.f)};
    p.timeline = {middleX, p.picture.y + p.picture.h, middleW, timeHeight};
    p.bottom = {0, top + height - layout.bottom, display.x, layout.bottom};
    p.status = {0, top + height, display.x, statusHeight};
    return p;
}

static bool beginFixed(const char* name, const Rect& r, ImGuiWindowFlags extra = 0) {
    ImGui::SetNextWindowPos({r.x, r.y});
    ImGui::SetNextWindowSize({std::max(r.w, 1.f), std::max(r.h, 1.f)});
    return ImGui::Begin(name, nullptr, kFixed | extra);
}

/// A strip between two panels that can be dragged; returns how far [px].
static float splitter(const char* name, const Rect& r, bool vertical) {
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1, 1});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
    beginFixed(name, r);
    ImGui::InvisibleButton("grip", {r.w, r.h});
    const bool held = ImGui::IsItemActive();
    if (held || ImGui::IsItemHovered()) {
        ImGui::SetMouseCursor(vertical ? ImGuiMouseCursor_ResizeEW : ImGuiMouseCursor_ResizeNS);
        ImGui::GetWindowDrawList()->AddRectFilled({r.x, r.y}, {r.x + r.w, r.y + r.h},
                                                  color::accent());
    }
    ImGui::End();
    ImGui::PopStyleVar(3);
    const ImVec2 d = ImGui::GetIO().MouseDelta;
    return held ? (vertical ? d.x : d.y) : 0.f;
}

/// Panels that the user drags get the size `shown` on the screen, and what they are dragged by.
static void splitters(LayoutState& wanted, const LayoutState& shown, const Places& p) {
    const float width = splitterWidth();
    const auto drag = [](float dragged, float from, float& to) {
        if (dragged != 0)
            to = (from + dragged) / uiScale();
    };
    drag(splitter("split left", {p.left.w, p.left.y, width, p.left.h}, true), shown.left,
         wanted.left);
    drag(-splitter("split right", {p.right.x - width, p.right.y, width, p.right.h}, true),
         shown.right, wanted.right);
    if (wanted.bottomOpen)
        drag(-splitter("split bottom", {p.bottom.x, p.bottom.y - width, p.bottom.w, width}, false),
             shown.bottom, wanted.bottom);
}

static void picturePanel(EditorState& state, const Rect& place) {
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
    beginFixed("picture", place, ImGuiWindowFlags_NoBackground | kNoScroll);
    viewportPanel(state);
    ImGui::End();
    ImGui::PopStyleVar(2);
}

static void rightPanels(EditorState& state, Rect place) {
    const bool overlay = state.overlay.options.kind != nullptr;
    const float inspector = overlay ? std::floor(0.42f * place.h) : place.h;
    beginFixed("inspector", {place.x, place.y, place.w, inspector});
    inspectorPanel(state);
    ImGui::End();
    if (!overlay)
        return;
    followSelection(state);
    beginFixed("overlay", {place.x, place.y + inspector, place.w, place.h - inspector});
    overlayPanel(state);
    ImGui::End();
}

static void panels(EditorState& state, float menuHeight) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const LayoutState layout =
        fitted(state.layout, display.x,
               display.y - menuHeight - 2 * ImGui::GetFrameHeight() - 22 * uiScale());
    const bool animated = animationLength(state) > 0;
    const Places p = placesOf(layout, menuHeight, animated);
    beginFixed("outliner", p.left);
    outlinerPanel(state);
    ImGui::End();
    rightPanels(state, p.right);
    beginFixed("bottom", p.bottom, state.layout.bottomOpen ? 0 : kNoScroll);
    bottomPanel(state);
    ImGui::End();
    beginFixed("view bar", p.bar, kNoScroll);
    viewBar(state);
    ImGui::End();
    picturePanel(state, p.picture);
    if (animated) {
        beginFixed("time", p.timeline, kNoScroll);
        timeline(state);
        ImGui::End();
    }
    startScreen(state);
    noLightHint(state);
    noticeBox(state);
    beginFixed("status", p.status, kNoScroll);
    statusBar(state);
    ImGui::End();
    splitters(state.layout, layout, p);
}

/// The topmost popup as an index into ImGui's stack of open ones; of a menu with its submenus the
/// menu in the bar, for the mouse over its row would open a submenu again at once.
static int topmostPopup() {
    const ImVector<ImGuiPopupData>& open = ImGui::GetCurrentContext()->OpenPopupStack;
    const auto isMenu = [&](int i) {
        return open[i].Window && (open[i].Window->Flags & ImGuiWindowFlags_ChildMenu);
    };
    int top = open.Size - 1;
    while (top > 0 && isMenu(top) && isMenu(top - 1))
        --top;
    return top;
}

/// Esc ends what is nearest to the user: a drag, which it takes back, else the topmost menu or
/// popup, else the placing of a light. Returns false if there is none of these.
static bool escape(EditorState& state) {
    if (state.view.drag || (state.gesture && ImGui::IsMouseDown(0))) {
        ImGui::ClearActiveID();
        cancelDrag(state);
        return true;
    }
    if (const int popup = topmostPopup(); popup >= 0)
        ImGui::ClosePopupToLevel(popup, true);
    else if (!state.view.placing)
        return false;
    else
        state.view.placing.reset();
    return true;
}

/// Whether a text field leaves this key to the editor: it has Ctrl and a letter that edits no text,
/// or it is F1 or F12.
static bool worksWhileTyping(const Shortcut& shortcut) {
    constexpr std::string_view kOfText = "ACVXYZ";
    const bool letter = shortcut.key >= 'A' && shortcut.key <= 'Z';
    if (letter && (shortcut.mods & kCtrl))
        return kOfText.find(char(shortcut.key)) == std::string_view::npos;
    return shortcut.key == key::kF1 || shortcut.key == key::kF12;
}

static constexpr Shortcut kEsc{key::kEscape, kNoMods};

/// Assigns the key to the action whose row in the sheet of keys waits for it. Returns false if no
/// row waits.
static bool takeNewKey(EditorState& state, const Shortcut& pressed) {
    std::string& id = state.palette.assigning;
    if (id.empty())
        return false;
    const bool none = pressed == Shortcut{key::kBackspace, kNoMods};
    const bool assigned = none || isAssignable(pressed);
    if (assigned)
        assignKey(state, actionById(id.c_str()), none ? Shortcut{} : pressed);
    if (assigned || pressed == kEsc)
        id.clear();
    return true;
}

static void shortcuts(EditorState& state, std::span<const Shortcut> pressed) {
    const bool typing = ImGui::GetIO().WantTextInput;
    const bool flying = state.view.navigation == Navigation::Fly; // W, Q, ... steer
    const bool modal = state.fileBrowser || state.confirm || state.recovery || state.exportDialog;
    for (const Shortcut& shortcut : pressed)
        if (takeNewKey(state, shortcut))
            continue;
        else if (!modal && shortcut == kEsc && escape(state))
            continue;
        else if (!modal && !typing && keyOfDrag(state, shortcut))
            continue;
        else if (!modal && (!typing || worksWhileTyping(shortcut)) &&
                 !(flying && shortcut.mods == kNoMods) && runShortcut(state, shortcut) && typing)
            ImGui::ClearActiveID(); // what is typed next is not for the field
}

void drawEditor(EditorState& state, std::span<const Shortcut> pressed) {
    if (state.playing) // after a sleep: no leap
        advanceTime(state, double(std::min(ImGui::GetIO().DeltaTime, 0.25f)));
    setThemeColors(state.lightTheme);
    shortcuts(state, pressed);
    menuBar(state);
    panels(state, ImGui::GetFrameHeight());
    palettePopup(state);
    helpSheet(state);
    fileBrowserDialog(state);
    exportDialog(state);
    saveDialog(state);
    recoveryDialog(state);
    if (!ImGui::IsAnyItemActive() && !state.view.drag)
        commitGesture(state);
}

} // namespace limn
