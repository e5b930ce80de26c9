// SPDX-License-Identifier: MIT
// Drives the whole interface with random mouse and keys, without a window or a GPU.
#include "editor_ui/document/document_edit.h"
#include "editor_ui/document/object_rules.h"
#include "editor_ui/document/selection.h"
#include "tests/editor_ui/headless.h"

#include <imgui.h>

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

namespace limn::undo_law_test {
namespace {

void undoAll(EditorState& state) {
    while (state.history.applied > 0) {
        for (const Change& c : state.history.edits[state.history.applied - 1].changes) {
            const auto it = state.document.objects.find(c.id);
            const bool there = it != state.document.objects.end();
            ASSERT_EQ(there, c.after.has_value()); // each edit ends where the next begins
            if (there) {
                ASSERT_TRUE(it->second == *c.after);
            }
        }
        undo(state.history, state.document);
    }
}

/// Someone who clicks, drags, types and presses keys without a plan.
struct RandomUser {
    std::mt19937 rng;
    glm::vec2 mouse{640, 400};
    bool down[3] = {};
    bool alt = false;

    int below(int n) { return int(rng() % unsigned(n)); }

    void moveMouse(HeadlessUi& ui, const EditorState& state) {
        switch (below(down[0] ? 30 : 5)) { // with the button down mostly small moves: drags
        case 0:
            mouse = {float(below(1280)), float(below(800))};
            break;
        case 1:
            mouse = {1280 - float(below(200)), 60 + float(below(420))};
            break; // inspector's widgets
        case 2:
            mouse = {float(below(270)), 60 + float(below(500))};
            break; // outliner
        case 3:
            if (const auto origin = selectionOrigin(state))
                if (const auto p = toPixel(state.view.picture(), *origin))
                    mouse =
                        *p + glm::vec2(float(below(240) - 120), float(below(240) - 120)); // gizmo
            break;
        default:
            mouse += glm::vec2(float(below(41) - 20), float(below(41) - 20));
        }
        ui.mouse(mouse.x, mouse.y);
    }

    void pressKeys(HeadlessUi& ui) {
        static constexpr int kKeys[] = {
            key::kTab,    key::kEnter,  key::kEscape, key::kBackspace, key::kDelete, key::kF2,
            key::of('H'), key::of('W'), key::of('Q'), key::of('F'),    key::of('D'), key::of('Z'),
            key::of('Y'), key::of('A'), key::kUp,     key::kDown,      key::kPad1,   key::kPad7,
            key::of('P'), key::of('B'), key::of('E'), key::of('R'),    key::of('G'), key::of('S'),
            key::of('C'), key::of('V'), key::of('X'), key::kSlash};
        static constexpr std::uint8_t kModifiers[] = {kNoMods, kNoMods, kCtrl,
                                                      kShift,  kAlt,    kCtrl | kShift};
        if (below(8) == 0)
            ui.tap(kKeys[below(int(std::size(kKeys)))], kModifiers[below(6)]);
        if (below(40) == 0) { // orbits, or drags copies
            alt = !alt;
            ui.input.events.push_back({.kind = InputEvent::Kind::Key,
                                       .code = key::kLeftAlt,
                                       .down = alt,
                                       .mods = std::uint8_t(alt ? kAlt : kNoMods)});
        }
        if (below(8) == 0)
            ui.input.events.push_back(
                {.kind = InputEvent::Kind::Character, .code = "0123456789.-exyzXY"[below(18)]});
    }

    void act(HeadlessUi& ui, EditorState& state) {
        if (below(3) == 0)
            moveMouse(ui, state);
        for (int button = 0; button < 3; ++button)
            if (below(button == 0 ? 4 : down[button] ? 3 : 60) == 0) {
                down[button] = !down[button];
                ui.button(down[button], button);
            }
        if (below(20) == 0)
            ui.input.events.push_back(
                {.kind = InputEvent::Kind::Scroll, .position = {0, float(below(3) - 1)}});
        pressKeys(ui);
        if (below(20) == 0) {
            auto it = state.document.objects.begin();
            std::advance(it, below(int(state.document.objects.size())));
            state.selection = {it->first};
        }
        if (below(90) == 0)
            below(3) ? undoEdit(state) : redoEdit(state);
    }
};

/// The law: whatever the user does, undoing everything gives the first document back and redoing
/// everything the last one, with undo and redo in between as well.
void randomUseCanBeUndoneAndRedone(unsigned seed, int events, std::size_t& editCount) {
    SCOPED_TRACE(seed);
    HeadlessUi ui;
    EditorState state = fullEditor();
    const Document before = state.document;
    RandomUser user{.rng = std::mt19937(seed)};
    for (int i = 0; i < events; ++i) {
        const std::size_t applied = state.history.applied;
        user.act(ui, state);
        ui.frames(state);
        editCount += state.history.applied > applied;
        state.requests.clear();
        state.confirm.reset();
        if (i % 100 == 0)
            state.fileBrowser.reset(); // nobody left it for long
    }
    commitGesture(state);
    const Document after = state.document;
    const std::size_t finallyApplied = state.history.applied;
    for (const auto& [id, object] : after.objects)
        EXPECT_TRUE(isValid(object)) << objectName(object);

    undoAll(state);
    EXPECT_EQ(state.document, before);
    while (state.history.applied < finallyApplied)
        redo(state.history, state.document);
    EXPECT_EQ(state.document, after);
}

TEST(UndoLaw, RandomUseOfTheWholeInterfaceCanBeUndoneAndRedone) {
    std::size_t editCount = 0;
    for (unsigned seed = 1; seed <= 12; ++seed)
        randomUseCanBeUndoneAndRedone(seed, 2500, editCount);
    EXPECT_GT(editCount, 200u) << editCount; // else the random input does not reach the widgets
    RecordProperty("edits", int(editCount));
}

/// A minute: for ./check --journeys.
TEST(UndoLaw, DISABLED_TwentySoaksOfFiveThousandEventsCanBeUndoneAndRedone) {
    std::size_t editCount = 0;
    for (unsigned seed = 101; seed <= 120; ++seed)
        randomUseCanBeUndoneAndRedone(seed, 5000, editCount);
    RecordProperty("edits", int(editCount));
}

} // namespace
} // namespace limn::undo_law_test
