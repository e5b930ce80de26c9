// SPDX-License-Identifier: MIT
#include "engine/export/godot_probes.h"

#include "engine/export/grid_texture.h"

#include <algorithm>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

/// Places along one axis at which probes stand.
struct Axis {
    std::vector<float> position;
    std::vector<std::uint32_t> cell; ///< of the grid
};

Axis axisOf(const IndirectField& field, int a, std::uint32_t stride, float origin) {
    const std::uint32_t n = field.gridSize[a];
    const float lower = field.gridBounds.lower[a], step = field.gridBounds.size()[a] / float(n);
    Axis axis;
    if (n == 1)
        return {{lower + origin, lower + step + origin}, {0, 0}};
    for (std::uint32_t c = 0;; c = std::min(c + stride, n - 1)) {
        axis.position.push_back(lower + (float(c) + 0.5f) * step + origin);
        axis.cell.push_back(c);
        if (c == n - 1)
            return axis;
    }
}

/// The box between eight neighbouring probes, or a range of such boxes.
struct Boxes {
    glm::uvec3 first, last; ///< half open
};

struct Builder {
    const std::array<Axis, 3>& axes;
    GodotProbes& out;

    glm::vec3 position(glm::uvec3 p) const {
        return {axes[0].position[p.x], axes[1].position[p.y], axes[2].position[p.z]};
    }
    std::uint32_t point(glm::uvec3 p) const {
        const auto nx = std::uint32_t(axes[0].cell.size()), ny = std::uint32_t(axes[1].cell.size());
        return (p.z * ny + p.y) * nx + p.x;
    }
    std::int32_t leaf(const std::array<std::uint32_t, 4>& tetrahedron) {
        out.tetrahedra.push_back(tetrahedron);
        return -std::int32_t(out.tetrahedra.size());
    }
    /// Makes the corner's tetrahedron and the plane that cuts it off; what is left lies under it.
    std::size_t cutCorner(glm::uvec3 box, glm::uvec3 corner);
    std::int32_t addBox(glm::uvec3 box);
    std::int32_t add(const Boxes& boxes);
};

std::size_t Builder::cutCorner(glm::uvec3 box, glm::uvec3 corner) {
    const glm::vec3 lower = position(box), upper = position(box + 1U);
    const glm::vec3 outward = (glm::vec3(corner) * 2.f - 1.f) / (upper - lower);
    // In coordinates of [-1/2, 1/2] towards the corner, its three neighbours sum to 1/2.
    const float offset = 0.5f + glm::dot(outward, (lower + upper) * 0.5f);
    const float scale = 1 / glm::length(outward);
    std::array<std::uint32_t, 4> tetrahedron = {point(box + corner)};
    for (int a = 0; a < 3; ++a) {
        glm::uvec3 neighbour = corner;
        neighbour[a] = 1 - neighbour[a];
        tetrahedron[std::size_t(a) + 1] = point(box + neighbour);
    }
    const glm::vec3 normal = outward * scale;
    out.nodes.push_back({.plane = {normal.x, normal.y, normal.z, offset * scale}});
    out.nodes.back().over = leaf(tetrahedron);
    return out.nodes.size() - 1;
}

/// Every second corner is cut off; the other four are the tetrahedron that is left. Neighbouring
/// boxes cut alternately, so that they divide their common face alike.
std::int32_t Builder::addBox(glm::uvec3 box) {
    const std::uint32_t parity = (box.x + box.y + box.z) & 1;
    const auto first = std::int32_t(out.nodes.size());
    std::array<std::uint32_t, 4> rest{};
    std::size_t count = 0, last = 0;
    for (std::uint32_t k = 0; k < 8; ++k) {
        const glm::uvec3 corner(k & 1, k >> 1 & 1, k >> 2 & 1);
        if (((corner.x + corner.y + corner.z) & 1) == parity) {
            rest[count++] = point(box + corner);
            continue;
        }
        const std::size_t node = cutCorner(box, corner);
        if (std::int32_t(node) != first)
            out.nodes[last].under = std::int32_t(node);
        last = node;
    }
    out.nodes[last].under = leaf(rest);
    return first;
}

std::int32_t Builder::add(const Boxes& boxes) {
    const glm::uvec3 size = boxes.last - boxes.first;
    const int a = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    if (size[a] == 1)
        return addBox(boxes.first);
    const std::uint32_t middle = boxes.first[a] + size[a] / 2;
    const std::size_t node = out.nodes.size();
    out.nodes.push_back({.plane = {0, 0, 0, axes[std::size_t(a)].position[middle]}});
    out.nodes[node].plane[std::size_t(a)] = 1;
    Boxes over = boxes, under = boxes;
    over.first[a] = under.last[a] = middle;
    const std::int32_t overNode = add(over), underNode = add(under);
    out.nodes[node].over = overNode;
    out.nodes[node].under = underNode;
    return std::int32_t(node);
}

} // namespace

GodotProbes godotProbes(const IndirectField& field, glm::vec3 origin) {
    std::array<Axis, 3> axes;
    for (std::uint32_t stride = 1;; ++stride) {
        std::size_t count = 1;
        for (int a = 0; a < 3; ++a) {
            axes[std::size_t(a)] = axisOf(field, a, stride, origin[a]);
            count *= axes[std::size_t(a)].cell.size();
        }
        if (count <= kMaxGodotProbes)
            break;
    }
    GodotProbes probes;
    const glm::uvec3 n(axes[0].cell.size(), axes[1].cell.size(), axes[2].cell.size());
    Builder builder{axes, probes};
    for (std::uint32_t z = 0; z < n.z; ++z)
        for (std::uint32_t y = 0; y < n.y; ++y)
            for (std::uint32_t x = 0; x < n.x; ++x) {
                const std::size_t row = std::size_t(axes[2].cell[z]) * field.gridSize.y;
                const std::size_t cell =
                    (row + axes[1].cell[y]) * field.gridSize.x + axes[0].cell[x];
                probes.points.push_back(builder.position({x, y, z}));
                probes.harmonics.push_back(godotProbe(gridCell(field, cell)));
            }
    builder.add({glm::uvec3(0), n - 1U});
    probes.lower = probes.points.front();
    probes.upper = probes.points.back();
    return probes;
}

} // namespace limn
