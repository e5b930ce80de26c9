// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/receivers/cache_points.h"

#include "engine/lightmap/texel_sides.h"

#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

void addSurfaceCache(const Scene& scene, const AtlasTexel& texel, Caches& caches,
                     CachePoints& points) {
    const std::size_t first = points.position.size();
    glm::vec3 position{0}, normal{0};
    for (std::uint32_t k = 0; k < texel.count; ++k) {
        const WorldPoint p = texelPoint(scene, texel, k);
        points.position.push_back(p.position);
        points.normal.push_back(p.normal);
        position += p.position / float(texel.count);
        normal += p.normal;
    }
    const float length = glm::length(normal);
    points.begin.push_back(std::uint32_t(points.position.size()));
    caches.kind.push_back(CacheKind::Hemisphere);
    caches.position.push_back(position);
    caches.normal.push_back(length > 1e-3f ? normal / length : points.normal[first]);
    caches.texel.push_back(texel.texel);
    points.seed.push_back(seedOf(scene, texel));
    ++caches.lightmapCount;
}

/// Area of a texel relative to those of the place where it was added near a lamp; 1 for all others.
static float areaNearLamp(const Atlas& atlas, const AtlasTexel& texel) {
    const std::uint32_t row = texel.texel / atlas.layout.width;
    float area = 1;
    for (const std::uint32_t first : atlas.lampRows)
        area /= row >= first ? float(kFineCells * kFineCells) : 1;
    return area;
}

Caches placeCaches(const Scene& scene, const Atlas& atlas, CachePoints& points) {
    Caches caches;
    points.begin = {0};
    for (const AtlasTexel& t : atlas.texels) {
        addSurfaceCache(scene, t, caches, points);
        points.weight.push_back(areaNearLamp(atlas, t));
    }
    return caches;
}

void addGridCaches(glm::uvec3 gridSize, const Bounds& gridBounds, Caches& caches,
                   CachePoints& points) {
    const glm::vec3 cell = gridBounds.size() / glm::vec3(glm::max(gridSize, glm::uvec3(1)));
    std::uint32_t index = 0;
    for (std::uint32_t z = 0; z < gridSize.z; ++z)
        for (std::uint32_t y = 0; y < gridSize.y; ++y)
            for (std::uint32_t x = 0; x < gridSize.x; ++x) {
                caches.kind.push_back(CacheKind::Grid);
                caches.position.push_back(gridBounds.lower + (glm::vec3(x, y, z) + 0.5f) * cell);
                caches.normal.emplace_back(0);
                caches.texel.push_back(index);
                points.seed.push_back(index++);
                points.position.push_back(caches.position.back());
                points.normal.emplace_back(0);
                points.begin.push_back(std::uint32_t(points.position.size()));
            }
}

void connectSurfels(const SideLookup& lookups, const Scene& scene, const LightmapLayout& layout,
                    const Caches& caches, Surfels& surfels) {
    std::vector<std::uint32_t> cacheOfTexel(std::size_t(layout.width) * layout.height, ~0U);
    for (std::uint32_t i = 0; i < caches.lightmapCount; ++i)
        cacheOfTexel[caches.texel[i]] = i;
    surfels.cache.assign(surfels.size(), glm::uvec4(~0U));
    surfels.cacheWeight.assign(surfels.size(), glm::vec4(0));
    for (std::size_t s = 0; s < surfels.size(); ++s) {
        if (layout.instances[surfels.instance[s]].uv.empty())
            continue;
        const Instance& instance = scene.instances[surfels.instance[s]];
        const MeshPoint point{surfels.triangle[s], surfels.barycentric[s]};
        const bool back =
            glm::dot(worldPoint(scene, instance, point).normal, surfels.normal[s]) < 0;
        const Bilinear lookup = bilinearAt(layout, lookups.uvOf(surfels.instance[s], point, back));
        float sum = 0;
        for (int k = 0; k < 4; ++k) {
            const std::uint32_t cache = cacheOfTexel[lookup.texel[k]];
            if (cache == ~0U || !(lookup.weight[k] > 0))
                continue;
            surfels.cache[s][k] = cache;
            surfels.cacheWeight[s][k] = lookup.weight[k];
            sum += lookup.weight[k];
        }
        if (sum > 0) // rounding may give a texel beyond the chart a weight of 1e-6
            surfels.cacheWeight[s] /= sum;
    }
}

} // namespace limn
