// SPDX-License-Identifier: MIT
#include "engine/techniques/illuminance/bake/senders/surface_walk.h"

#include "engine/scene/mesh/mesh_topology.h"

#include <algorithm>
#include <array>

#include <glm/geometric.hpp>

namespace limn {

SurfaceWalk::SurfaceWalk(const Mesh& mesh, const Progress& progress)
    : m_mesh(mesh), m_geometry(triangleGeometry(mesh)), m_partner(edgePartners(mesh, progress)) {}

bool SurfaceWalk::isBorder(std::uint32_t triangle, std::uint32_t k) const {
    const std::uint32_t partner = m_partner[3 * triangle + k];
    return partner == kNoEdge || !(m_geometry.area[partner / 3] > 0);
}

static MeshPoint pointOf(std::uint32_t triangle, const std::array<float, 3>& weight) {
    const float u = std::clamp(weight[1], 0.f, 1.f), v = std::clamp(weight[2], 0.f, 1.f - u);
    return {triangle, {u, v}};
}

MeshPoint SurfaceWalk::move(MeshPoint point, glm::vec3 step) const {
    std::uint32_t t = point.triangle;
    std::array<float, 3> weight = {1 - point.barycentric.x - point.barycentric.y,
                                   point.barycentric.x, point.barycentric.y};
    for (int crossings = 0;; ++crossings) {
        if (!(m_geometry.area[t] > 0))
            return point;
        std::array<glm::vec3, 3> p;
        for (std::size_t k = 0; k < 3; ++k)
            p[k] = m_mesh.positions[m_mesh.indices[3 * t + k]];
        // Corner k's weight falls to 0 along the edge from corner k + 1 to k + 2.
        const glm::vec3 n = m_geometry.normal[t] / (2 * m_geometry.area[t]);
        std::array<float, 3> change;
        float reach = 1; // share of the step that stays in this triangle
        std::size_t opposite = 3;
        for (std::size_t k = 0; k < 3; ++k) {
            change[k] = glm::dot(step, glm::cross(n, p[(k + 2) % 3] - p[(k + 1) % 3]));
            if (weight[k] + change[k] < 0 && weight[k] <= -change[k] * reach) {
                reach = std::max(weight[k], 0.f) / -change[k];
                opposite = k;
            }
        }
        for (std::size_t k = 0; k < 3; ++k)
            weight[k] = std::max(weight[k] + change[k] * reach, 0.f);
        if (opposite == 3)
            return pointOf(t, weight);
        const std::size_t a = (opposite + 1) % 3, b = (opposite + 2) % 3;
        if (crossings == kMaxCrossings || isBorder(t, std::uint32_t(a)))
            return pointOf(t, weight);
        const std::uint32_t partner = m_partner[3 * t + a], next = partner / 3;
        const glm::vec3 edge = glm::normalize(p[b] - p[a]);
        const glm::vec3 outward = glm::cross(edge, m_geometry.normal[t]),
                        inward = glm::cross(edge, m_geometry.normal[next]);
        step *= 1 - reach;
        step = edge * glm::dot(step, edge) + inward * std::max(glm::dot(step, outward), 0.f);
        std::array<float, 3> there{};
        there[partner % 3] = weight[b];
        there[(partner + 1) % 3] = weight[a];
        weight = there;
        t = next;
    }
}

} // namespace limn
