// SPDX-License-Identifier: MIT
#pragma once

#include "engine/bake/bake.h"
#include "engine/relight/blockers.h"
#include "engine/relight/hidden_links.h"
#include "engine/relight/light_links.h"

#include <cstdint>
#include <vector>

namespace limn {

/// Whether dynamic objects of `scene` dim links: only Relighter does that, GpuRelighter does not.
bool dimsLinks(const Scene& scene);

std::vector<SenderPlace> senderPlaces(const Surfels& surfels, const ClusterTree& tree);

/// The bake's links as they are to be read instead of its own: transports times the share of their
/// cone's directions that no dynamic object blocks. The bake knows none; this is beyond the paper.
struct DimmedLinks {
    Caches cones; ///< LinkStorage::Rtp: only lightmapCount, linkBegin, linkExponent and links
    std::vector<std::uint16_t> halfs; ///< LinkStorage::Sh: as many per link as were given

    std::vector<std::uint16_t> hidden;  ///< per link, as findHiddenLinks has it
    std::vector<std::uint32_t> linksOf; ///< per cache: how many are dimmed
    std::uint32_t caches = 0;           ///< with links that are
    std::uint64_t links = 0;            ///< that are
};

/// Brings `dimmed` up to date with the blockers, from wherever they were. Empty to begin with, and
/// without blockers. `halfs`: those of links of LinkStorage::Sh that are read, bands^2 for each;
/// empty: the bake's.
/// A cache within a closed object sees nothing. Only light coming from behind an object is taken
/// away; what the object reflects is not added.
void dimLinks(const LinksAndBlockers& scene, LinkHalfs halfs, DimmedLinks& dimmed);

} // namespace limn
