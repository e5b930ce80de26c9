// SPDX-License-Identifier: MIT
#pragma once

#include "engine/bake/gather.h"

namespace limn {

/// Fills linkBegin and links of `caches`: for each valid cache at most `maxLinks` nodes of the tree
/// that together cover all it saw, by refining the node of the largest visible solid angle first
/// (the paper's criterion). A cache most of whose rays met back faces is invalid and gets none.
/// Hemisphere caches are
/// calibrated for `bands`, so that equal senders bring exactly the irradiance of the rays. Traces
/// nothing. Returns false when cancelled.
bool buildLinks(const ClusterTree& tree, const GatherHits& hits, std::uint32_t maxLinks, int bands,
                const Progress& progress, Caches& caches);

/// Fills fillBegin … fillWeight: an invalid cache becomes the mean of its nearest valid ones of the
/// same kind, weighted by 1 / distance^2; lightmap caches also weigh how well the normals agree.
/// Returns the number of invalid caches.
std::uint32_t fillInvalid(Caches& caches);

} // namespace limn
