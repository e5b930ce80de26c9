// SPDX-License-Identifier: MIT
#include "engine/relight/surfel_material.h"

#include "engine/core/parallel.h"

#include <numbers>

#include <glm/common.hpp>

namespace limn {

void surfelMaterials(const Surfels& surfels, const Scene& scene, std::vector<glm::vec3>& albedo,
                     std::vector<glm::vec3>& emitted) {
    const Surfels& s = surfels;
    albedo.resize(s.size());
    emitted.resize(s.size());
    parallelRanges(s.size(), 512, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const SurfaceMaterial m =
                surfaceMaterialOver(scene, scene.instances[s.instance[i]], s.triangle[i],
                                    s.barycentric[i].x, s.barycentric[i].y, s.area[i]);
            albedo[i] = glm::min(m.albedo, glm::vec3(0.99f));
            emitted[i] = m.emission * std::numbers::pi_v<float>;
        }
    });
}

} // namespace limn
