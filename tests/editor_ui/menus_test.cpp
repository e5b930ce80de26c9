// SPDX-License-Identifier: MIT
// That every menu and workspace opens by a click, in windows of all sizes.
#include "editor_ui/panels/action.h"
#include "editor_ui/panels/menu.h"
#include "tests/editor_ui/drawn_items.h"
#include "tests/editor_ui/headless.h"

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace limn::menus_test {
namespace {

constexpr std::size_t kMenus = 6; // of the menu bar; the workspaces' buttons follow

struct MenuUser {
    HeadlessUi ui;
    DrawnItems drawn;
    EditorState state = fullEditor();

    MenuUser(float width, float height, float scale = 1) : ui(width, height, scale) {
        state.recent = {"/one/house.limn"};
        frames();
    }
    void frames() {
        for (int i = 0; i < 4; ++i)
            ui.frames(state);
    }
    void hover(const ImRect& box) {
        ui.mouse(box.GetCenter().x, box.GetCenter().y);
        frames();
    }
    void click(const ImRect& box) {
        hover(box);
        ui.button(true);
        ui.frames(state); // as long as a finger takes
        ui.frames(state);
        ui.button(false);
        frames();
    }
    /// Boxes of a window's widgets in the order of drawing.
    std::vector<ImRect> boxesIn(const std::string& window) const {
        std::vector<ImRect> boxes;
        for (const DrawnItem& item : drawn.lastFrame())
            if (window == item.window->Name)
                boxes.push_back(item.box);
        return boxes;
    }
    /// Turns the wheel over a menu until a row of it is in sight.
    void scrollTo(const ImGuiWindow& menu, std::size_t row) {
        for (int i = 0; i < 100; ++i) {
            const ImRect box = boxesIn(menu.Name).at(row);
            const bool above = box.Min.y < menu.InnerRect.Min.y;
            if (!above && box.Max.y <= menu.InnerRect.Max.y)
                return;
            ui.mouse(menu.InnerRect.Min.x + 2, menu.InnerRect.GetCenter().y); // left of its rows
            ui.input.events.push_back(
                {.kind = InputEvent::Kind::Scroll, .position = {0, above ? 0.5f : -0.5f}});
            ui.frames(state);
        }
        ADD_FAILURE() << "row " << row << " is not reached";
    }
};

/// Menus that are open, from the menu bar's on.
const ImVector<ImGuiPopupData>& openMenus() {
    return ImGui::GetCurrentContext()->OpenPopupStack;
}

/// Opens a menu by a click on the bar, and a submenu of each that is open by the row.
void open(MenuUser& user, std::size_t menu, const std::vector<std::size_t>& path) {
    ImGui::ClosePopupsOverWindow(nullptr, false);
    user.frames();
    user.click(user.boxesIn("##MainMenuBar").at(menu));
    for (const std::size_t row : path) {
        const ImGuiWindow& parent = *openMenus().back().Window;
        user.scrollTo(parent, row);
        user.hover(user.boxesIn(parent.Name).at(row));
    }
}

/// Opens every submenu below an open menu and asks `expect` of each.
template <class Expect>
void openSubmenus(MenuUser& user, std::size_t menu, std::vector<std::size_t> path,
                  const Expect& expect) {
    const std::size_t depth = path.size() + 1;
    const std::size_t rows = user.boxesIn(openMenus().back().Window->Name).size();
    path.push_back(0);
    for (std::size_t row = 0; row < rows; ++row) {
        path.back() = row;
        open(user, menu, path);
        if (std::size_t(openMenus().Size) <= depth)
            continue;
        expect(*openMenus().back().Window);
        openSubmenus(user, menu, path, expect);
    }
}

/// Opens each menu and its submenus, and asks `expect` of each. Returns how many there were.
template <class Expect>
std::size_t openAll(MenuUser& user, const Expect& expect) {
    std::size_t count = 0;
    const auto counted = [&](const ImGuiWindow& menu) {
        ++count;
        expect(menu);
    };
    for (std::size_t i = 0; i < kMenus; ++i) {
        open(user, i, {});
        EXPECT_EQ(openMenus().Size, 1) << "menu " << i;
        if (openMenus().Size != 1)
            continue;
        EXPECT_GE(openMenus()[0].Window->Pos.y, std::floor(ImGui::GetFrameHeight()))
            << "covers the bar";
        counted(*openMenus()[0].Window);
        openSubmenus(user, i, {}, counted);
    }
    return count;
}

void expectInside(const ImGuiWindow& menu) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    EXPECT_GE(menu.Pos.x, 0);
    EXPECT_GE(menu.Pos.y, 0);
    EXPECT_LE(menu.Pos.x + menu.Size.x, display.x);
    EXPECT_LE(menu.Pos.y + menu.Size.y, display.y);
    EXPECT_LE(menu.ContentSize.y, menu.InnerRect.GetHeight() + menu.ScrollMax.y)
        << "all is reached";
}

/// The menus' places; Recent; a submenu for each technique that has overlays.
std::size_t menuCount() {
    std::size_t count = menuPlaces().size() + 1;
    for (const Technique* technique : techniques())
        count += !technique->overlays.empty();
    return count;
}

TEST(Menus, OpenByAClickWithinTheWindowAtEverySize) {
    struct Screen {
        float width, height, scale;
        bool scrolls; // a menu may need that
    };
    for (const Screen& screen : {Screen{320, 240, 1, true}, Screen{640, 480, 1, false},
                                 Screen{1280, 720, 1.5f, false}, Screen{1366, 768, 1, false}}) {
        SCOPED_TRACE(fmt::format("{} x {}", screen.width, screen.height));
        MenuUser user(screen.width, screen.height, screen.scale);
        const std::size_t count = openAll(user, [&](const ImGuiWindow& menu) {
            expectInside(menu);
            EXPECT_TRUE(screen.scrolls || menu.ScrollMax.y == 0) << menu.Name;
        });
        EXPECT_EQ(count, menuCount());
    }
}

TEST(Menus, OfTheBarAboveThePictureOpenByAClickWithinTheWindow) {
    for (const float width : {1024.f, 1366.f}) {
        MenuUser user(width, 480);
        std::size_t lists = 0;
        for (const ImRect& box : user.boxesIn("view bar")) {
            user.state.compare.mode = Compare::Off; // the button "Ref" makes room for another
            user.frames();
            user.click(box);
            if (openMenus().empty())
                continue;
            ++lists;
            expectInside(*openMenus()[0].Window);
            ImGui::ClosePopupsOverWindow(nullptr, false);
        }
        EXPECT_EQ(lists, 4u) << "techniques, views, overlays and exposures";
    }
}

TEST(Menus, ListEveryActionOnce) {
    MenuUser user(1280, 1024);
    std::size_t rows = 0;
    const std::size_t count =
        openAll(user, [&](const ImGuiWindow& menu) { rows += user.boxesIn(menu.Name).size(); });
    constexpr std::size_t kSteps = 3; // of the gizmo
    EXPECT_EQ(rows, actions().size() + (count - kMenus) + user.state.recent.size() + kSteps);
}

TEST(Menus, CloseWithTheirSubmenusByOneEscape) {
    MenuUser user(1280, 1024);
    std::size_t submenus = 0;
    const std::size_t edit = 1;
    open(user, edit, {});
    const std::size_t rows = user.boxesIn(openMenus()[0].Window->Name).size();
    for (std::size_t row = 0; row < rows; ++row) {
        open(user, edit, {row});
        submenus += openMenus().Size == 2;
        user.ui.tap(key::kEscape);
        user.frames();
        EXPECT_TRUE(openMenus().empty()) << row;
    }
    EXPECT_GT(submenus, 0u);
}

TEST(Menus, AreListedInTheirOrder) {
    std::size_t index = 0;
    for (const MenuPlace& place : menuPlaces())
        EXPECT_EQ(std::size_t(place.menu), index++) << place.label;
    EXPECT_EQ(index, std::size_t(Menu::Help) + 1);
    EXPECT_EQ(topMenu(Menu::Overlay), Menu::View);
    EXPECT_EQ(topMenu(Menu::Help), Menu::Help);
}

TEST(WorkspaceButtons, GoToTheirWorkspaces) {
    MenuUser user(1366, 768);
    const std::vector<ImRect> bar = user.boxesIn("##MainMenuBar");
    ASSERT_EQ(bar.size(), kMenus + kWorkspaceNames.size());
    for (const Workspace workspace :
         {Workspace::Compare, Workspace::Inspect, Workspace::Bake, Workspace::Light}) {
        user.click(bar[kMenus + std::size_t(workspace)]);
        EXPECT_EQ(user.state.workspace, workspace) << kWorkspaceNames[std::size_t(workspace)];
        EXPECT_TRUE(openMenus().empty());
    }
}

} // namespace
} // namespace limn::menus_test
