// SPDX-License-Identifier: MIT
#include "engine/field/grid_placement.h"

#include <algorithm>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

Bounds gridBoundsOf(const Scene& scene) {
    Bounds bounds = staticBounds(scene);
    const float minSize = std::max(1e-3f * glm::length(bounds.size()), 1e-20f);
    const glm::vec3 missing = glm::max(glm::vec3(0), glm::vec3(minSize) - bounds.size()) * 0.5f;
    bounds.lower -= missing;
    bounds.upper += missing;
    return bounds;
}

glm::uvec3 chooseGridSize(const Scene& scene, const LightmapLayout& layout,
                          const BakeSettings& settings) {
    if (settings.grid != glm::uvec3(0))
        return glm::max(settings.grid, glm::uvec3(1));
    const bool needed = std::any_of(layout.instances.begin(), layout.instances.end(),
                                    [](const InstanceLightmap& i) { return i.uv.empty(); });
    if (!needed)
        return glm::uvec3(0);
    const glm::vec3 size = gridBoundsOf(scene).size();
    const float cell = std::max({size.x, size.y, size.z}) / 12;
    return glm::clamp(glm::uvec3(glm::round(size / cell)), glm::uvec3(2), glm::uvec3(32));
}

bool needsGrid(const Scene& scene, const LightmapLayout& layout) {
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
        if (i >= layout.instances.size() || layout.instances[i].uv.empty())
            return true;
    return false;
}

} // namespace limn
