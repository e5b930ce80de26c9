// SPDX-License-Identifier: MIT
// Start screen, sheet of keys, axes and read-out over the picture, and that nothing is clipped.
#include "editor_ui/panels/action.h"
#include "editor_ui/panels/bar_combo.h"
#include "editor_ui/panels/theme.h"
#include "editor_ui/panels/time_history.h"
#include "editor_ui/panels/workspace.h"
#include "engine/techniques/technique_table.h"
#include "tests/editor_ui/headless.h"

#include <imgui_internal.h>

#include <algorithm>
#include <chrono>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace limn::workspace_test {
namespace {

const ImGuiWindow* windowNamed(const char* name) {
    const ImGuiWindow* window = ImGui::FindWindowByName(name);
    return window && window->WasActive ? window : nullptr;
}

void click(HeadlessUi& ui, EditorState& state, ImVec2 at) {
    ui.mouse(at.x, at.y);
    ui.frames(state);
    ui.button(true);
    ui.button(false);
    ui.frames(state);
    ui.frames(state);
}

TEST(StartScreen, ListsSamplesAndRecentDocumentsWhichAClickOpens) {
    HeadlessUi ui;
    EditorState state = emptyEditor();
    state.samples = {"atrium", "cornell"};
    state.recent = {"/scenes/house.limn", "/scenes/" + std::string(200, 'W') + ".gltf"};
    ui.frames(state);
    ui.frames(state);
    ui.frames(state);
    const ImGuiWindow* start = windowNamed("start");
    ASSERT_TRUE(start);
    std::set<std::string> opened;
    for (float x : {0.2f, 0.8f})
        for (float y = start->Pos.y; y < start->Pos.y + start->Size.y; y += 6) {
            click(ui, state, {start->Pos.x + x * start->Size.x, y});
            for (const Request& request : state.requests)
                if (request.kind == Request::Kind::Open)
                    opened.insert(request.path);
            state.requests.clear();
            state.fileBrowser.reset();
            ImGui::ClosePopupsOverWindow(nullptr, false);
            ui.frames(state);
        }
    EXPECT_EQ(opened,
              (std::set<std::string>{"atrium", "cornell", state.recent[0], state.recent[1]}));
}

TEST(StartScreen, IsGoneWhileSomethingIsOpenOrBeingOpened) {
    HeadlessUi ui;
    EditorState full = fullEditor();
    ui.frames(full);
    EXPECT_FALSE(windowNamed("start"));
    EditorState loading = emptyEditor();
    loading.loading = "cornell";
    ui.frames(loading);
    ui.frames(loading);
    EXPECT_FALSE(windowNamed("start"));
    loading.loading.clear();
    ui.frames(loading);
    ui.frames(loading);
    EXPECT_TRUE(windowNamed("start"));
}

/// The right edge of the backgrounds of all labels in the picture, or of those that reach above
/// `bottom` [px]; 0: there is no label.
float rightEndOfLabels(float bottom = 1e9f) {
    float end = 0;
    for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
        for (const ImDrawVert& v : window->DrawList->VtxBuffer)
            if (window->Active && v.col == color::kGround && v.pos.y < bottom)
                end = std::max(end, v.pos.x);
    return end;
}

TEST(CompareOverlay, ItsTextStaysInANarrowPicture) {
    for (const float scale : {1.f, 2.f}) {
        HeadlessUi ui(900 * scale, 600 * scale, scale);
        EditorState state = fullEditor();
        state.view.showLights = false; // their icons are cut off at the picture's edge
        state.compare.mode = Compare::Difference;
        state.compare.reference.samples = 64;
        state.compare.reference.running = true;
        state.compare.reference.error = Comparison{};
        for (const float split : {0.f, 0.5f, 1.f}) {
            state.compare.split = split;
            ui.frames(state);
            ui.frames(state);
            const float edge = state.view.origin.x + state.view.size.x;
            EXPECT_GT(rightEndOfLabels(), state.view.origin.x) << "there are labels";
            EXPECT_LE(rightEndOfLabels(), edge) << scale << ", " << split;
        }
    }
}

TEST(CompareOverlay, SaysThatItWaitsUntilThereIsAReference) {
    HeadlessUi ui(1600, 900);
    EditorState state = fullEditor();
    state.view.showLights = false;
    const auto labels = [&](Compare mode) {
        state.compare.mode = mode;
        ui.frames(state);
        ui.frames(state);
        return rightEndOfLabels(state.view.origin.y + 40);
    };
    const float waiting = labels(Compare::Reference);
    EXPECT_EQ(labels(Compare::SquaredError), waiting);
    EXPECT_EQ(labels(Compare::Flip), waiting);
    state.compare.reference.samples = 4; // a reference, but no error of it yet
    EXPECT_EQ(labels(Compare::Difference), waiting);
    EXPECT_NE(labels(Compare::Reference), waiting);
    state.compare.reference.error = Comparison{};
    EXPECT_NE(labels(Compare::SquaredError), waiting);
}

TEST(HelpSheet, OpensByItsKeyAndEscClosesIt) {
    HeadlessUi ui;
    EditorState state = fullEditor();
    state.selection = {idNamed(state, "Lamp")};
    ui.frames(state);
    ui.tap(key::kF1);
    ui.frames(state);
    ui.frames(state);
    EXPECT_TRUE(
        ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel));
    ui.tap(key::kEscape);
    ui.frames(state);
    ui.frames(state);
    EXPECT_FALSE(
        ImGui::IsPopupOpen(nullptr, ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel));
    EXPECT_FALSE(state.selection.empty()) << "Esc closed the sheet and nothing else";
}

