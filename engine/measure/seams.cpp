// SPDX-License-Identifier: MIT
#include "engine/measure/seams.h"

#include "engine/field/sample_field.h"
#include "engine/scene/mesh/mesh_topology.h"
#include "engine/scene/mesh/triangle_geometry.h"

#include <cmath>

#include <glm/geometric.hpp>

namespace limn {

namespace {

struct SeamSums {
    const Scene& scene;
    const LightmapLayout& layout;
    const IndirectField& field;
    double jump = 0, irradiance = 0, length = 0;

    /// Irradiance at fraction `s` along half-edge `e`, from its first corner.
    glm::vec3 irradianceAt(std::uint32_t instance, std::uint32_t e, float s, glm::vec3 n) const {
        const glm::vec2 uv = pointOfEdge(e, s).barycentric;
        const Instance& i = scene.instances[instance];
        const glm::vec3 p = i.toWorld * glm::vec4(trianglePoint(scene.meshOf(i), e / 3, uv), 1);
        return sampleIrradiance({field, layout, scene, instance, e / 3, uv.x, uv.y, p, n});
    }

    void addEdge(std::uint32_t instance, std::uint32_t a, std::uint32_t b, glm::vec3 n) {
        const Instance& i = scene.instances[instance];
        const Mesh& mesh = scene.meshOf(i);
        const glm::vec3 along = mesh.positions[mesh.indices[a % 3 == 2 ? a - 2 : a + 1]] -
                                mesh.positions[mesh.indices[a]];
        const double world = double(glm::length(glm::mat3(i.toWorld) * along));
        constexpr int kSamples = 4;
        for (int k = 0; k < kSamples; ++k) {
            const float s = (float(k) + 0.5f) / kSamples;
            const glm::vec3 ea = irradianceAt(instance, a, s, n),
                            eb = irradianceAt(instance, b, 1 - s, n);
            const glm::vec3 apart = glm::abs(ea - eb), sum = ea + eb;
            jump += world / kSamples * double(apart.x + apart.y + apart.z) / 3;
            irradiance += world / kSamples * double(sum.x + sum.y + sum.z) / 6;
        }
        length += world;
    }

    void addInstance(std::uint32_t instance) {
        constexpr float kCosFlat = 0.8660254f; // 30 degrees
        const Instance& i = scene.instances[instance];
        const Mesh& mesh = scene.meshOf(i);
        const MeshCharts& charts = layout.meshes[i.mesh];
        const std::vector<std::uint32_t> partner = edgePartners(mesh);
        for (std::uint32_t e = 0; e < partner.size(); ++e) {
            const std::uint32_t other = partner[e];
            if (other == kNoEdge || other < e ||
                charts.chartOfTriangle[e / 3] == charts.chartOfTriangle[other / 3])
                continue;
            const glm::vec3 na = i.normalToWorld * triangleNormal(mesh, e / 3),
                            nb = i.normalToWorld * triangleNormal(mesh, other / 3);
            if (glm::dot(glm::normalize(na), glm::normalize(nb)) >= kCosFlat)
                addEdge(instance, e, other,
                        glm::normalize(glm::normalize(na) + glm::normalize(nb)));
        }
    }
};

} // namespace

SeamError measureSeams(const Scene& scene, const LightmapLayout& layout,
                       const IndirectField& field) {
    SeamSums sums{scene, layout, field};
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
        if (i < layout.instances.size() && !layout.instances[i].uv.empty())
            sums.addInstance(i);
    if (!(sums.length > 0))
        return {};
    return {sums.jump / sums.length, sums.irradiance / sums.length, sums.length};
}

} // namespace limn
