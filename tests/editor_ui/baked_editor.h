// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/panels/overlay_panel.h"
#include "engine/techniques/technique_table.h"
#include "tests/editor_ui/headless.h"

#include <memory>

#include <gtest/gtest.h>

namespace limn {

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
        const auto made = precomputingTechnique({}).precomputation->prepare(*trace, {}, {});
        EXPECT_TRUE(made) << (made ? "" : made.error().message);
        setOverlaySource(state.overlay, made ? *made : nullptr, scene);
    }
};

} // namespace limn
