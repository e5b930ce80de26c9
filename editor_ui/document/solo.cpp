// SPDX-License-Identifier: MIT
#include "editor_ui/document/solo.h"

#include "editor_ui/document/keep_lights.h"

#include <algorithm>

namespace limn {

static bool canSolo(const Object& object) {
    return std::holds_alternative<Light>(object) || std::holds_alternative<Sky>(object);
}

void applySolo(Scene& scene, const Document& document, const std::set<ObjectId>& solo) {
    const bool any = std::ranges::any_of(document.objects, [&](const auto& entry) {
        return canSolo(entry.second) && solo.contains(entry.first);
    });
    if (any)
        keepLights(scene, document, [&](ObjectId id) { return solo.contains(id); });
}

} // namespace limn
