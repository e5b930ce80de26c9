// SPDX-License-Identifier: MIT
#include "editor_ui/panels/overlay_panel.h"

#include "editor_ui/panels/action.h"
#include "tests/editor_ui/headless.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

namespace limn {
namespace {

std::shared_ptr<const Bake> smallBake(const TraceScene& trace) {
    Result<Bake> made = bake(trace);
    EXPECT_TRUE(made) << (made ? "" : made.error().message);
    return made ? std::make_shared<const Bake>(std::move(*made)) : nullptr;
}

/// fullEditor() with a bake of a moment, looking at its two triangles.
struct BakedEditor {
    EditorState state = fullEditor();
    std::shared_ptr<Scene> scene;

    BakedEditor() {
        scene = std::make_shared<Scene>(flatten(state.document, state.assets));
        scene->bake.surfels = 100;
        scene->bake.links = 8;
        scene->bake.rays = 32;
        scene->bake.lightmapCaches = 60;
        scene->bake.grid = {2, 2, 2};
        rebake();
    }
    void rebake() {
        const auto trace = std::make_shared<const TraceScene>(*scene);
        state.trace = trace;
        setOverlayBake(state.overlay, smallBake(*trace), scene);
    }
};

TEST(OverlayPanel, EveryOverlayIsAnActionUnderItsName) {
    EditorState state = emptyEditor();
    std::size_t found = 0;
    for (const Action& action : actions()) {
        if (action.menu != Menu::Overlay)
            continue;
        runAction(state, action);
        EXPECT_EQ(std::size_t(state.overlay.options.kind), found);
        EXPECT_TRUE(action.checked(state));
        EXPECT_STREQ(action.label, kOverlays[found++].label);
    }
    EXPECT_EQ(found, kOverlays.size());
}

TEST(OverlayPanel, EveryOverlayIsDrawnWithAndWithoutABakeAndForEveryCache) {
    HeadlessUi ui;
    EditorState none = fullEditor();
    BakedEditor baked;
    for (std::size_t k = 0; k < kOverlays.size(); ++k) {
        none.overlay.options.kind = baked.state.overlay.options.kind = Overlay(k);
        ui.frames(none);
        ui.frames(baked.state);
    }
    baked.state.overlay.options.kind = Overlay::Links;
    for (std::uint32_t c = 0; c < baked.state.overlay.bake->caches.size(); ++c) {
        pickCache(baked.state.overlay, c);
        ASSERT_TRUE(baked.state.overlay.cut);
        EXPECT_EQ(baked.state.overlay.cut->cache, c);
        ui.frames(baked.state);
    }
    pickCache(baked.state.overlay, 1u << 30);
    EXPECT_FALSE(baked.state.overlay.cut);
    ui.frames(baked.state);
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
    EXPECT_EQ(state.overlay.options.cache, ~0u) << "no link cut is shown";
    state.selection.clear();
    state.overlay.options.kind = Overlay::Links;
    ui.frames(state);
    clickAt(place);
    ASSERT_EQ(state.selection.size(), 1u);
    EXPECT_TRUE(state.selection[0] == node || state.selection[0] == idNamed(state, "Left"));
    ASSERT_TRUE(state.overlay.cut);
    const Caches& caches = state.overlay.bake->caches;
    const std::uint32_t cache = state.overlay.cut->cache;
    EXPECT_LT(cache, caches.lightmapCount);
    EXPECT_LT(glm::distance(caches.position[cache], place), 1);
    clickAt({0, 30, 0}); // nothing there: the cache stays
    EXPECT_EQ(state.overlay.options.cache, cache);
}

TEST(OverlayPanel, AnotherBakeKeepsThePlaceThatWasPicked) {
    BakedEditor baked;
    OverlayState& overlay = baked.state.overlay;
    pickCache(overlay, overlay.bake->caches.lightmapCount / 2);
    const glm::vec3 place = overlay.bake->caches.position[overlay.options.cache];
    baked.scene->bake.lightmapCaches = 400;
    baked.rebake();
    ASSERT_TRUE(overlay.cut);
    const Caches& caches = overlay.bake->caches;
    EXPECT_GT(caches.lightmapCount, 200u);
    for (std::uint32_t c = 0; c < caches.lightmapCount; ++c)
        EXPECT_LE(glm::distance(caches.position[overlay.options.cache], place),
                  glm::distance(caches.position[c], place));
    setOverlayBake(overlay, nullptr, nullptr);
    EXPECT_EQ(overlay.options.cache, ~0u);
    EXPECT_FALSE(overlay.cut);
}

} // namespace
} // namespace limn
