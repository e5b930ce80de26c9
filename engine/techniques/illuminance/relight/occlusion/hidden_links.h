// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/format/bake.h"
#include "engine/techniques/illuminance/relight/occlusion/blockers.h"

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// The region that the light of a tree's node comes from.
struct SenderPlace {
    glm::vec3 centre{0};
    float radius = 0;    ///< of a sphere about its surfels [m]; infinite where sky is among them
    glm::vec3 normal{0}; ///< unit where they nearly lie in a plane; else 0
};

/// A cache ignores a blocker that covers less than this share of the hemisphere's solid angle,
/// where it takes at most 0.2 % of a uniform light.
inline constexpr float kMinBlocked = 1e-3f;

/// Number of directions that sample a cone: few where u = 1 - cos(half-angle) is less than kNarrow.
/// A hundred cones of kNarrow fill the hemisphere.
inline constexpr std::uint32_t kFewDirections = 4, kManyDirections = 16;
inline constexpr float kNarrow = 0.01f;
inline std::uint32_t directionsOf(float u) {
    return u < kNarrow ? kFewDirections : kManyDirections;
}

/// The links and the blockers that may occlude them.
struct LinksAndBlockers {
    const Bake& bake;
    const std::vector<SenderPlace>& places; ///< per node of the tree
    const std::vector<Blocker>& blockers;
};

/// Finds the directions of the links of caches [begin, end) that are blocked before they reach the
/// cluster: one bit for each direction. hidden[0] belongs to link linkBegin[begin]. Runs on one
/// thread with the widest vectors that this machine has; the result does not depend on them. A cell
/// of the grid is not occluded by an object that reads it, one within a cell's length, because an
/// object does not shade itself.
void findHiddenLinks(const LinksAndBlockers& scene, std::uint32_t begin, std::uint32_t end,
                     std::uint16_t* hidden);

} // namespace limn
