// SPDX-License-Identifier: MIT
#include "engine/techniques/radiance_volumes/touched_cells.h"

#include "engine/core/parallel.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

void setBit(CellBits& bits, std::size_t cell) {
    const std::atomic_ref word(bits.words[cell / 64]);
    const std::uint64_t bit = std::uint64_t(1) << (cell % 64);
    if ((word.load(std::memory_order_relaxed) & bit) == 0)
        word.fetch_or(bit, std::memory_order_relaxed);
}

/// The cells from `lower` to `upper` along an axis of `size` cells; none if end <= begin.
struct CellRange {
    int begin, end;
    CellRange(float lower, float upper, std::uint32_t size)
        : begin(std::max(int(std::floor(std::max(lower - kTouchMargin, -1.f))), 0)),
          end(std::min(int(std::floor(std::min(upper + kTouchMargin, float(size)))) + 1,
                       int(size))) {}
};

/// A triangle seen along the axis that it faces most, in cells.
class FlatTriangle {
public:
    FlatTriangle(const std::array<glm::vec3, 3>& corners, glm::vec3 normal)
        : m_corner(corners), m_normal(normal) {
        const glm::vec3 size = glm::abs(normal);
        axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        u = (axis + 1) % 3, v = (axis + 2) % 3;
        const float sign = normal[axis] < 0 ? -1.f : 1.f;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec3 p = corners[k], q = corners[(k + 1) % 3];
            m_inward[k] = sign * glm::vec2(p[v] - q[v], q[u] - p[u]);
            // Of the square's corner that lies furthest inward.
            m_reach[k] = -glm::dot(m_inward[k], glm::vec2(p[u], p[v])) +
                         std::max(m_inward[k].x, 0.f) + std::max(m_inward[k].y, 0.f) +
                         kTouchMargin * (std::abs(m_inward[k].x) + std::abs(m_inward[k].y));
        }
    }
    bool meetsSquare(int cu, int cv) const {
        const glm::vec2 lower{float(cu), float(cv)};
        for (std::size_t k = 0; k < 3; ++k)
            if (glm::dot(m_inward[k], lower) + m_reach[k] < 0)
                return false;
        return true;
    }
    /// Depth of the plane at the square's middle, and how far it goes up and down within.
    glm::vec2 depthOver(int cu, int cv) const {
        const float slopeU = m_normal[u] / m_normal[axis], slopeV = m_normal[v] / m_normal[axis];
        const glm::vec3 p = m_corner[0];
        return {p[axis] - slopeU * (float(cu) + 0.5f - p[u]) - slopeV * (float(cv) + 0.5f - p[v]),
                (std::abs(slopeU) + std::abs(slopeV)) * (0.5f + kTouchMargin)};
    }
    int axis, u, v;

private:
    std::array<glm::vec3, 3> m_corner;
    glm::vec3 m_normal;
    std::array<glm::vec2, 3> m_inward; ///< across each edge, not unit
    std::array<float, 3> m_reach;
};

} // namespace

std::size_t CellBits::count() const {
    std::size_t sum = 0;
    for (const std::uint64_t word : words)
        sum += std::size_t(std::popcount(word));
    return sum;
}

void visitTouchedCells(const Lattice& lattice, const std::array<glm::vec3, 3>& corners,
                       const std::function<void(glm::uvec3 cell)>& visit) {
    std::array<glm::vec3, 3> p;
    for (std::size_t k = 0; k < 3; ++k)
        p[k] = (corners[k] - lattice.lower) / lattice.cell;
    const glm::vec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
    const float length = glm::dot(normal, normal);
    if (!(length > 0) || !std::isfinite(length))
        return;
    const FlatTriangle flat(p, normal);
    const glm::vec3 lower = glm::min(glm::min(p[0], p[1]), p[2]),
                    upper = glm::max(glm::max(p[0], p[1]), p[2]);
    const auto range = [&](int axis, float from, float to) {
        return CellRange(from, to, lattice.size[axis]);
    };
    const CellRange along = range(flat.u, lower[flat.u], upper[flat.u]),
                    across = range(flat.v, lower[flat.v], upper[flat.v]);
    for (int cv = across.begin; cv < across.end; ++cv)
        for (int cu = along.begin; cu < along.end; ++cu) {
            if (!flat.meetsSquare(cu, cv))
                continue;
            const glm::vec2 depth = flat.depthOver(cu, cv);
            const CellRange cells = range(flat.axis, std::max(depth.x - depth.y, lower[flat.axis]),
                                          std::min(depth.x + depth.y, upper[flat.axis]));
            for (int ca = cells.begin; ca < cells.end; ++ca) {
                glm::uvec3 cell;
                cell[flat.axis] = std::uint32_t(ca);
                cell[flat.u] = std::uint32_t(cu);
                cell[flat.v] = std::uint32_t(cv);
                visit(cell);
            }
        }
}

std::array<glm::vec3, 3> cornersOf(const Scene& scene, const Instance& instance,
                                   std::uint32_t triangle) {
    const Mesh& mesh = scene.meshOf(instance);
    const auto indices = mesh.triangle(triangle);
    std::array<glm::vec3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k)
        corners[k] = glm::vec3(instance.toWorld * glm::vec4(mesh.positions[indices[k]], 1));
    return corners;
}

CellBits touchedCells(const Scene& scene, const Lattice& lattice) {
    CellBits bits(lattice.cells());
    for (const Instance& instance : scene.instances)
        parallelRanges(
            scene.meshOf(instance).triangleCount(), 64, [&](std::size_t begin, std::size_t end) {
                for (std::size_t t = begin; t < end; ++t)
                    visitTouchedCells(lattice, cornersOf(scene, instance, std::uint32_t(t)),
                                      [&](glm::uvec3 cell) { setBit(bits, lattice.index(cell)); });
            });
    return bits;
}

} // namespace limn
