// SPDX-License-Identifier: MIT
#include "editor_ui/document/first_light.h"

#include "editor_ui/document/document_edit.h"
#include "tests/core/temporary_folder.h"
#include "tests/editor_ui/headless.h"
#include "tests/editor_ui/small_session.h"

#include <cstdlib>

#include <gtest/gtest.h>
#include <imgui_internal.h>

namespace limn::first_light_test {
namespace {

/// Two boxes, a camera and a black sky.
EditorState darkEditor() {
    EditorState state = fullEditor();
    std::erase_if(state.document.objects,
                  [](const auto& entry) { return std::holds_alternative<Light>(entry.second); });
    return state;
}

bool isDark(const EditorState& state) {
    return nothingShines(flatten(state.document, state.assets));
}

TEST(FirstLight, AnyLampSkyOrGlowingSurfaceThatIsShownEndsTheDark) {
    const EditorState dark = darkEditor();
    EXPECT_TRUE(isDark(dark)) << "the glowing material is on no surface";
    EXPECT_FALSE(isDark(fullEditor()));
    const auto with = [&](const Object& object) {
        EditorState state = dark;
        addObject(state.document, object);
        return isDark(state);
    };
    EXPECT_FALSE(with(Light{}));
    EXPECT_TRUE(with(Light{.enabled = false}));
    EXPECT_TRUE(with(Light{.strength = 0}));
    const auto withSky = [&](const Sky& sky) {
        EditorState state = dark;
        std::get<Sky>(state.document.objects.at(idNamed(state, "Sky"))) = sky;
        return isDark(state);
    };
    EXPECT_FALSE(withSky({.radiance = {0, 0, 0.1f}}));
    EXPECT_FALSE(withSky({.kind = SkyKind::Gradient, .ground = {1, 0, 0}}));
    EXPECT_TRUE(withSky({.kind = SkyKind::Color, .ground = {1, 0, 0}}));
    EditorState glowing = dark;
    std::get<Material>(glowing.document.objects.at(idNamed(glowing, "Stone"))).emission = {1, 1, 1};
    EXPECT_FALSE(isDark(glowing));
    EXPECT_FALSE(isDark(emptyEditor())) << "there is nothing to light";
}

TEST(FirstLight, SunAndSkyAreOneEditWithAndWithoutASkyToChange) {
    for (const bool hasSky : {true, false}) {
        EditorState state = darkEditor();
        if (!hasSky)
            state.document.objects.erase(idNamed(state, "Sky"));
        const Document before = state.document;
        addSunAndSky(state);
        EXPECT_FALSE(isDark(state));
        EXPECT_EQ(state.history.applied, 1U);
        EXPECT_NE(singleton<Sky>(state.document).radiance, glm::vec3(0));
        const Document after = state.document;
        ASSERT_TRUE(undoEdit(state));
        EXPECT_EQ(state.document, before);
        ASSERT_TRUE(redoEdit(state));
        EXPECT_EQ(state.document, after);
    }
    EditorState blue = darkEditor();
    const Sky sky{.kind = SkyKind::Gradient, .horizon = {0, 0, 1}};
    std::get<Sky>(blue.document.objects.at(idNamed(blue, "Sky"))) = sky;
    addSunAndSky(blue);
    EXPECT_EQ(singleton<Sky>(blue.document), sky) << "the user's own";
}

TEST(FirstLight, TheOfferInThePictureAlsoMakesTheExposureFollow) {
    HeadlessUi ui;
    EditorState state = darkEditor();
    state.unlit = true;
    ui.frames(state);
    // The button is the lower half of the offer, above the lower edge of the picture.
    const glm::vec2 foot = state.view.origin + glm::vec2(0.5f, 1) * state.view.size;
    for (float up = 4; up < 80 && state.history.applied == 0; up += 6) {
        ui.mouse(foot.x, foot.y - up);
        ui.frames(state);
        ui.button(true);
        ui.frames(state);
        ui.button(false);
        ui.frames(state);
    }
    EXPECT_EQ(state.history.applied, 1U);
    EXPECT_FALSE(isDark(state));
    EXPECT_TRUE(state.view.autoExposure);
}

TEST(FirstLight, TheFirstPictureOfADarkImportOffersThem) {
    const TemporaryFolder folder;
    setenv("XDG_CONFIG_HOME", folder.path.c_str(), 1);
    Document dark = smallDocument();
    std::erase_if(dark.objects,
                  [](const auto& entry) { return std::holds_alternative<Light>(entry.second); });
    for (auto& [id, object] : dark.objects)
        if (auto* material = std::get_if<Material>(&object))
            material->emission = glm::vec3(0);
    ASSERT_TRUE(saveProject(folder.file("dark.limn"), dark));
    Session session({.projectsFolder = "", .wake = [] {}, .bakeOnOpen = false});
    session.open(folder.file("dark.limn"));
    ASSERT_TRUE(runUntil(session, [&] { return session.idle(); }));
    ASSERT_TRUE(session.state.unlit);
    HeadlessUi ui;
    for (int i = 0; i < 3; ++i)
        ui.frames(session.state);
    ImGuiWindow* hint = ImGui::FindWindowByName("no light");
    ASSERT_TRUE(hint && hint->Active);
    ui.mouse(hint->Rect().Min.x + 40, hint->Rect().Max.y - 16); // the button at its foot
    ui.frames(session.state);
    ui.button(true);
    ui.button(false);
    ui.frames(session.state);
    session.update();
    EXPECT_EQ(session.state.history.applied, 1U);
    EXPECT_FALSE(session.state.unlit);
    ui.frames(session.state);
    EXPECT_FALSE(hint->Active);
}

} // namespace
} // namespace limn::first_light_test
