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

Hit hitUnder(const EditorState& state, glm::vec2 pixel) {
    if (!state.trace)
        return {};
    const Picture picture = state.view.picture();
    return state.trace->closestHit({picture.camera.eye, pixelDirection(picture, pixel)},
                                   TraceMask::Seen);
}

std::optional<PickedSurface> surfaceAt(const EditorState& state, glm::vec2 mouse) {
    const Hit hit = hitUnder(state, mouse);
    if (!hit)
        return std::nullopt;
    const Instance& instance = state.trace->scene().instances[hit.instance];
    if (!state.document.objects.contains(instance.node))
        return std::nullopt;
    return PickedSurface{instance.node, instance.mesh, hit.position};
}

void pick(EditorState& state, glm::vec2 mouse, bool extend) {
    const ObjectId icon = state.view.showLights ? iconAt(state, state.view.picture(), mouse) : 0;
    state.view.picked = icon ? std::nullopt : surfaceAt(state, mouse);
    const ObjectId id = state.view.picked ? state.view.picked->node : icon;
    const auto found = std::ranges::find(state.selection, id);
    if (!extend)
        state.selection = id ? std::vector{id} : std::vector<ObjectId>{};
    else if (found != state.selection.end())
        state.selection.erase(found);
    else if (id)
        state.selection.push_back(id);
}

} // namespace limn
