// SPDX-License-Identifier: MIT
#include "editor_ui/view/shape_placement.h"

#include "editor_ui/editor_state.h"
#include "editor_ui/view/light_placement.h"
#include "editor_ui/view/picking.h"
#include "editor_ui/view/pivot.h"

#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace limn {

/// A rotation that takes +Y to a unit vector.
static glm::quat uprightTo(glm::vec3 normal) {
    if (normal.y < -0.9999f)
        return {0, 1, 0, 0}; // half a turn about X; every axis across Y would do
    return glm::normalize(glm::quat(1 + normal.y, glm::cross(glm::vec3(0, 1, 0), normal)));
}

Transform shapeAtPixel(const EditorState& state, glm::vec2 pixel) {
    Transform place;
    glm::vec3 position;
    if (const Hit hit = hitUnder(state, pixel)) {
        position = hit.position;
        place.rotation = uprightTo(hit.frontFace ? hit.geometricNormal : -hit.geometricNormal);
    } else {
        position = pivotUnder(state, pixel);
    }
    place.translation = position;
    const float size = roundedToTwoDigits(glm::distance(position, state.view.camera.eye) / 6);
    place.scale = glm::vec3(std::max(size, 1e-3f));
    return place;
}

Transform shapeBeforeCamera(const EditorState& state) {
    return shapeAtPixel(state, state.view.origin + state.view.size * 0.5f);
}

} // namespace limn