TEST(HelpSheet, ItsColumnsHoldWordsNotLetters) {
    for (const float scale : {1.f, 2.f}) {
        HeadlessUi ui(640 * scale, 480 * scale, scale);
        EditorState state = fullEditor();
        ui.frames(state);
        ui.tap(key::kF1);
        ui.frames(state);
        ui.frames(state);
        ImGuiContext& context = *ImGui::GetCurrentContext();
        const ImGuiWindow* sheet = context.OpenPopupStack.front().Window;
        ASSERT_TRUE(sheet);
        const ImGuiTable* table = nullptr;
        for (int i = 0; i < context.Tables.GetMapSize(); ++i)
            if (const ImGuiTable* t = context.Tables.TryGetMapData(i); t && t->OuterWindow == sheet)
                table = t;
        ASSERT_TRUE(table);
        for (int column = 0; column < table->ColumnsCount; ++column)
            EXPECT_GT(table->Columns[column].WidthGiven, 8 * context.FontSize) << column;
    }
}

// Every key that is not a character has a name of its own.
TEST(HelpSheet, EveryShortcutHasAText) {
    std::set<std::string> texts;
    for (const Action& action : actions())
        for (const Shortcut& s : {action.shortcut, action.alternative})
            if (s.key != key::kNone) {
                const std::string text = shortcutText(s);
                EXPECT_TRUE(texts.insert(text).second) << text;
                for (const char c : text)
                    EXPECT_TRUE(c >= ' ' && c <= '~') << action.id;
                EXPECT_NE(text.back(), ' ') << action.id;
            }
}

/// The places of the widget's ends for a view from the front: X to the right, Y up.
TEST(AxisWidget, AClickOnAnEndLooksFromThereAndPicksNothing) {
    HeadlessUi ui;
    EditorState state = fullEditor();
    state.view.camera = {.eye = {0, 0, 6}, .target = {0, 0, 0}};
    ui.frames(state);
    const ViewState& view = state.view;
    const float reach = 28 + 9 + 8;
    const ImVec2 centre(view.origin.x + view.size.x - reach, view.origin.y + reach);
    state.selection = {idNamed(state, "Lamp")};
    click(ui, state, {centre.x + 28, centre.y});
    EXPECT_GT(state.view.camera.eye.x, 5) << "from +X, the right";
    EXPECT_EQ(state.selection.size(), 1U);
    // From the right, -Z is to the right of the picture and Y is still up.
    click(ui, state, {centre.x, centre.y - 28});
    EXPECT_GT(state.view.camera.eye.y, 4) << "from the top";
    EXPECT_TRUE(state.history.edits.empty());
}

/// An editor in which everything that may be long is long.
EditorState longEditor() {
    EditorState state = fullEditor();
    state.projectPath =
        "/Szenen/Donaudampfschifffahrtselektrizitätenhauptbetriebswerkbauunter"
        "beamtengesellschaftsgebäude (Kopie, endgültige Fassung, überarbeitet).limn";
    state.bake.freshness = BakeFreshness::Needed;
    state.bake.changes = "Donaudampfschifffahrtsgesellschaftskapitänskajütentür moved, Rays per "
                         "cache changed, and 12 more";
    state.bake.last.seconds = {{"charts", 1.2}, {"trace", 123.4}, {"cut", 3}};
    state.bake.last.keptStages = {"charts"};
    state.bake.measured = {state.bake.last.seconds, 3e9, {}, 1234};
    state.bake.expected = state.bake.measured;
    for (int i = 0; i < 100; ++i)
        state.errors.points.push_back({i * 12.5, 123.456 / (i + 1), 0.1});
    for (FrameTime& frame : state.frame.frames.during)
        frame = {12345.6, 7, 8, 9};
    state.frame.pictures = 3;
    state.frame.width = 1920, state.frame.height = 1080;
    return state;
}

