// SPDX-License-Identifier: MIT
#include "editor_ui/view/picking.h"

#include <algorithm>

#include <glm/geometric.hpp>

namespace limn {

static constexpr float kIconPixels = 12;

static ObjectId iconAt(const EditorState& state, const Picture& picture, glm::vec2 mouse) {
    ObjectId found = 0;
    float best = kIconPixels;
    for (const auto& [id, object] : state.document.objects) {
        const auto* light = std::get_if<Light>(&object);
        const auto pixel = light ? toPixel(picture, light->position) : std::nullopt;
        const float d = pixel ? glm::length(*pixel - mouse) : kIconPixels;
        if (d < best)
            best = d, found = id;
    }
    return found;
}

ObjectId objectAt(const EditorState& state, glm::vec2 mouse) {
    const Picture picture = state.view.picture();
    if (state.view.showLights)
        if (const ObjectId id = iconAt(state, picture, mouse))
            return id;
    if (!state.trace)
        return 0;
    const Hit hit = state.trace->closestHit({picture.camera.eye, pixelDirection(picture, mouse)});
    if (!hit)
        return 0;
    const ObjectId node = state.trace->scene().instances[hit.instance].node;
    return state.document.objects.contains(node) ? node : 0;
}

void pick(EditorState& state, glm::vec2 mouse, bool extend) {
    const ObjectId id = objectAt(state, mouse);
    const auto at = std::ranges::find(state.selection, id);
    if (!extend)
        state.selection = id ? std::vector{id} : std::vector<ObjectId>{};
    else if (at != state.selection.end())
        state.selection.erase(at);
    else if (id)
        state.selection.push_back(id);
}

} // namespace limn
