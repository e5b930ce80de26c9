// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/format/bake.h"
#include "engine/trace/trace_scene.h"

#include <optional>

namespace limn {

/// A sender of a cache's cut, with all its links taken together.
struct LinkedNode {
    std::uint32_t node;   ///< of the tree: surfel, sky cell or cluster
    float weight;         ///< sum of transport: visible solid angle / pi [1]
    std::uint32_t leaves; ///< surfels and sky cells below it
};

/// The nodes that light a cache.
struct LinkCut {
    std::uint32_t cache = 0;
    std::vector<LinkedNode> nodes; ///< strongest first
    double total = 0;              ///< sum of the weights
    /// Per leaf of the tree: its share of the weights above it; they sum to `total`.
    std::vector<float> leafWeight;
    /// Per leaf: the weight of the strongest node above it; 0: not linked.
    std::vector<float> nodeWeight;
    std::vector<std::pair<std::uint32_t, float>>
        filledFrom; ///< of an invalid cache: source, weight
};

/// The cut of a cache. Precondition: `cache` < the bake's number of caches.
LinkCut linkCut(const Bake& bake, std::uint32_t cache);

/// Returns the cache that contributes most to the light on the side of the surface that was hit: a
/// lightmap cache where the instance has a lightmap, else one of the grid. `hit` names an instance
/// of the baked scene, or one past its end for the grid. Returns std::nullopt where there is no
/// such cache.
std::optional<std::uint32_t> cacheAt(const Bake& bake, const Scene& scene, const Hit& hit);

} // namespace limn
