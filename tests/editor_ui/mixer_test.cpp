// SPDX-License-Identifier: MIT
#include "editor_ui/document/document_edit.h"
#include "editor_ui/document/solo.h"
#include "editor_ui/panels/mixer_panel.h"
#include "tests/core/source_path.h"
#include "tests/editor_ui/headless.h"
#include "tests/editor_ui/small_session.h"

#include <imgui.h>

#include <gtest/gtest.h>

namespace limn::mixer_test {
namespace {

std::vector<bool> lightsOn(const Scene& scene) {
    std::vector<bool> on;
    for (const Light& light : scene.lights)
        on.push_back(light.enabled);
    return on;
}

struct SoloTest : testing::Test {
    EditorState state = fullEditor(); // Sun, Lamp, Torch, Panel

    SoloTest() {
        std::get<Sky>(state.document.objects.at(idNamed(state, "Sky"))).radiance = glm::vec3(2);
        std::get<Light>(state.document.objects.at(idNamed(state, "Panel"))).enabled = false;
    }

    Scene soloed(const std::set<ObjectId>& solo) const {
        Scene scene = flatten(state.document, state.assets);
        applySolo(scene, state.document, solo);
        return scene;
    }
};

TEST_F(SoloTest, WithoutAnyEverythingStaysOn) {
    const Scene scene = soloed({});
    EXPECT_EQ(lightsOn(scene), (std::vector{true, true, true, false}));
    EXPECT_EQ(scene.sky.radiance, glm::vec3(2));
}

TEST_F(SoloTest, ALightAloneIsLeftAndALightThatIsOffStaysOff) {
    const Scene scene = soloed({idNamed(state, "Torch"), idNamed(state, "Panel")});
    EXPECT_EQ(lightsOn(scene), (std::vector{false, false, true, false}));
    EXPECT_EQ(scene.sky.radiance, glm::vec3(0));
}

TEST_F(SoloTest, TheSkyAloneIsLeft) {
    const Scene scene = soloed({idNamed(state, "Sky")});
    EXPECT_EQ(lightsOn(scene), (std::vector{false, false, false, false}));
    EXPECT_EQ(scene.sky.radiance, glm::vec3(2));
}

TEST_F(SoloTest, OfALightThatWasDeletedNothingIsLeftOut) {
    const Scene scene = soloed({9999});
    EXPECT_EQ(lightsOn(scene), (std::vector{true, true, true, false}));
}

TEST(SoloSession, ChangesWhatIsShownAndNeitherTheDocumentNorItsHistory) {
    Session session({.projectsFolder = sourcePath("projects"), .wake = [] {}, .bakeOnOpen = false});
    session.open(sourcePath("projects/cornell/cornell.limn"));
    ASSERT_TRUE(runUntil(session, [&] { return session.idle() && session.state.trace; }));
    const ObjectId first = addLight(session.state, Light{.name = "First"});
    addLight(session.state, Light{.name = "Second"});
    session.update();
    const Document before = session.state.document;
    const std::size_t edits = session.state.history.edits.size();
    session.state.solo = {first};
    session.update();
    EXPECT_EQ(lightsOn(*session.scene()), (std::vector{true, false}));
    EXPECT_EQ(session.state.document, before);
    EXPECT_EQ(session.state.history.edits.size(), edits);
    EXPECT_FALSE(session.state.unlit);
    session.state.solo.clear();
    session.update();
    EXPECT_EQ(lightsOn(*session.scene()), (std::vector{true, true}));
}

/// The table alone in a window.
struct MixerTest : testing::Test {
    HeadlessUi ui{960, 220};
    EditorState state = fullEditor();

    void frames() {
        do {
            feedInput(ui.input);
            ImGui::NewFrame();
            ImGui::SetNextWindowPos({0, 0});
            ImGui::SetNextWindowSize({960, 220});
            ImGui::Begin("mixer");
            mixerPanel(state);
            ImGui::End();
            ImGui::Render();
            if (!ImGui::IsAnyItemActive())
                commitGesture(state);
        } while (!ui.input.events.empty());
    }
};

TEST_F(MixerTest, ItsWidgetsEditTheLightOfTheirRowInOneStepEach) {
    frames();
    const Document start = state.document;
    std::set<std::string> labels;
    std::set<ObjectId> soloed, selected, changed;
    for (float y = 20; y < 200; y += 7)
        for (float x = 8; x < 590; x += 11) {
            ui.mouse(x, y);
            ui.button(true);
            frames();
            ui.button(false);
            frames();
            frames();
            soloed.insert(state.solo.begin(), state.solo.end());
            selected.insert(state.selection.begin(), state.selection.end());
            ASSERT_LE(state.history.edits.size(), 1u);
            for (const Edit& edit : state.history.edits) {
                labels.insert(edit.label);
                changed.insert(edit.changes.at(0).id);
            }
            if (ImGui::IsPopupOpen(nullptr,
                                   ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel)) {
                ui.mouse(5, 215); // beside it: closes the picker
                ui.button(true);
                ui.button(false);
                frames();
            }
            state.document = start;
            state.history = {};
            state.solo.clear();
            state.selection.clear();
        }
    const std::set<ObjectId> lights{idNamed(state, "Sun"), idNamed(state, "Lamp"),
                                    idNamed(state, "Torch"), idNamed(state, "Panel")};
    std::set<ObjectId> all = lights;
    all.insert(idNamed(state, "Sky"));
    EXPECT_EQ(soloed, all);
    EXPECT_EQ(selected, all);
    EXPECT_EQ(changed, lights);
    EXPECT_TRUE(labels.contains("Light on or off"));
    EXPECT_TRUE(labels.contains("Light strength"));
}

} // namespace
} // namespace limn::mixer_test
