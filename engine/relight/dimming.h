// SPDX-License-Identifier: MIT
#pragma once

#include "engine/bake/bake.h"
#include "engine/relight/blockers.h"

#include <cstdint>
#include <vector>

namespace limn {

/// Whether dynamic objects of `scene` dim links: only Relighter does that, GpuRelighter does not.
bool dimsLinks(const Scene& scene);

/// Where the light of a tree's node comes from.
struct SenderPlace {
    glm::vec3 centre{0};
    float radius = 0;    ///< of a sphere about its surfels [m]; infinite where sky is among them
    glm::vec3 normal{0}; ///< unit where they lie in a plane, nearly; else 0
};
std::vector<SenderPlace> senderPlaces(const Surfels& surfels, const ClusterTree& tree);

/// The links of those caches that blockers take light from, as they are to be read instead of the
/// bake's: transports times the share of their cone that is free, links that are wholly blocked
/// left out. The bake knows no dynamic object; this is beyond the paper.
struct DimmedLinks {
    std::vector<std::uint32_t> cache; ///< which ones, ascending
    std::uint32_t lightmapCount = 0;  ///< of them
    Caches links;                     ///< only their links are filled: linkBegin … shCoefficients
    std::vector<std::uint32_t> beforeSky; ///< per cache, as linksBeforeSky
    std::uint64_t dimmed = 0;             ///< links whose transport is lower, or 0
};

/// A blocker is passed over by caches that see it in less than this share of the hemisphere's solid
/// angle: there it takes 0.2 % of a uniform light, at most.
inline constexpr float kLeastBlocked = 1e-3f;

/// A cone of a link is 16 directions, or 4 where it is narrow; one is blocked where an object lies
/// before the cluster. A cache within a closed object sees nothing. A cell of the grid is not
/// dimmed by an object that reads it, one within a cell's length: an object does not shade itself.
/// Only light coming from behind an object is taken away; what the object reflects is not added.
/// O(links of the caches near blockers).
DimmedLinks dimLinks(const Bake& bake, const std::vector<SenderPlace>& places,
                     const std::vector<Blocker>& blockers);

} // namespace limn
