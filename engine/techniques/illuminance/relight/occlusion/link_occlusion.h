// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/format/bake.h"
#include "engine/techniques/illuminance/relight/caches/light_links.h"
#include "engine/techniques/illuminance/relight/occlusion/blockers.h"
#include "engine/techniques/illuminance/relight/occlusion/hidden_links.h"

#include <cstdint>
#include <vector>

namespace limn {

/// Whether dynamic objects of `scene` occlude links.
bool occludesLinks(const Scene& scene);

std::vector<SenderPlace> senderPlaces(const Surfels& surfels, const ClusterTree& tree);

/// The links of a bake that dynamic objects hide.
struct HiddenLinks {
    std::vector<std::uint16_t>
        directions;                     ///< per link, as findHiddenLinks(); empty: none is hidden
    std::vector<std::uint32_t> linksOf; ///< per cache: number that are hidden at least in part
    std::vector<std::uint32_t> changed; ///< links whose hidden directions have changed, ascending
    std::uint32_t caches = 0;           ///< number with hidden links
    std::uint64_t links = 0;            ///< number hidden
};

/// Tracks how the dynamic objects of scenes occlude the links of one bake, which contains none of
/// them; the paper has no such step. A cache inside a closed object sees nothing. Only light from
/// behind an object is removed; light that the object reflects is not added.
struct LinkOcclusion {
    HiddenLinks hidden;
    std::uint64_t blockers = 0; ///< hashBlockers() of the scene that `hidden` belongs to; 0: none
    BlockerShapes shapes;
    std::vector<SenderPlace> places; ///< empty until needed
};

/// Brings `occlusion` up to date with `scene`. Returns false, and does nothing, where nothing has
/// moved.
bool updateLinkOcclusion(const Bake& bake, const Scene& scene, LinkOcclusion& occlusion);

/// The share of link k's directions that nothing blocks.
float openShare(const Bake& bake, const HiddenLinks& hidden, std::size_t k);

/// A transport or coefficient of a link, reduced to its open share.
std::uint16_t occludedHalf(std::uint16_t half, float share);

/// The links to read instead of the bake's own: those with transports times openShare().
struct OccludedLinks {
    Caches cones; ///< LinkStorage::Rtp: only lightmapCount, linkBegin, linkExponent and links
    std::vector<std::uint16_t>
        halfs; ///< LinkStorage::Sh: as many per link as occludeLinks() was given
};

/// Brings `occluded` up to date after an updateLinkOcclusion() that returned true. `occluded` is
/// empty at first and where there are no blockers. `halfs`: those of links of LinkStorage::Sh that
/// are read, bands^2 for each; empty: the bake's.
void occludeLinks(const Bake& bake, const LinkOcclusion& occlusion, LinkHalfs halfs,
                  OccludedLinks& occluded);

} // namespace limn
