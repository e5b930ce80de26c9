// SPDX-License-Identifier: MIT
#include "engine/techniques/sparse_probes/receivers.h"

#include "engine/core/parallel.h"
#include "engine/lightmap/texel_points.h"

#include <algorithm>

#include <glm/geometric.hpp>

namespace limn {

/// Number of the point next to the middle of a texel's points.
static std::uint32_t middlePoint(const Scene& scene, const AtlasTexel& texel) {
    glm::vec3 middle(0);
    for (std::uint32_t k = 0; k < texel.count; ++k)
        middle += texelPoint(scene, texel, k).position / float(texel.count);
    const auto distance = [&](std::uint32_t k) {
        return glm::distance(texelPoint(scene, texel, k).position, middle);
    };
    std::uint32_t nearest = 0;
    for (std::uint32_t k = 1; k < texel.count; ++k)
        if (distance(k) < distance(nearest))
            nearest = k;
    return nearest;
}

Receivers placeReceivers(const Scene& scene, const Atlas& atlas) {
    Receivers receivers;
    for (const AtlasTexel& texel : atlas.texels) {
        const MeshPoint& point = texel.points[middlePoint(scene, texel)];
        receivers.texel.push_back(texel.texel);
        receivers.instance.push_back(texel.instance);
        receivers.triangle.push_back(point.triangle);
        receivers.barycentric.push_back(point.barycentric);
        receivers.back.push_back(std::uint8_t(texel.back));
        receivers.width.push_back(texel.width);
    }
    return receivers;
}

ReceiverPoints pointsOf(const Scene& scene, const Receivers& r) {
    ReceiverPoints points;
    points.position.resize(r.size());
    points.normal.resize(r.size());
    parallelRanges(r.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Instance& instance = scene.instances[r.instance[i]];
            const WorldPoint point = worldPoint(scene, instance, {r.triangle[i], r.barycentric[i]});
            const glm::vec3 normal = shadingNormal(scene.meshOf(instance), instance, r.triangle[i],
                                                   r.barycentric[i], point.normal);
            points.position[i] = point.position;
            points.normal[i] = r.back[i] ? -normal : normal;
        }
    });
    return points;
}

ReceiverAt::ReceiverAt(const LightmapLayout& layout, const Receivers& receivers)
    : m_layout(layout), m_receiverOf(std::size_t(layout.width) * layout.height, kNone) {
    for (std::uint32_t r = 0; r < receivers.size(); ++r)
        m_receiverOf[receivers.texel[r]] = r;
}

std::uint32_t ReceiverAt::operator()(const Scene& scene, const Hit& hit) const {
    if ((!hit.frontFace && !isTwoSided(scene.materialOf(scene.instances[hit.instance]))) ||
        m_layout.instances[hit.instance].uv.empty())
        return kNone;
    const Bilinear lookup = bilinearAt(m_layout, scene, hit);
    std::uint32_t found = kNone;
    float maxWeight = 0;
    for (int k = 0; k < 4; ++k)
        if (const std::uint32_t r = m_receiverOf[lookup.texel[k]];
            r != kNone && lookup.weight[k] > maxWeight) {
            maxWeight = lookup.weight[k];
            found = r;
        }
    return found;
}

} // namespace limn
