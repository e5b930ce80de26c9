// SPDX-License-Identifier: MIT
#include "editor_ui/document/keep_lights.h"

namespace limn {

void keepLights(Scene& scene, const Document& document, const std::function<bool(ObjectId)>& keep) {
    auto light = scene.lights.begin();
    for (const auto& [id, object] : document.objects) {
        if (std::holds_alternative<Light>(object) && light != scene.lights.end())
            (light++)->enabled &= keep(id);
        if (std::holds_alternative<Sky>(object) && !keep(id))
            scene.sky = {};
    }
}

} // namespace limn
