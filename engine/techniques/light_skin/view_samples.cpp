// SPDX-License-Identifier: MIT
#include "engine/techniques/light_skin/view_samples.h"

#include "engine/core/parallel.h"
#include "engine/math/sampling.h"
#include "engine/scene/mesh/triangle_geometry.h"
#include "engine/shading/pixel_rays.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

glm::uvec2 sampledPixels(const Viewpoint& view) {
    if (view.size.x > 0 && view.size.y > 0)
        return view.size;
    constexpr std::uint32_t kRows = 1024;
    return {std::max(std::uint32_t(std::lround(float(kRows) * view.aspect)), 1U), kRows};
}

/// The surface that the middle of a pixel shows; none where there is none, or the back of one that
/// has one side.
static std::optional<Hit> shownBy(const TraceScene& trace, const Scene& scene,
                                  const PixelRays& rays, glm::vec2 pixel) {
    const Hit hit = trace.closestHit(rays.through(pixel + 0.5f));
    if (!hit || (!hit.frontFace && !isTwoSided(scene.materialOf(scene.instances[hit.instance]))))
        return {};
    return hit;
}

ViewSamples samplesOfView(const TraceScene& trace, const Scene& scene, const Viewpoint& view,
                          std::uint32_t count) {
    const glm::uvec2 size = sampledPixels(view);
    const PixelRays rays(view.camera, size.x, size.y);
    ViewSamples samples;
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::vec2 pixel =
            glm::floor(glm::vec2(radicalInverse(i, 2), radicalInverse(i, 3)) * glm::vec2(size));
        if (const std::optional<Hit> hit = shownBy(trace, scene, rays, pixel)) {
            samples.position.push_back(hit->position);
            samples.normal.push_back(hit->frontFace ? hit->geometricNormal : -hit->geometricNormal);
        }
    }
    return samples;
}

CachesInView cachesInView(const LightCaches& caches, const Viewpoint& view) {
    const glm::uvec2 size = sampledPixels(view);
    const PixelRays rays(view.camera, size.x, size.y);
    CachesInView found{.near = caches.spacing};
    for (std::size_t c = 0; c < caches.size(); ++c) {
        const std::optional<glm::vec2> pixel = rays.pixelOf(caches.position[c]);
        if (!pixel || glm::dot(caches.position[c] - rays.eye, caches.normal[c]) >= 0)
            continue;
        found.caches.position.push_back(caches.position[c]);
        found.caches.normal.push_back(caches.normal[c]);
        found.pixel.push_back(glm::min(glm::uvec2(*pixel), size - 1U));
    }
    return found;
}

ViewSamples seenCaches(const TraceScene& trace, const Scene& scene, const CachesInView& candidates,
                       const Viewpoint& view) {
    const glm::uvec2 size = sampledPixels(view);
    const PixelRays rays(view.camera, size.x, size.y);
    std::vector<std::uint8_t> seen(candidates.size());
    parallelRanges(candidates.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t c = begin; c < end; ++c) {
            const auto hit = shownBy(trace, scene, rays, glm::vec2(candidates.pixel[c]));
            const glm::vec3 way = hit ? hit->position - candidates.caches.position[c] : rays.eye;
            seen[c] = hit && glm::length(way) <= candidates.near &&
                      std::abs(glm::dot(way, hit->geometricNormal)) <= kSeenShare * candidates.near;
        }
    });
    ViewSamples samples;
    for (std::size_t c = 0; c < candidates.size(); ++c)
        if (seen[c] > 0) {
            samples.position.push_back(candidates.caches.position[c]);
            samples.normal.push_back(candidates.caches.normal[c]);
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
