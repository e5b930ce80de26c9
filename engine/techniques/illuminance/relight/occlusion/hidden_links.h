// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/bake/bake.h"
#include "engine/techniques/illuminance/relight/occlusion/blockers.h"

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// Where the light of a tree's node comes from.
struct SenderPlace {
    glm::vec3 centre{0};
    float radius = 0;    ///< of a sphere about its surfels [m]; infinite where sky is among them
    glm::vec3 normal{0}; ///< unit where they lie in a plane, nearly; else 0
};

/// A blocker is passed over by caches that see it in less than this share of the hemisphere's solid
/// angle: there it takes 0.2 % of a uniform light, at most.
inline constexpr float kMinBlocked = 1e-3f;

/// Directions that stand for a cone: few where u = 1 - cos(half-angle) is less than kNarrow, of
/// which a hundred cones fill the hemisphere.
inline constexpr std::uint32_t kFewDirections = 4, kManyDirections = 16;
inline constexpr float kNarrow = 0.01f;
inline std::uint32_t directionsOf(float u) {
    return u < kNarrow ? kFewDirections : kManyDirections;
}

/// Links, and what may stand in their way.
struct LinksAndBlockers {
    const Bake& bake;
    const std::vector<SenderPlace>& places; ///< per node of the tree
    const std::vector<Blocker>& blockers;
};

/// Of the links of caches [begin, end), in a row, which of their directions are blocked before they
/// come to the cluster: one bit for each. hidden[0] is link linkBegin[begin]. On one thread, by the
/// widest vectors that this machine has; the result is the same with others.
/// A cell of the grid is not dimmed by an object that reads it, one within a cell's length: an
/// object does not shade itself.
void findHiddenLinks(const LinksAndBlockers& scene, std::uint32_t begin, std::uint32_t end,
                     std::uint16_t* hidden);

} // namespace limn
