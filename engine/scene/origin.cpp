// SPDX-License-Identifier: MIT
#include "engine/scene/origin.h"

#include "engine/scene/mesh/bounds.h"
#include "engine/scene/placement.h"
#include "engine/scene/reach.h"

#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace limn {

namespace {

struct Box {
    glm::dvec3 lower{std::numeric_limits<double>::infinity()};
    glm::dvec3 upper{-std::numeric_limits<double>::infinity()};
};

} // namespace

static void extend(Box& box, const glm::dmat4& toFile, const Bounds& mesh) {
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p(corner & 1 ? mesh.upper.x : mesh.lower.x,
                          corner & 2 ? mesh.upper.y : mesh.lower.y,
                          corner & 4 ? mesh.upper.z : mesh.lower.z);
        const glm::dvec3 placed(toFile * glm::dvec4(p, 1));
        box.lower = glm::min(box.lower, placed);
        box.upper = glm::max(box.upper, placed);
    }
}

static Box staticBox(const Document& document, std::span<const Mesh> meshes) {
    std::vector<Bounds> bounds;
    for (const Mesh& mesh : meshes)
        bounds.push_back(boundsOf(mesh.positions));
    Box box;
    Placements placements(document, glm::dvec3(0));
    for (const auto& [id, object] : document.objects) {
        const Node* node = std::get_if<Node>(&object);
        if (!node || node->meshes.empty())
            continue;
        const Placement placement = placements.of(id);
        if (!placement.visible || placement.dynamic)
            continue;
        for (const std::uint32_t mesh : node->meshes)
            if (mesh < meshes.size() && !isEmpty(bounds[mesh]))
                extend(box, placement.toWorld, bounds[mesh]);
    }
    return box;
}

glm::dvec3 originOf(const Document& document, std::span<const Mesh> meshes) {
    const Box box = staticBox(document, meshes);
    const glm::dvec3 centre = (box.lower + box.upper) * 0.5; // no number where there is no mesh
    const double diagonal = glm::length(box.upper - box.lower);
    if (!(glm::length(centre) > kFarInDiagonals * diagonal) || !(diagonal > 0) ||
        !withinReach(glm::vec3(centre)))
        return glm::dvec3(0);
    const double step = std::exp2(std::ceil(std::log2(diagonal)));
    return glm::round(centre / step) * step;
}

std::string placeText(const glm::dvec3& origin, glm::vec3 p) {
    const glm::dvec3 position = toFile(origin, p);
    // Three significant digits distinguish positions only near the origin.
    return origin == glm::dvec3(0)
               ? fmt::format("At {:.3g}, {:.3g}, {:.3g} m", position.x, position.y, position.z)
               : fmt::format("At {:.3f}, {:.3f}, {:.3f} m", position.x, position.y, position.z);
}

} // namespace limn
