// SPDX-License-Identifier: MIT
#include "editor_ui/jobs/selection_bake.h"

#include "engine/scene/document.h"
#include "engine/scene/mesh/triangle_geometry.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

namespace limn {

Scene selectionScene(Scene scene, std::span<const ObjectId> nodes) {
    const std::unordered_set<ObjectId> chosen(nodes.begin(), nodes.end());
    double before = 0, after = 0; // areas times squared densities
    for (Instance& instance : scene.instances) {
        if (instance.dynamic)
            continue;
        const double sides = isTwoSided(scene, instance) ? 2 : 1;
        const double area = worldArea(scene, instance) * sides;
        before += area * std::pow(double(instance.texelDensity), 2);
        if (!chosen.contains(instance.node))
            instance.texelDensity =
                std::max(instance.texelDensity * kUnselectedDensity, kMinTexelDensity);
        after += area * std::pow(double(instance.texelDensity), 2);
    }
    if (before > 0 && scene.bake.lightmapCaches > 0)
        scene.bake.lightmapCaches = std::max(
            1U, std::uint32_t(std::lround(double(scene.bake.lightmapCaches) * after / before)));
    return scene;
}

} // namespace limn
