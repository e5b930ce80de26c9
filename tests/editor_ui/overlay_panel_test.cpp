// SPDX-License-Identifier: MIT
#include "editor_ui/panels/overlay_panel.h"

#include "editor_ui/panels/action.h"
#include "editor_ui/view/picking.h"
#include "engine/techniques/illuminance/baked_illuminance.h"
#include "engine/techniques/technique_table.h"
#include "tests/editor_ui/baked_editor.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

namespace limn::overlay_panel_test {
namespace {

/// The overlay of that name.
const OverlayKind* kindNamed(const std::string& name) {
    for (const OverlayKind* kind : overlayKinds())
        if (kind->name == name)
            return kind;
    return nullptr;
}

/// The caches of the bake that an overlay shows, which its picks number.
const Caches& cachesOf(const OverlayState& overlay) {
    return static_cast<const BakedIlluminance&>(*overlay.source).bake()->caches;
}

TEST(OverlayPanel, EveryOverlayIsAnActionUnderItsName) {
    EditorState state = emptyEditor();
    std::vector<const OverlayKind*> kinds = overlayKinds();
    kinds.insert(kinds.begin(), nullptr);
    std::size_t found = 0;
    for (const Action& action : actions()) {
        if (action.menu != Menu::Overlay)
            continue;
        runAction(state, action);
        ASSERT_LT(found, kinds.size());
        const OverlayKind* kind = kinds[found++];
        EXPECT_EQ(state.overlay.options.kind, kind);
        EXPECT_TRUE(action.checked(state));
        EXPECT_STREQ(action.label, kind ? kind->label : "No overlay");
    }
    EXPECT_EQ(found, kinds.size());
    EXPECT_TRUE(actionById("overlay.surfel_normals").run) << "ids have no hyphens";
}

TEST(OverlayPanel, NoTwoOverlaysHaveTheSameLabel) {
    std::set<std::string> labels{kNoOverlay.label};
    for (const OverlayKind* kind : overlayKinds())
        EXPECT_TRUE(labels.insert(kind->label).second) << kind->label;
}

TEST(OverlayPanel, EveryOverlayIsDrawnWithAndWithoutABakeAndForEveryCache) {
    HeadlessUi ui;
    EditorState none = fullEditor();
    BakedEditor baked;
    for (const OverlayKind* kind : overlayKinds()) {
        none.overlay.options.kind = baked.state.overlay.options.kind = kind;
        ui.frames(none);
        ui.frames(baked.state);
    }
    baked.state.overlay.options.kind = kindNamed("links");
    for (std::uint32_t c = 0; c < baked.state.overlay.source->pickCount(); ++c) {
        pickNumber(baked.state.overlay, c);
        EXPECT_FALSE(baked.state.overlay.picked.empty());
        EXPECT_EQ(baked.state.overlay.options.pick, c);
        ui.frames(baked.state);
    }
    pickNumber(baked.state.overlay, 1u << 30);
    EXPECT_TRUE(baked.state.overlay.picked.empty());
    ui.frames(baked.state);
}

TEST(OverlayPanel, DependenciesFollowTheSelection) {
    HeadlessUi ui;
    BakedEditor baked;
    EditorState& state = baked.state;
    state.overlay.options.kind = kindNamed("dependencies");
    ui.frames(state);
    EXPECT_EQ(state.overlay.options.pick, ~0u) << "nothing is selected";
    std::vector<std::uint32_t> picks;
    for (const char* name : {"Left", "Right"}) {
        state.selection = {idNamed(state, name)};
        ui.frames(state);
        picks.push_back(state.overlay.options.pick);
        ASSERT_LT(picks.back(), cachesOf(state.overlay).lightmapCount);
    }
    EXPECT_NE(picks[0], picks[1]);
    pickNumber(state.overlay, 0); // by hand
    ui.frames(state);
    EXPECT_EQ(state.overlay.options.pick, 0U) << "the selection is still the same";
    state.selection = {idNamed(state, "Left")};
    state.overlay.options.kind = kindNamed("links");
    ui.frames(state);
    EXPECT_EQ(state.overlay.options.pick, 0U) << "a link cut is of a cache, not of an object";
}

TEST(OverlayPanel, NumbersStandBesideTheMouseWhereItIsOnASurface) {
    HeadlessUi ui;
    BakedEditor baked;
    EditorState& state = baked.state;
    state.view.showLights = false;
    ui.frames(state);
    const auto moveTo = [&](glm::vec2 pixel) {
        ui.mouse(pixel.x, pixel.y);
        ui.frames(state);
    };
    const glm::vec2 surface = *toPixel(state.view.picture(), {0.3f, 0.6f, 0});
    const glm::vec2 nothing = state.view.origin + glm::vec2(0.02f, 0.5f) * state.view.size;
    ASSERT_FALSE(hitUnder(state, nothing));
    for (const OverlayKind& kind : techniques()[0]->overlays) {
        state.overlay.options.kind = &kind;
        moveTo(surface);
        EXPECT_FALSE(state.overlay.hover.text.empty()) << kind.name;
        moveTo(nothing);
        EXPECT_TRUE(state.overlay.hover.text.empty()) << kind.name << ": nothing is there";
    }
}

TEST(OverlayPanel, AClickPicksTheCacheBeneathItAndSelectsAsEver) {
    HeadlessUi ui;
    BakedEditor baked;
    EditorState& state = baked.state;
    state.view.showLights = false;
    const ObjectId node = idNamed(state, "Right");
    ui.frames(state);
    const auto clickAt = [&](glm::vec3 world) {
        const auto at = toPixel(state.view.picture(), world);
        ui.mouse(at->x, at->y);
        ui.frames(state);
        ui.button(true);
        ui.frames(state);
        ui.button(false);
        ui.frames(state);
    };
    const glm::vec3 place(0.3f, 0.6f, 0); // on both, which lie in the same plane
    clickAt(place);
    EXPECT_EQ(state.overlay.options.pick, ~0u) << "no link cut is shown";
    state.selection.clear();
    state.overlay.options.kind = kindNamed("links");
    ui.frames(state);
    clickAt(place);
    ASSERT_EQ(state.selection.size(), 1u);
    EXPECT_TRUE(state.selection[0] == node || state.selection[0] == idNamed(state, "Left"));
    ASSERT_FALSE(state.overlay.picked.empty());
    const Caches& caches = cachesOf(state.overlay);
    const std::uint32_t cache = state.overlay.options.pick;
    EXPECT_LT(cache, caches.lightmapCount);
    EXPECT_LT(glm::distance(caches.position[cache], place), 1);
    clickAt({0, 30, 0}); // nothing there: the cache stays
    EXPECT_EQ(state.overlay.options.pick, cache);
}

TEST(OverlayPanel, AnotherBakeKeepsThePlaceThatWasPicked) {
    BakedEditor baked;
    OverlayState& overlay = baked.state.overlay;
    pickNumber(overlay, cachesOf(overlay).lightmapCount / 2);
    const glm::vec3 place = cachesOf(overlay).position[overlay.options.pick];
    baked.scene->bake.lightmapCaches = 400;
    baked.rebake();
    ASSERT_FALSE(overlay.picked.empty());
    const Caches& caches = cachesOf(overlay);
    EXPECT_GT(caches.lightmapCount, 200u);
    for (std::uint32_t c = 0; c < caches.lightmapCount; ++c)
        EXPECT_LE(glm::distance(caches.position[overlay.options.pick], place),
                  glm::distance(caches.position[c], place));
    setOverlaySource(overlay, nullptr, nullptr);
    EXPECT_EQ(overlay.options.pick, ~0u);
    EXPECT_TRUE(overlay.picked.empty());
}

} // namespace
} // namespace limn::overlay_panel_test
