// SPDX-License-Identifier: MIT
#include "engine/render/shadows/shadow_cascades.h"

#include "engine/render/shadows/shadow_maps.h"

#include <algorithm>
#include <cmath>

#include <glm/ext/matrix_clip_space.hpp>

namespace limn::render {

namespace {

// A map's centre is snapped to a lattice of kSteps points across the map's width, so that it stays
// put while the camera moves less than one step. The region that a cascade serves lies within
// kCovered of its half width, because the centre is up to half a step off and the filter reads a
// few texels more.
constexpr float kSteps = 16;
constexpr float kCovered = 1 / 1.2f;

/// A sphere around the view pyramid from the eye to a depth of 1.
struct PyramidSphere {
    float distance; ///< of its centre from the eye
    float radius;
};

PyramidSphere sphereOf(float tanCorner) {
    const float t2 = tanCorner * tanCorner;
    return t2 < 1 ? PyramidSphere{(1 + t2) / 2, (1 + t2) / 2} : PyramidSphere{1, tanCorner};
}

} // namespace

std::vector<glm::mat4> cascadeProjections(glm::vec3 direction, const Bounds& bounds,
                                          const ShadowCamera& camera) {
    const glm::mat4 toLight = directionalFrame(direction);
    const Bounds inLight = boundsInFrame(bounds, toLight);
    const float margin = 0.01f * inLight.size().z + 1e-6f * (1 + glm::length(inLight.upper));
    const PyramidSphere sphere = sphereOf(camera.tanCorner);
    std::vector<glm::mat4> out;
    const glm::vec3 size = inLight.size();
    // Half width of a map with half as many texels across as the map of the whole scene, and texels
    // of the same size.
    float half = std::max(size.x, size.y) / 4;
    for (std::uint32_t k = 0; k < kMaxCascades; ++k) {
        const float texelBefore = 2 * half / float(ShadowTiles::smallSize(0));
        if (texelBefore <= kTexelPixels * camera.pixel * camera.nearest)
            break;
        half /= kCascadeRatio;
        const float depth = half * kCovered / sphere.radius; // covered in full up to this depth
        if (!(depth * std::sqrt(1 + camera.tanCorner * camera.tanCorner) > camera.nearest))
            break;
        const glm::vec3 centre = camera.eye + camera.forward * (depth * sphere.distance);
        const float step = 2 * half / kSteps;
        const glm::vec2 snapped =
            step * glm::round(glm::vec2(toLight * glm::vec4(centre, 1)) / step);
        const glm::mat4 projection =
            glm::orthoRH_ZO(snapped.x - half, snapped.x + half, snapped.y - half, snapped.y + half,
                            -(inLight.lower.z - margin), -(inLight.upper.z + margin));
        out.push_back(projection * toLight);
    }
    return out;
}

} // namespace limn::render
