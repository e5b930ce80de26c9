// SPDX-License-Identifier: MIT
#include "editor_ui/document/muted.h"

#include <map>

namespace limn {

bool canMute(const Object& object) {
    return std::holds_alternative<Light>(object) || std::holds_alternative<Sky>(object) ||
           std::holds_alternative<Node>(object);
}

static void muteLights(Scene& scene, const Document& document, const std::set<ObjectId>& muted) {
    auto light = scene.lights.begin();
    for (const auto& [id, object] : document.objects) {
        if (std::holds_alternative<Light>(object) && light != scene.lights.end())
            (light++)->enabled &= !muted.contains(id);
        if (std::holds_alternative<Sky>(object) && muted.contains(id))
            scene.sky = {};
    }
}

/// Materials may be shared with objects that are not muted, so the muted ones get copies.
static void muteSurfaces(Scene& scene, const std::set<ObjectId>& muted) {
    std::map<std::uint32_t, std::uint32_t> black; // index of the copy of a material
    for (Instance& instance : scene.instances) {
        if (!muted.contains(instance.node))
            continue;
        const auto [at, added] =
            black.emplace(instance.material, std::uint32_t(scene.materials.size()));
        if (added) {
            Material copy = scene.materials[instance.material];
            copy.baseColor = {0, 0, 0, copy.baseColor.w};
            scene.materials.push_back(std::move(copy));
        }
        instance.material = at->second;
    }
}

void applyMuted(Scene& scene, const Document& document, const std::set<ObjectId>& muted) {
    if (muted.empty())
        return;
    muteLights(scene, document, muted);
    muteSurfaces(scene, muted);
}

} // namespace limn
