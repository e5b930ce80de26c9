// SPDX-License-Identifier: MIT
#include "engine/final_lightmap/texel_lookups.h"

#include "engine/lightmap/plain_lightmap.h"
#include "engine/math/horizon.h"
#include "engine/scene/mesh/triangle_geometry.h"

#include <algorithm>

#include <glm/geometric.hpp>

namespace limn {

TexelLookup lookUpTexels(const LitTexels& lit, std::uint32_t instance, std::uint32_t mesh,
                         const MeshPoint& point, bool back) {
    const LightmapLayout& layout = lit.atlas.layout;
    const glm::vec2 uv = unsnappedUv(layout, instance, mesh, point.triangle, point.barycentric.x,
                                     point.barycentric.y, back);
    const Bilinear bilinear = bilinearAt(layout, uv);
    TexelLookup lookup;
    float sum = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        // Beyond a chart's border, texels are read by rounding alone.
        const std::uint32_t texel = lit.texelAt[bilinear.texel[k]];
        if (texel == kNoTexel || lit.atlas.texels[texel].instance != instance)
            continue;
        lookup.texel[k] = texel;
        lookup.weight[k] = bilinear.weight[k];
        sum += bilinear.weight[k];
    }
    for (float& weight : lookup.weight)
        weight = sum > 0 ? weight / sum : 0;
    return lookup;
}

std::array<glm::vec3, 9> fieldCoefficients(const FieldPoint& point) {
    std::array<glm::vec3, 9> c{};
    const FieldLookup lookup = lookUp(point);
    const IndirectField& field = point.field;
    const std::vector<glm::vec4>& values = lookup.grid ? field.grid : field.lightmap;
    const std::size_t stride = values.size() / field.coefficients();
    for (std::size_t i = 0; i < std::min<std::size_t>(c.size(), field.coefficients()); ++i)
        for (std::size_t k = 0; k < lookup.count; ++k)
            c[i] += lookup.weight[k] * glm::vec3(values[i * stride + lookup.index[k]]);
    if (field.continues && !lookup.grid && lookup.count > 0)
        cutBelow(point.surfaceNormal(), c.data());
    return c;
}

Hit hitOfPoint(const Scene& scene, std::uint32_t instance, const MeshPoint& point, bool back) {
    const Instance& placed = scene.instances[instance];
    const Mesh& mesh = scene.meshOf(placed);
    Hit hit;
    hit.instance = instance;
    hit.triangle = point.triangle;
    hit.u = point.barycentric.x;
    hit.v = point.barycentric.y;
    hit.position = glm::vec3(placed.toWorld *
                             glm::vec4(trianglePoint(mesh, point.triangle, point.barycentric), 1));
    hit.geometricNormal =
        glm::normalize(placed.normalToWorld * triangleNormal(mesh, point.triangle));
    hit.frontFace = !back;
    return hit;
}

} // namespace limn
