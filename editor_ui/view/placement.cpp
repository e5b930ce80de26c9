// SPDX-License-Identifier: MIT
#include "editor_ui/view/placement.h"

#include "editor_ui/document/document_edit.h"
#include "editor_ui/editor_state.h"
#include "editor_ui/view/light_placement.h"
#include "editor_ui/view/shape_placement.h"

namespace limn {

/// Shapes are assets, which the session adds.
static void requestShape(EditorState& state, Shape shape, const Transform& place) {
    Request request{Request::Kind::AddFile, shapePath(shape)};
    request.place = place;
    state.requests.push_back(std::move(request));
}

void placeAtPixel(EditorState& state, Placeable what, glm::vec2 pixel) {
    if (const LightKind* light = std::get_if<LightKind>(&what))
        addLight(state, lightAtPixel(state, *light, pixel));
    else
        requestShape(state, std::get<Shape>(what), shapeAtPixel(state, pixel));
}

void placeBeforeCamera(EditorState& state, Placeable what) {
    if (const LightKind* light = std::get_if<LightKind>(&what))
        addLight(state, lightBeforeCamera(state, *light));
    else
        requestShape(state, std::get<Shape>(what), shapeBeforeCamera(state));
}

} // namespace limn
