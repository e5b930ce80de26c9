// SPDX-License-Identifier: MIT
#include "editor_ui/view/pivot.h"

#include "editor_ui/document/selection.h"
#include "editor_ui/editor_state.h"
#include "editor_ui/view/camera_control.h"
#include "editor_ui/view/picking.h"

#include <glm/geometric.hpp>

namespace limn {

static glm::vec2 middleOf(const Picture& picture) {
    return picture.origin + picture.size * 0.5f;
}

/// Distance of a point along the optical axis, negative behind the eye [m].
static float depthOf(const Camera& camera, glm::vec3 point) {
    return glm::dot(point - camera.eye, forward(camera));
}

/// Depth of the selection, the middle of the picture or the scene's middle: the first one that is
/// in front of the eye. The target's depth if none is [m].
static float depthWithoutSurface(const EditorState& state, const Picture& picture) {
    const Camera& camera = picture.camera;
    if (const auto selected = selectionOrigin(state))
        if (const float depth = depthOf(camera, *selected); depth > 0)
            return depth;
    if (const auto middle = surfaceUnder(state, middleOf(picture)))
        return depthOf(camera, *middle);
    if (state.trace)
        if (const float depth = depthOf(camera, state.sceneBounds.centre()); depth > 0)
            return depth;
    return glm::length(camera.target - camera.eye);
}

std::optional<glm::vec3> surfaceUnder(const EditorState& state, glm::vec2 pixel) {
    const Hit hit = hitUnder(state, pixel);
    return hit ? std::optional(hit.position) : std::nullopt;
}

glm::vec3 pivotUnder(const EditorState& state, glm::vec2 pixel) {
    if (const auto surface = surfaceUnder(state, pixel))
        return *surface;
    const Picture picture = state.view.picture();
    const glm::vec3 direction = pixelDirection(picture, pixel);
    const float cosine = glm::dot(direction, forward(picture.camera));
    const float depth = depthWithoutSurface(state, picture);
    return picture.camera.eye + direction * (cosine > 0 ? depth / cosine : depth);
}

void aimAtMiddle(EditorState& state) {
    setTargetDepth(state.view.camera, pivotUnder(state, middleOf(state.view.picture())));
}

} // namespace limn
