// SPDX-License-Identifier: MIT
// Someone who opens every menu by the mouse, on the screen of a small laptop.
#include "editor_ui/panels/action.h"
#include "editor_ui/panels/menu.h"
#include "tests/journeys/journey.h"

#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace limn {
namespace {

constexpr float kBar = 23; // height of the menu bar [px]

struct MenuJourney : Journey {
    const ScreenRect bar{{0, 0}, {600, kBar}};
    const ScreenRect belowBar{{0, kBar}, {900, 450}}; ///< where menus are

    /// Opens a document with a long name.
    void startWithLongName() {
        startScreen(1366, 768);
        if (!screen)
            return;
        const std::string named =
            (scratch /
             "Treppenhaus am Donauufer, Entwurf f\u00fcr den Abend (Kopie, endg\u00fcltige "
             "Fassung, zweimal \u00fcberarbeitet).limn")
                .string();
        std::filesystem::rename(draftCornell(), named);
        startEditor(named, {"--no-bake"});
        ASSERT_TRUE(sees("Floor", 120, outliner()));
    }

    /// Labels of the menu's own actions.
    static std::vector<std::string> labelsIn(Menu menu) {
        std::vector<std::string> labels;
        for (const Action& action : actions())
            if (action.menu == menu)
                labels.emplace_back(action.label);
        return labels;
    }

    /// Whether the first and the last row of the menu are in sight.
    void expectOpen(const MenuPlace& place) {
        const std::vector<std::string> labels = place.menu == Menu::Overlay
                                                    ? std::vector<std::string>{"No overlay"}
                                                    : labelsIn(place.menu);
        EXPECT_TRUE(sees(labels.front(), 5, belowBar)) << place.label;
        EXPECT_TRUE(sees(labels.back(), 5, belowBar)) << place.label;
    }
};

TEST_F(MenuJourney, EveryMenuOpensByAClickWithinASmallWindow) {
    startWithLongName();
    if (!screen)
        return;
    for (const MenuPlace& top : menuPlaces()) {
        if (top.parent)
            continue;
        click(top.label, bar);
        expectOpen(top);
        shot(top.label);
        for (const MenuPlace& place : menuPlaces()) {
            if (place.parent != top.menu)
                continue;
            const std::vector<ScreenRect> rows = findText(screen->picture(), place.label, belowBar);
            EXPECT_FALSE(rows.empty()) << place.label;
            if (rows.empty())
                continue;
            screen->move(rows.front().middle());
            expectOpen(place);
            shot(fmt::format("{}-{}", top.label, place.label));
        }
        screen->key("Escape");
        EXPECT_TRUE(seesNoMore(labelsIn(top.menu).back(), 5)) << top.label;
    }
}

TEST_F(MenuJourney, TheWorkspaceNamedAsAMenuIsReached) {
    startWithLongName();
    if (!screen)
        return;
    const std::vector<ScreenRect> labels = findText(screen->picture(), "Bake", bar);
    ASSERT_EQ(labels.size(), 2u) << "the menu and the workspace";
    clickAt(labels.back().middle());
    rest();
    settle(10);
    shot("bake-workspace");
    EXPECT_FALSE(sees("Bake until the error holds", 1)) << "the menu";
    EXPECT_TRUE(sees("Last bake", 5));
}

} // namespace
} // namespace limn
