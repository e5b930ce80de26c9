// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lightmap/texel_points.h"
#include "engine/techniques/illuminance/bake/senders/owner_tables.h"

#include <cstdint>
#include <span>
#include <vector>

namespace limn {

/// The areas that emissive surfels stand for. All vectors are empty where caches aim at the
/// surfels' own positions.
struct LampPatches {
    /// Number of points of each patch. Few patches have many, so that the visible share of one that
    /// is half hidden comes out within a per cent; of many patches, the errors average out.
    std::uint32_t each = 0;
    /// Per surfel, root mean square distance [m] from its position to its patch; 0 for surfels that
    /// do not emit. It is 0.4 times the square root of the area for a compact patch, and much more
    /// for a piece of a thin strip, such as the rim of a flat lamp.
    std::vector<float> extent;
    std::vector<std::uint32_t> begin; ///< per surfel: its first point; ~0: it has none
    /// `each` points of each patch, spread evenly over its area, with unit normals on the side
    /// that emits.
    std::vector<WorldPoint> points;
    std::vector<glm::vec3> normals; ///< per patch, unit: of the mean of its points' normals

    /// The points of a sender; empty for senders that are no emissive surfels.
    std::span<const WorldPoint> of(std::uint32_t sender) const {
        if (sender >= begin.size() || begin[sender] == ~0U)
            return {};
        return {points.data() + begin[sender], each};
    }
    /// The normal of a sender that has points.
    glm::vec3 normalOf(std::uint32_t sender) const { return normals[begin[sender] / each]; }
};

/// Finds the patches of the surfels of instances whose material emits. Points are chosen by
/// systematic sampling of the cells that each surfel owns, in proportion to their area: a mean over
/// a random one of them is an unbiased estimate of the mean over the patch.
LampPatches findLampPatches(const Scene& scene, const SurfelSet& set, const OwnerTables& owners);

} // namespace limn