/// No window's content is wider than it is, or higher where it cannot scroll. The menu bar lays its
/// items out from both of its ends.
void expectNothingClipped(const std::string& where) {
    for (const ImGuiWindow* w : ImGui::GetCurrentContext()->Windows) {
        const std::string name = w->Name;
        if (!w->WasActive || w->Hidden || name == "##MainMenuBar" || name.starts_with("Debug"))
            continue;
        const ImVec2 room = w->InnerRect.GetSize();
        if (!(w->Flags & ImGuiWindowFlags_HorizontalScrollbar)) {
            EXPECT_LE(w->WindowPadding.x + w->ContentSize.x, room.x + 1) << name << ": " << where;
        }
        if (w->Flags & ImGuiWindowFlags_NoScrollbar) {
            EXPECT_LE(w->WindowPadding.y + w->ContentSize.y, room.y + 1) << name << ": " << where;
        }
    }
}

TEST(Workspace, NothingIsClippedAtAnySizeOfTheScreenAndInBothThemes) {
    struct Screen {
        float width, height, scale;
    };
    for (const Screen& screen : {Screen{1280, 720, 1}, Screen{1920, 1080, 1}, Screen{2560, 1440, 2},
                                 Screen{3840, 2160, 2}})
        for (const bool light : {false, true})
            for (const bool empty : {false, true}) {
                HeadlessUi ui(screen.width, screen.height, screen.scale);
                EditorState state = empty ? emptyEditor() : longEditor();
                state.lightTheme = light;
                state.recent = {longEditor().projectPath};
                state.samples = {"atrium", "cornell"};
                std::vector<ObjectId> ids = {0};
                for (const auto& [id, object] : state.document.objects)
                    ids.push_back(id);
                for (const ObjectId id : ids) {
                    state.selection.clear();
                    if (id != 0)
                        state.selection = {id};
                    for (int i = 0; i < 3; ++i)
                        ui.frames(state);
                    expectNothingClipped(std::to_string(screen.width) + " x " +
                                         std::to_string(screen.height) + ", object " +
                                         std::to_string(id));
                }
            }
}

TEST(Workspaces, NothingIsClippedInAnyOfThem) {
    struct Screen {
        float width, height, scale;
    };
    for (const Screen& screen :
         {Screen{1280, 720, 1}, Screen{1920, 1080, 1}, Screen{2560, 1440, 2}})
        for (const bool empty : {false, true}) {
            HeadlessUi ui(screen.width, screen.height, screen.scale);
            EditorState state = empty ? emptyEditor() : longEditor();
            for (std::size_t i = 0; i < kWorkspaceNames.size(); ++i)
                for (std::size_t tab = 0; tab < kBottomTabNames.size(); ++tab) {
                    switchWorkspace(state, Workspace(i));
                    state.layout.bottomOpen = true;
                    state.layout.tab = BottomTab(tab);
                    for (int frame = 0; frame < 3; ++frame)
                        ui.frames(state);
                    expectNothingClipped(fmt::format("{} x {}, {}, {}", screen.width, screen.height,
                                                     kWorkspaceNames[i], kBottomTabNames[tab]));
                }
        }
}

TEST(Workspaces, EachRemembersItsPanelsOverlayAndComparison) {
    EditorState state = fullEditor();
    EXPECT_FALSE(state.layout.bottomOpen) << "the picture is large";
    state.layout.left = 123;
    state.overlay.options.kind = overlayKinds().front();
    switchWorkspace(state, Workspace::Compare);
    EXPECT_EQ(state.compare.mode, Compare::Reference);
    EXPECT_EQ(state.overlay.options.kind, nullptr);
    EXPECT_NE(state.layout.left, 123);
    state.compare.mode = Compare::Flip;
    state.layout.tab = BottomTab::Log;
    switchWorkspace(state, Workspace::Light);
    EXPECT_EQ(state.layout.left, 123);
    EXPECT_EQ(state.overlay.options.kind, overlayKinds().front());
    EXPECT_EQ(state.compare.mode, Compare::Off);
    switchWorkspace(state, Workspace::Compare);
    EXPECT_EQ(state.compare.mode, Compare::Flip);
    EXPECT_EQ(state.layout.tab, BottomTab::Log);
    resetWorkspace(state);
    EXPECT_EQ(state.compare.mode, Compare::Reference);
    EXPECT_EQ(state.layout, defaultWorkspaces()[std::size_t(Workspace::Compare)].layout);
    switchWorkspace(state, Workspace::Light);
    EXPECT_EQ(state.layout.left, 123) << "the others are not reset";
}

