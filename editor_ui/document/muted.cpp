// SPDX-License-Identifier: MIT
#include "editor_ui/document/muted.h"

#include "editor_ui/document/keep_lights.h"

#include <map>

namespace limn {

bool canMute(const Object& object) {
    return std::holds_alternative<Light>(object) || std::holds_alternative<Sky>(object) ||
           std::holds_alternative<Node>(object);
}

/// Materials may be shared with objects that are not muted, so the muted ones get copies.
static void muteSurfaces(Scene& scene, const std::set<ObjectId>& muted) {
    std::map<std::uint32_t, std::uint32_t> black; // index of the copy of a material
    for (Instance& instance : scene.instances) {
        if (!muted.contains(instance.node))
            continue;
        const auto [entry, added] =
            black.emplace(instance.material, std::uint32_t(scene.materials.size()));
        if (added) {
            Material copy = scene.materials[instance.material];
            copy.baseColor = {0, 0, 0, copy.baseColor.w};
            scene.materials.push_back(std::move(copy));
        }
        instance.material = entry->second;
    }
}

void applyMuted(Scene& scene, const Document& document, const std::set<ObjectId>& muted) {
    if (muted.empty())
        return;
    keepLights(scene, document, [&](ObjectId id) { return !muted.contains(id); });
    muteSurfaces(scene, muted);
}

} // namespace limn
