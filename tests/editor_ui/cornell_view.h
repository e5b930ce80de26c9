// SPDX-License-Identifier: MIT
#pragma once

#include "engine/files/project_file.h"
#include "tests/core/source_path.h"
#include "tests/editor_ui/headless.h"

#include <memory>
#include <utility>

namespace limn {

/// Cornell as it is after opening, seen by a camera as importers make them: it aims 1 m ahead, in
/// front of the box, which begins 5.2 m ahead.
struct CornellView {
    HeadlessUi ui;
    EditorState state = emptyEditor();

    /// With Cornell and the view `scale` times as large.
    explicit CornellView(float scale = 1) {
        const auto project = loadProject(sourcePath("projects/cornell/cornell.limn"));
        state.document = project->document;
        Assets assets = *project->assets;
        for (Mesh& mesh : assets.meshes)
            for (glm::vec3& position : mesh.positions)
                position *= scale;
        state.assets = std::make_shared<const Assets>(std::move(assets));
        auto scene = std::make_shared<const Scene>(flatten(state.document, state.assets));
        state.sceneBounds = scene->bounds;
        state.trace = std::make_shared<const TraceScene>(*scene);
        const glm::vec3 centre = scene->bounds.centre();
        state.view.camera = {.eye = centre + scale * glm::vec3(0.1f, 0.05f, 8),
                             .target = centre + scale * glm::vec3(0.1f, 0.05f, 7)};
        state.layout.bottomOpen = true; // so that the picture is wide
        ui.frames(state);
    }

    glm::vec2 at(float x, float y) const {
        return state.view.origin + state.view.size * glm::vec2(x, y);
    }

    void drag(glm::vec2 from, glm::vec2 to) {
        ui.mouse(from.x, from.y);
        ui.frames(state);
        ui.button(true, 2);
        ui.frames(state);
        ui.mouse(to.x, to.y);
        ui.frames(state);
        ui.button(false, 2);
        ui.frames(state);
    }
};

} // namespace limn