TEST(BottomPanel, ATabOpensItAndTheOpenTabClosesIt) {
    HeadlessUi ui;
    EditorState state = fullEditor();
    for (int i = 0; i < 3; ++i)
        ui.frames(state);
    const float closed = state.view.size.y;
    std::set<BottomTab> opened;
    for (float x = 40; x < 600; x += 12) {
        const ImGuiWindow* bottom = windowNamed("bottom");
        ASSERT_TRUE(bottom);
        const ImVec2 at(x, bottom->Pos.y + 20);
        click(ui, state, at);
        if (!state.layout.bottomOpen)
            continue; // between two tabs
        opened.insert(state.layout.tab);
        ui.frames(state);
        EXPECT_LT(state.view.size.y, closed);
        click(ui, state, {x, windowNamed("bottom")->Pos.y + 20});
        EXPECT_FALSE(state.layout.bottomOpen) << x;
        ui.frames(state);
        ui.frames(state);
        EXPECT_EQ(state.view.size.y, closed);
    }
    EXPECT_EQ(opened.size(), kBottomTabNames.size());
}

/// What such a list and, below the mouse, its tooltip say.
std::string textOfBarCombo(const std::string& shown, float width) {
    ImGui::GetIO().MousePos = {20, 20};
    for (int frame = 0; frame < 3; ++frame) { // what is hovered is known from the frame before
        ImGui::NewFrame();
        ImGui::SetNextWindowPos({0, 0});
        ImGui::Begin("bar", nullptr, ImGuiWindowFlags_NoDecoration);
        ImGui::LogToClipboard(); // until the tooltip ends, or the window
        if (beginBarCombo("##combo", shown, "What it is", width))
            ImGui::EndCombo();
        ImGui::End();
        ImGui::Render();
    }
    return ImGui::GetClipboardText();
}

TEST(BarCombo, SaysInItsTooltipWhatItIsTooNarrowFor) {
    const HeadlessUi ui;
    const std::string wide = textOfBarCombo("Light field probes", 300);
    EXPECT_EQ(wide.find("..."), wide.npos) << wide;
    EXPECT_LT(wide.find("Light field probes"), wide.find("What it is")) << wide;
    EXPECT_EQ(wide.find("Light field probes"), wide.rfind("Light field probes")) << wide;
    const std::string narrow = textOfBarCombo("Light field probes", 80);
    EXPECT_LT(narrow.find("..."), narrow.find("Light field probes")) << narrow;
    EXPECT_LT(narrow.find("Light field probes"), narrow.find("What it is")) << narrow;
    EXPECT_NE(narrow.find("What it is"), narrow.npos) << narrow;
}

TEST(Cards, AClickOnAHeaderHidesItsRowsWhateverIsSelected) {
    HeadlessUi ui;
    EditorState state = fullEditor();
    const auto contentHeight = [&](const char* object) {
        state.selection = {idNamed(state, object)};
        for (int i = 0; i < 3; ++i)
            ui.frames(state);
        return windowNamed("inspector")->ContentSize.y;
    };
    const float open = contentHeight("Left"), other = contentHeight("Right");
    const ImGuiWindow* inspector = windowNamed("inspector");
    for (float y = inspector->Pos.y + 40; y < inspector->Pos.y + 300; y += 5) {
        click(ui, state, {inspector->Pos.x + 60, y}); // labels do not react
        if (state.closedCards.contains("Transform"))
            break;
    }
    ASSERT_EQ(state.closedCards, std::set<std::string>{"Transform"});
    EXPECT_LT(contentHeight("Left"), open - 3 * ImGui::GetFontSize());
    EXPECT_LT(contentHeight("Right"), other - 3 * ImGui::GetFontSize());
    state.closedCards.clear();
    EXPECT_EQ(contentHeight("Left"), open);
}

