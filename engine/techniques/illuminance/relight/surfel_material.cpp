// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/relight/surfel_material.h"

#include "engine/core/parallel.h"
#include "engine/techniques/illuminance/format/sky_cells.h"

#include <algorithm>
#include <functional>
#include <numbers>

#include <glm/common.hpp>

namespace limn {

void surfelMaterials(const Surfels& surfels, const Scene& scene, std::vector<glm::vec3>& albedo,
                     std::vector<glm::vec3>& emitted, std::span<const Material> known) {
    const Surfels& s = surfels;
    albedo.resize(s.size());
    emitted.resize(s.size());
    std::vector<char> stale(scene.materials.size(), 1);
    if (known.size() == scene.materials.size())
        std::ranges::transform(scene.materials, known, stale.begin(), std::not_equal_to{});
    parallelRanges(s.size(), 512, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Instance& instance = scene.instances[s.instance[i]];
            if (!stale[instance.material])
                continue;
            const SurfaceMaterial m = surfaceMaterialOver(
                scene, instance, s.triangle[i], s.barycentric[i].x, s.barycentric[i].y, s.area[i]);
            albedo[i] = glm::min(m.albedo, glm::vec3(0.99f));
            emitted[i] = m.emission * std::numbers::pi_v<float>;
        }
    });
}

std::vector<glm::vec3> skyRadiosity(const ClusterTree& tree, const Sky& sky) {
    const std::vector<glm::vec3> cells = skyCellRadiance(sky);
    std::vector<glm::vec3> radiosity(tree.skyCells);
    for (std::size_t c = 0; c < radiosity.size(); ++c)
        radiosity[c] = std::numbers::pi_v<float> * cells[skyCellOf(tree.skyDirection[c])];
    return radiosity;
}

} // namespace limn
