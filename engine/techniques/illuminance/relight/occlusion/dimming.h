// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/bake/bake.h"
#include "engine/techniques/illuminance/relight/caches/light_links.h"
#include "engine/techniques/illuminance/relight/occlusion/blockers.h"
#include "engine/techniques/illuminance/relight/occlusion/hidden_links.h"

#include <cstdint>
#include <vector>

namespace limn {

/// Whether dynamic objects of `scene` dim links.
bool dimsLinks(const Scene& scene);

std::vector<SenderPlace> senderPlaces(const Surfels& surfels, const ClusterTree& tree);

/// Which of a bake's links dynamic objects hide.
struct HiddenLinks {
    std::vector<std::uint16_t> directions; ///< per link, as findHiddenLinks; empty: none is hidden
    std::vector<std::uint32_t> linksOf;    ///< per cache: how many are hidden, in part at least
    std::vector<std::uint32_t> changed; ///< links that are hidden otherwise than before, ascending
    std::uint32_t caches = 0;           ///< with hidden links
    std::uint64_t links = 0;            ///< hidden
};

/// Follows the dynamic objects of scenes with one bake, which knows none: this is beyond the paper.
/// A cache within a closed object sees nothing. Only light coming from behind an object is taken
/// away; what the object reflects is not added.
struct Dimming {
    HiddenLinks hidden;
    std::uint64_t blockers = 0; ///< hash of those that `hidden` belongs to; 0: none
    BlockerShapes shapes;
    std::vector<SenderPlace> places; ///< empty until needed
};

/// Brings `dimming` up to date with `scene`. False: nothing had moved, and nothing was done.
bool updateDimming(const Bake& bake, const Scene& scene, Dimming& dimming);

/// The share of link k's directions that nothing blocks.
float openShare(const Bake& bake, const HiddenLinks& hidden, std::size_t k);

/// A transport or coefficient of a link that is open to a share.
std::uint16_t dimmedHalf(std::uint16_t half, float share);

/// The bake's links as they are to be read instead of its own: transports times openShare().
struct DimmedLinks {
    Caches cones; ///< LinkStorage::Rtp: only lightmapCount, linkBegin, linkExponent and links
    std::vector<std::uint16_t> halfs; ///< LinkStorage::Sh: as many per link as were given
};

/// Brings `dimmed` up to date after an updateDimming() that was not false. Empty to begin with, and
/// without blockers. `halfs`: those of links of LinkStorage::Sh that are read, bands^2 for each;
/// empty: the bake's.
void dimLinks(const Bake& bake, const Dimming& dimming, LinkHalfs halfs, DimmedLinks& dimmed);

} // namespace limn
