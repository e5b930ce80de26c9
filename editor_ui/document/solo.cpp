// SPDX-License-Identifier: MIT
#include "editor_ui/document/solo.h"

#include <algorithm>

namespace limn {

static bool canSolo(const Object& object) {
    return std::holds_alternative<Light>(object) || std::holds_alternative<Sky>(object);
}

void applySolo(Scene& scene, const Document& document, const std::set<ObjectId>& solo) {
    const bool any = std::ranges::any_of(document.objects, [&](const auto& entry) {
        return canSolo(entry.second) && solo.contains(entry.first);
    });
    if (!any)
        return;
    auto light = scene.lights.begin();
    bool sky = false;
    for (const auto& [id, object] : document.objects) {
        if (std::holds_alternative<Light>(object) && light != scene.lights.end())
            (light++)->enabled &= solo.contains(id);
        sky |= std::holds_alternative<Sky>(object) && solo.contains(id);
    }
    if (!sky)
        scene.sky = {};
}

} // namespace limn
