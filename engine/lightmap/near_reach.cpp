// SPDX-License-Identifier: MIT
#include "engine/lightmap/near_reach.h"

#include "engine/lightmap/atlas.h"
#include "engine/scene/mesh/triangle_geometry.h"

#include <algorithm>
#include <cmath>

#include <glm/vec2.hpp>

namespace limn {

namespace {

/// Maximum area of an instance's texels as a multiple of the scene's mean. The bound is for charts
/// smaller than a texel, whose triangles cover almost no area of the lightmap.
constexpr double kMaxTexel = 4;

/// Areas of an instance's triangles.
struct CoveredArea {
    double world = 0;  ///< [m^2]
    double texels = 0; ///< of the lightmap
};

CoveredArea coveredArea(const Scene& scene, const LightmapLayout& layout, std::size_t instance) {
    const std::vector<glm::vec2>& uv = layout.instances[instance].uv;
    const Instance& placed = scene.instances[instance];
    const std::vector<std::uint32_t>& indices = layout.meshes[placed.mesh].indices;
    const glm::vec2 size(layout.width, layout.height);
    CoveredArea sum{.world = worldArea(scene, placed)};
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const glm::vec2 a = (uv[indices[i + 1]] - uv[indices[i]]) * size,
                        b = (uv[indices[i + 2]] - uv[indices[i]]) * size;
        sum.texels += std::abs(double(a.x) * double(b.y) - double(a.y) * double(b.x)) / 2;
    }
    return sum;
}

} // namespace

std::vector<float> nearReaches(const Scene& scene, const LightmapLayout& layout) {
    std::vector<float> reaches(scene.instances.size(), 0);
    if (layout.instances.size() != scene.instances.size())
        return reaches;
    std::vector<CoveredArea> areas(reaches.size());
    CoveredArea all;
    for (std::size_t i = 0; i < areas.size(); ++i) {
        if (layout.instances[i].uv.empty())
            continue;
        areas[i] = coveredArea(scene, layout, i);
        all.world += areas[i].world;
        all.texels += areas[i].texels;
    }
    if (!(all.texels > 0))
        return reaches;
    const double mean = all.world / all.texels; // area of a texel
    for (std::size_t i = 0; i < areas.size(); ++i) {
        if (layout.instances[i].uv.empty())
            continue;
        const double texelArea = areas[i].texels > 0 ? areas[i].world / areas[i].texels : mean;
        reaches[i] = float(std::sqrt(std::min(texelArea, kMaxTexel * mean)) / 2);
    }
    return reaches;
}

float nearReachAt(const LightmapLayout& layout, float reach, std::uint32_t instance,
                  std::uint32_t mesh, std::uint32_t triangle, float u, float v, bool back) {
    return reach *
           lookupAt(layout, unsnappedUv(layout, instance, mesh, triangle, u, v, back)).width;
}

} // namespace limn
