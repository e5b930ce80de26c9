// SPDX-License-Identifier: MIT
#include "engine/scene/light/light_cuts.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace limn {

namespace {

/// Clips a segment to [-1, 1]^2. Liang, Barsky. A New Concept and Method for Line Clipping. 1984
bool clipToSquare(glm::vec2& a, glm::vec2& b) {
    float enter = 0, leave = 1;
    const glm::vec2 way = b - a;
    for (int axis = 0; axis < 2; ++axis)
        for (const float side : {-1.f, 1.f}) {
            const float out = side * a[axis] - 1, along = -side * way[axis];
            if (along == 0 && out > 0)
                return false;
            if (along < 0)
                leave = std::min(leave, out / along);
            if (along > 0)
                enter = std::max(enter, out / along);
        }
    if (!(enter < leave))
        return false;
    const glm::vec2 start = a;
    a = start + way * enter;
    b = start + way * leave;
    return true;
}

/// Intersects triangles with a plane slightly in front of the light, so that a surface flush with
/// the light does not cut it.
class Cutter {
public:
    explicit Cutter(const LightRectangle& r)
        : m_r(r), m_from(r.centre + r.normal * (1e-3f * std::min(glm::length(r.halfWidth),
                                                                 glm::length(r.halfHeight)))) {}

    void add(const Scene& scene, const Instance& instance, std::vector<LightCut>& cuts) {
        const Mesh& mesh = scene.meshOf(instance);
        const glm::vec3 normal = glm::transpose(glm::mat3(instance.toWorld)) * m_r.normal;
        const float offset = glm::dot(m_r.normal, glm::vec3(instance.toWorld[3]) - m_from);
        m_height.resize(mesh.positions.size());
        for (std::size_t i = 0; i < m_height.size(); ++i)
            m_height[i] = glm::dot(normal, mesh.positions[i]) + offset;
        for (std::size_t t = 0; t < mesh.triangleCount(); ++t)
            addTriangle(scene, instance, mesh.triangle(t), cuts);
    }

private:
    glm::vec2 coordinates(glm::vec3 p) const {
        const glm::vec3 way = p - m_r.centre;
        return {glm::dot(way, m_r.halfWidth) / glm::dot(m_r.halfWidth, m_r.halfWidth),
                glm::dot(way, m_r.halfHeight) / glm::dot(m_r.halfHeight, m_r.halfHeight)};
    }
    void addTriangle(const Scene& scene, const Instance& instance,
                     const std::array<std::uint32_t, 3>& corners,
                     std::vector<LightCut>& cuts) const {
        const std::vector<glm::vec3>& positions = scene.meshOf(instance).positions;
        std::array<glm::vec3, 3> ends;
        std::size_t count = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t i = corners[k], j = corners[(k + 1) % 3];
            if ((m_height[i] < 0) != (m_height[j] < 0))
                ends[count++] = positions[i] + (positions[j] - positions[i]) *
                                                   (m_height[i] / (m_height[i] - m_height[j]));
        }
        if (count != 2)
            return;
        const auto placed = [&](glm::vec3 p) {
            return coordinates(glm::vec3(instance.toWorld * glm::vec4(p, 1)));
        };
        LightCut cut{placed(ends[0]), placed(ends[1]), {}, false};
        if (!clipToSquare(cut.a, cut.b))
            return;
        const glm::vec3 normal =
            instance.normalToWorld * glm::cross(positions[corners[1]] - positions[corners[0]],
                                                positions[corners[2]] - positions[corners[0]]);
        cut.front = {glm::dot(normal, m_r.halfWidth), glm::dot(normal, m_r.halfHeight)};
        cut.twoSided = scene.materialOf(instance).doubleSided;
        cuts.push_back(cut);
    }

    const LightRectangle& m_r;
    glm::vec3 m_from;
    std::vector<float> m_height; ///< of the mesh's vertices above the plane
};

} // namespace

std::vector<LightCut> lightCuts(const LightRectangle& light, const Scene& scene) {
    Cutter cutter(light);
    std::vector<LightCut> cuts;
    for (const Instance& instance : scene.instances)
        if (!isCutout(scene.materialOf(instance)))
            cutter.add(scene, instance, cuts);
    return cuts;
}

} // namespace limn
