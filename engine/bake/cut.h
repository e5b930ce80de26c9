// SPDX-License-Identifier: MIT
#pragma once

#include "engine/bake/gather.h"

namespace limn {

/// Replaces the tree's area weights by how often each sender was met: a cluster's radiosity becomes
/// the mean over what the caches see of it. So the errors of all links to a cluster sum to zero,
/// where a mean by area is darkened by what nobody sees: floor under furniture, backs of walls.
/// Nodes that no ray met keep their weights.
void weighBySight(const GatherHits& hits, ClusterTree& tree);

/// Fills linkBegin and links of `caches`: for each valid cache at most `maxLinks` nodes of the tree
/// that together cover all it saw, by refining the node of the largest visible solid angle first
/// (the paper's criterion). A cache whose every point lies in a wall is invalid and gets none. The
/// links of a Hemisphere cache are scaled so that the SH of `bands` bands give the exact irradiance
/// of its rays at the surface's own normal, whatever shines. Traces nothing. Returns false when
/// cancelled.
bool buildLinks(const ClusterTree& tree, const GatherHits& hits, const CachePoints& points,
                std::uint32_t maxLinks, int bands, const Progress& progress, Caches& caches);

/// Fills fillBegin … fillWeight: an invalid cache becomes the mean of its nearest valid ones of the
/// same kind, weighted by 1 / distance^2; lightmap caches also weigh how well the normals agree.
/// Returns the number of invalid caches.
std::uint32_t fillInvalid(Caches& caches);

} // namespace limn
