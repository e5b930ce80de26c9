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
    const SeamLight& light;
    const SeamEdges& edges;
    double jump = 0, irradiance = 0, length = 0;

    glm::vec3 normalAt(const Instance& i, const MeshPoint& p) const {
        const Mesh& mesh = scene.meshOf(i);
        const glm::vec3 front = glm::normalize(i.normalToWorld * triangleNormal(mesh, p.triangle));
        return edges.smooth ? shadingNormal(mesh, i, p.triangle, p.barycentric, front) : front;
    }

    void addPoint(std::uint32_t instance, const MeshPoint& a, const MeshPoint& b, double world) {
        constexpr float kCosFlat = 0.8660254f, kCosSmooth = 0.99939f; // 30 and 2 degrees
        const Instance& i = scene.instances[instance];
        const glm::vec3 na = normalAt(i, a), nb = normalAt(i, b);
        if (glm::dot(na, nb) < (edges.smooth ? kCosSmooth : kCosFlat))
            return;
        const glm::vec3 n = glm::normalize(na + nb);
        const glm::vec3 ea = light(instance, a, n), eb = light(instance, b, n);
        const glm::vec3 apart = glm::abs(ea - eb), sum = ea + eb;
        jump += world * double(apart.x + apart.y + apart.z) / 3;
        irradiance += world * double(sum.x + sum.y + sum.z) / 6;
        length += world;
    }

    void addEdge(std::uint32_t instance, std::uint32_t a, std::uint32_t b) {
        const Instance& i = scene.instances[instance];
        const Mesh& mesh = scene.meshOf(i);
        const glm::vec3 along = mesh.positions[mesh.indices[a % 3 == 2 ? a - 2 : a + 1]] -
                                mesh.positions[mesh.indices[a]];
        const double world = double(glm::length(glm::mat3(i.toWorld) * along));
        for (std::uint32_t k = 0; k < edges.samples; ++k) {
            const float s = (float(k) + 0.5f) / float(edges.samples);
            addPoint(instance, pointOfEdge(a, s), pointOfEdge(b, 1 - s), world / edges.samples);
        }
    }

    void addInstance(std::uint32_t instance) {
        const Instance& i = scene.instances[instance];
        const MeshCharts& charts = layout.meshes[i.mesh];
        const std::vector<std::uint32_t> partner = edgePartners(scene.meshOf(i));
        for (std::uint32_t e = 0; e < partner.size(); ++e)
            if (const std::uint32_t other = partner[e];
                other != kNoEdge && other > e &&
                charts.chartOfTriangle[e / 3] != charts.chartOfTriangle[other / 3])
                addEdge(instance, e, other);
    }
};

} // namespace

SeamError measureSeams(const Scene& scene, const LightmapLayout& layout, const SeamLight& light,
                       const SeamEdges& edges) {
    SeamSums sums{scene, layout, light, edges};
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i)
        if (i < layout.instances.size() && !layout.instances[i].uv.empty())
            sums.addInstance(i);
    if (!(sums.length > 0))
        return {};
    return {sums.jump / sums.length, sums.irradiance / sums.length, sums.length};
}

SeamError measureSeams(const Scene& scene, const LightmapLayout& layout,
                       const IndirectField& field) {
    return measureSeams(
        scene, layout, [&](std::uint32_t instance, const MeshPoint& point, glm::vec3 n) {
            const Instance& i = scene.instances[instance];
            const glm::vec2 uv = point.barycentric;
            const glm::vec3 p =
                i.toWorld * glm::vec4(trianglePoint(scene.meshOf(i), point.triangle, uv), 1);
            return sampleIrradiance(
                {field, layout, scene, instance, point.triangle, uv.x, uv.y, p, n});
        });
}

} // namespace limn
