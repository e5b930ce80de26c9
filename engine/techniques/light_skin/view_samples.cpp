// SPDX-License-Identifier: MIT
#include "engine/techniques/light_skin/view_samples.h"

#include "engine/math/sampling.h"
#include "engine/scene/mesh/triangle_geometry.h"
#include "engine/shading/pixel_rays.h"

#include <algorithm>
#include <utility>

#include <glm/common.hpp>

namespace limn {

ViewSamples samplesOfView(const TraceScene& trace, const Scene& scene, const Viewpoint& view,
                          std::uint32_t count) {
    glm::vec2 size(view.size);
    if (view.size.x == 0 || view.size.y == 0)
        size = {kRowsWithoutSize * view.aspect, kRowsWithoutSize};
    PixelRays rays(view.camera, 1, 1);
    rays.size = size;
    rays.centre = rayDirection(view.camera, view.aspect, 0, 0);
    rays.right = rayDirection(view.camera, view.aspect, 1, 0) - rays.centre;
    rays.up = rayDirection(view.camera, view.aspect, 0, 1) - rays.centre;
    ViewSamples samples;
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::vec2 pixel =
            glm::floor(glm::vec2(radicalInverse(i, 2), radicalInverse(i, 3)) * size);
        const Hit hit = trace.closestHit(rays.through(pixel + 0.5f));
        if (!hit)
            continue;
        if (!hit.frontFace && !isTwoSided(scene.materialOf(scene.instances[hit.instance])))
            continue;
        samples.position.push_back(hit.position);
        samples.normal.push_back(hit.frontFace ? hit.geometricNormal : -hit.geometricNormal);
    }
    return samples;
}

ViewSamples samplesOfSurfaces(const Scene& scene, std::uint32_t count) {
    std::vector<double> upTo; // area of all triangles up to each one
    std::vector<std::pair<std::uint32_t, std::uint32_t>> triangles;
    double area = 0;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
        for (std::uint32_t t = 0; t < scene.meshOf(scene.instances[i]).triangleCount(); ++t) {
            area += double(triangleWorldArea(scene, scene.instances[i], t));
            upTo.push_back(area);
            triangles.emplace_back(i, t);
        }
    ViewSamples samples;
    if (!(area > 0))
        return samples;
    for (std::uint32_t k = 0; k < count; ++k) {
        const double place = (k + 0.5) / count * area;
        const auto found =
            std::min(std::size_t(std::ranges::lower_bound(upTo, place) - upTo.begin()),
                     triangles.size() - 1);
        const auto [i, t] = triangles[found];
        const Instance& instance = scene.instances[i];
        const Mesh& mesh = scene.meshOf(instance);
        const glm::vec2 uv = sampleTriangle({radicalInverse(k, 2), radicalInverse(k, 3)});
        const glm::vec3 across = instance.normalToWorld * triangleNormal(mesh, t);
        const bool back = k % 2 == 1 && isTwoSided(scene.materialOf(instance));
        samples.position.emplace_back(instance.toWorld * glm::vec4(trianglePoint(mesh, t, uv), 1));
        samples.normal.push_back(glm::normalize(back ? -across : across));
    }
    return samples;
}

} // namespace limn