TEST(TextFields, LeaveKeysThatEditNoTextToTheEditor) {
    HeadlessUi ui;
    EditorState state = fullEditor();
    const std::size_t objects = state.document.objects.size();
    for (int i = 0; i < 3; ++i)
        ui.frames(state);
    click(ui, state, {80, ImGui::GetFrameHeight() + 20}); // the filter of the list
    ASSERT_TRUE(ImGui::GetIO().WantTextInput);
    state.selection = {idNamed(state, "Lamp")};
    ui.tap(key::of('C'), kCtrl);
    ui.tap(key::of('H'));
    ui.tap(key::kDelete);
    ui.frames(state);
    EXPECT_EQ(state.document.objects.size(), objects) << "the field's own keys";
    EXPECT_TRUE(state.clipboard.objects.empty());
    ui.tap(key::of('P'), kCtrl);
    for (int i = 0; i < 3; ++i)
        ui.frames(state);
    EXPECT_FALSE(ImGui::GetCurrentContext()->OpenPopupStack.empty()) << "all actions";
}

TEST(ErrorPanel, KeepsTheErrorSinceTheLastEdit) {
    using std::chrono::seconds;
    ErrorHistory history;
    const auto start = ErrorHistory::Clock::now();
    history.restart(start);
    history.add(start + seconds(1), 1, {.nrmse = 0.5, .nrmseNoise = 0.1});
    history.add(start + seconds(2), 1, {.nrmse = 0.5, .nrmseNoise = 0.1});
    ASSERT_EQ(history.points.size(), 1u) << "the same measurement";
    EXPECT_EQ(history.points[0].seconds, 1);
    for (std::uint64_t i = 2; i < 5000; ++i)
        history.add(start + seconds(i), i, {.nrmse = 1 / double(i)});
    EXPECT_LE(history.points.size(), ErrorHistory::kMaxPoints);
    EXPECT_EQ(history.points.front().seconds, 1);
    EXPECT_EQ(history.points.back().seconds, 4999);
    EXPECT_TRUE(std::ranges::is_sorted(history.points, {}, &ErrorHistory::Point::seconds));
    history.restart(start + seconds(6000));
    history.add(start + seconds(6003), 4999, {.nrmse = 1});
    EXPECT_TRUE(history.points.empty()) << "of the picture before the edit";
    history.add(start + seconds(6004), 5000, {.nrmse = 1});
    ASSERT_EQ(history.points.size(), 1u);
    EXPECT_EQ(history.points[0].seconds, 4);
}

TEST(Statistics, ColoursOfStepsCoverNoTextHoweverLongAStepTakes) {
    HeadlessUi ui(1280, 800);
    EditorState state = fullEditor();
    state.layout.bottomOpen = true;
    state.layout.tab = BottomTab::Profile;
    state.relight.last.steps = {{"cache_light", "Cache light", "", 12345.67}};
    for (int i = 0; i < 3; ++i)
        ui.frames(state);
    std::vector<ImDrawVert> vertices;
    const ImDrawData* drawn = ImGui::GetDrawData();
    for (int i = 0; i < drawn->CmdListsCount; ++i)
        for (const ImDrawVert& v : drawn->CmdLists[i]->VtxBuffer)
            vertices.push_back(v);
    ImRect square(FLT_MAX, FLT_MAX, -FLT_MAX, -FLT_MAX);
    for (const ImDrawVert& v : vertices)
        if (v.col == kStepColors[0])
            square.Add(v.pos);
    ASSERT_FALSE(square.IsInverted());
    for (const ImDrawVert& v : vertices)
        EXPECT_FALSE(v.col == ImGui::GetColorU32(ImGuiCol_Text) && square.Contains(v.pos))
            << v.pos.x << ", " << v.pos.y;
}

TEST(PaletteOfActions, IsAsLargeOnAScreenOfTwiceTheDensity) {
    const auto sizeAt = [](float scale) {
        HeadlessUi ui(1280 * scale, 800 * scale, scale);
        EditorState state = fullEditor();
        runAction(state, actionById("edit.palette"));
        for (int i = 0; i < 3; ++i)
            ui.frames(state);
        const ImVector<ImGuiPopupData>& popups = ImGui::GetCurrentContext()->OpenPopupStack;
        return popups.empty() ? ImVec2(0, 0) : popups[0].Window->Size;
    };
    const ImVec2 once = sizeAt(1), twice = sizeAt(2);
    EXPECT_GT(once.x, 0);
    EXPECT_EQ(twice.x, 2 * once.x);
    EXPECT_EQ(twice.y, 2 * once.y);
}

} // namespace
} // namespace limn::workspace_test
