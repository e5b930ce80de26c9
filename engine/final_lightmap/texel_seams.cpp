// SPDX-License-Identifier: MIT
#include "engine/final_lightmap/texel_seams.h"

#include "engine/lightmap/atlas.h"
#include "engine/scene/mesh/mesh_topology.h"
#include "engine/scene/mesh/triangle_geometry.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace limn {

namespace {

struct SeamFinder {
    const Scene& scene;
    const LitTexels& lit;
    std::vector<SeamLookup> seams;

    glm::vec3 normalOf(const Instance& instance, const MeshPoint& p) const {
        const Mesh& mesh = scene.meshOf(instance);
        const glm::vec3 front =
            glm::normalize(instance.normalToWorld * triangleNormal(mesh, p.triangle));
        return shadingNormal(mesh, instance, p.triangle, p.barycentric, front);
    }

    /// Length of a half-edge in texels.
    float texelsAlong(std::uint32_t instance, std::uint32_t mesh, std::uint32_t e) const {
        const LightmapLayout& layout = lit.atlas.layout;
        const auto uvAt = [&](float s) {
            const MeshPoint p = pointOfEdge(e, s);
            return unsnappedUv(layout, instance, mesh, p.triangle, p.barycentric.x, p.barycentric.y,
                               false);
        };
        return glm::length((uvAt(1) - uvAt(0)) * glm::vec2(layout.width, layout.height));
    }

    void addEdge(std::uint32_t instance, std::uint32_t a, std::uint32_t b) {
        constexpr float kCosSmooth = 0.99939f; // 2 degrees
        constexpr float kPerTexel = 2, kMaxPoints = 4096;
        const Instance& placed = scene.instances[instance];
        const float texels = texelsAlong(instance, placed.mesh, a);
        const auto count =
            std::uint32_t(std::clamp(std::ceil(kPerTexel * texels), 1.f, kMaxPoints));
        const bool twoSided = lit.atlas.layout.instances[instance].backRows > 0;
        for (std::uint32_t k = 0; k < count; ++k) {
            const float s = (float(k) + 0.5f) / float(count);
            const MeshPoint first = pointOfEdge(a, s), second = pointOfEdge(b, 1 - s);
            if (glm::dot(normalOf(placed, first), normalOf(placed, second)) < kCosSmooth)
                continue;
            for (const bool back : {false, true})
                if (!back || twoSided)
                    seams.push_back({lookUpTexels(lit, instance, placed.mesh, first, back),
                                     lookUpTexels(lit, instance, placed.mesh, second, back),
                                     std::max(texels, 0.5f) / float(count)});
        }
    }
};

} // namespace

std::vector<SeamLookup> findSeams(const Scene& scene, const LitTexels& lit) {
    SeamFinder finder{scene, lit, {}};
    const LightmapLayout& layout = lit.atlas.layout;
    for (std::uint32_t i = 0; i < layout.instances.size(); ++i) {
        if (layout.instances[i].uv.empty())
            continue;
        const std::uint32_t mesh = scene.instances[i].mesh;
        const std::vector<std::uint32_t> partner = edgePartners(scene.assets->meshes[mesh]);
        const std::vector<std::uint32_t>& chartOf = layout.meshes[mesh].chartOfTriangle;
        for (std::uint32_t e = 0; e < partner.size(); ++e)
            if (partner[e] != kNoEdge && partner[e] > e &&
                chartOf[e / 3] != chartOf[partner[e] / 3])
                finder.addEdge(i, e, partner[e]);
    }
    return std::move(finder.seams);
}

} // namespace limn
