// SPDX-License-Identifier: MIT
#include "editor_ui/document/document_edit.h"
#include "editor_ui/document/object_rules.h"
#include "editor_ui/panels/action.h"
#include "tests/editor_ui/headless.h"

#include <imgui.h>

#include <set>

#include <gtest/gtest.h>

namespace limn::panels_test {
namespace {

void drawWithEverySelection(HeadlessUi& ui, EditorState& state) {
    state.selection.clear();
    ui.frames(state);
    for (const auto& [id, object] : std::map<ObjectId, Object>(state.document.objects)) {
        state.selection = {id};
        ui.frames(state);
        ui.frames(state);
    }
}

TEST(Panels, AnEmptySceneIsDrawn) {
    HeadlessUi ui;
    EditorState state = emptyEditor();
    drawWithEverySelection(ui, state);
    EXPECT_TRUE(state.history.edits.empty());
}

TEST(Panels, DrawingNeverChangesTheDocument) {
    HeadlessUi ui;
    EditorState state = fullEditor();
    const Document before = state.document;
    drawWithEverySelection(ui, state);
    EXPECT_EQ(state.document, before);
    EXPECT_TRUE(state.history.edits.empty());
}

TEST(Panels, ALightWithAProfileIsDrawnAndStaysAsItIs) {
    HeadlessUi ui(1280, 1600);
    EditorState state = fullEditor();
    for (const char* name : {"Lamp", "Torch"})
        for (const std::uint32_t columns : {1U, 4U}) {
            LightProfile profile{.name = std::string(200, 'x'), .rows = 3, .columns = columns};
            profile.share.assign(3 * columns, 0.25f);
            setLightProfile(state, idNamed(state, name), profile);
            const Document before = state.document;
            drawWithEverySelection(ui, state);
            EXPECT_EQ(state.document, before);
        }
}

TEST(Panels, DrawingAFarSceneNeverChangesItEither) {
    HeadlessUi ui;
    EditorState state = fullEditor();
    state.document.origin = {1e6 + 32, -4e9, 48};
    const Document before = state.document;
    drawWithEverySelection(ui, state);
    EXPECT_EQ(state.document, before);
    EXPECT_TRUE(state.history.edits.empty());
}

TEST(Panels, NamesOfTwoHundredCharactersAndNoneAtAllAreDrawn) {
    HeadlessUi ui;
    EditorState state = fullEditor();
    std::string umlauts;
    for (int i = 0; i < 100; ++i)
        umlauts += "\u00fc";
    int i = 0;
    for (auto& [id, object] : state.document.objects)
        if (std::string* name = nameOf(object))
            *name = i++ % 3 == 0 ? std::string(200, 'W') : i % 3 == 1 ? umlauts : "";
    state.projectPath = "/" + std::string(200, 'p') + "/" + std::string(200, 'q') + ".limn";
    state.loading = std::string(300, 'x');
    state.log.assign(500, {LogLine::Level::Warning, std::string(400, 'y')});
    drawWithEverySelection(ui, state);
    state.loading.clear();
    drawWithEverySelection(ui, state);
}

TEST(Panels, EverySizeOfWindowFromTinyToLargeIsDrawn) {
    for (const auto& [w, h] :
         {std::pair{1.f, 1.f}, {80.f, 60.f}, {320.f, 200.f}, {1280.f, 800.f}, {3840.f, 2160.f}}) {
        HeadlessUi ui(w, h);
        EditorState state = fullEditor();
        drawWithEverySelection(ui, state);
        EXPECT_GE(state.view.size.x, 1);
        EXPECT_GE(state.view.size.y, 1);
    }
}

TEST(Panels, ARunningBakeOffersCancel) {
    HeadlessUi ui;
    EditorState state = fullEditor();
    state.bake.running = true;
    state.bake.stage = "trace";
    ui.frames(state);
    runAction(state, actionById("bake.cancel"));
    ASSERT_EQ(state.requests.size(), 1u);
    EXPECT_EQ(state.requests[0].kind, Request::Kind::CancelBake);
}

TEST(Panels, TheGizmosArrowMovesALightInOneStepAndUndoBringsItBack) {
    HeadlessUi ui;
    EditorState state = fullEditor();
    const ObjectId id = idNamed(state, "Lamp");
    state.selection = {id};
    const Document before = state.document;
    ui.frames(state);
    const glm::vec3 origin = std::get<Light>(before.objects.at(id)).position;
    const Picture picture = state.view.picture();
    const float length = arrowLength(picture, origin);
    const auto from = toPixel(picture, arrowTip(Handle::X, {origin}, 0.8f * length));
    const auto to = toPixel(picture, arrowTip(Handle::X, {origin}, 1.8f * length));
    ui.mouse(from->x, from->y);
    ui.frames(state);
    ui.button(true);
    ui.frames(state);
    for (int i = 1; i <= 8; ++i) {
        const glm::vec2 p = *from + (*to - *from) * (float(i) / 8);
        ui.mouse(p.x, p.y);
        ui.frames(state);
    }
    ui.button(false);
    ui.frames(state);
    ui.frames(state);
    const glm::vec3 moved = std::get<Light>(state.document.objects.at(id)).position - origin;
    EXPECT_NEAR(moved.x, length, 1e-3f * length);
    EXPECT_EQ(moved.y, 0);
    EXPECT_EQ(moved.z, 0);
    ASSERT_EQ(state.history.edits.size(), 1u);
    undoEdit(state);
    EXPECT_EQ(state.document, before);
    EXPECT_EQ(state.selection, std::vector{id});
}

TEST(Panels, EveryRowOfTheListCanBeClickedRightAfterAnother) {
    HeadlessUi ui;
    EditorState state = fullEditor();
    ui.frames(state);
    std::set<ObjectId> selected;
    const float line = ImGui::GetTextLineHeightWithSpacing();
    for (int row = 0; row < 19; ++row) {
        ui.mouse(80, 66 + line * float(row));
        ui.button(true);
        ui.button(false);
        ui.frames(state);
        selected.insert(activeId(state));
        state.outliner.closed.clear(); // by clicks on headings
    }
    EXPECT_EQ(selected.size(), state.document.objects.size());
}

TEST(Panels, AClickOnALightsIconSelectsItAndADragInThePictureDoesNot) {
    HeadlessUi ui;
    EditorState state = fullEditor();
    ui.frames(state);
    const auto pixel =
        toPixel(state.view.picture(),
                std::get<Light>(state.document.objects.at(idNamed(state, "Torch"))).position);
    ui.mouse(pixel->x, pixel->y);
    ui.button(true);
    ui.button(false);
    ui.frames(state);
    EXPECT_EQ(activeId(state), idNamed(state, "Torch"));
    ui.mouse(state.view.origin.x + 5, state.view.origin.y + 5);
    ui.button(true);
    ui.mouse(state.view.origin.x + 50, state.view.origin.y + 5);
    ui.button(false);
    ui.frames(state);
    EXPECT_EQ(activeId(state), idNamed(state, "Torch"));
}

} // namespace
} // namespace limn::panels_test
