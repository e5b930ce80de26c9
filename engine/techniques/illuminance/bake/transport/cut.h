// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/bake/transport/gather.h"
#include "engine/techniques/illuminance/bake/transport/training_light.h"

namespace limn {

/// How much of each leaf all caches together see, in irradiance: sums over the caches of what a
/// radiosity of 1 would bring.
std::vector<float> seenByCaches(const Surfels& surfels, const GatherHits& hits,
                                const CachePoints& points, const Caches& caches,
                                const ClusterTree& tree);

/// Replaces the tree's area weights by how much of each sender is seen: a cluster's radiosity
/// becomes the mean over what the caches see of it. So the errors of all links to a cluster sum to
/// zero, where a mean by area is darkened by what nobody sees: floor under furniture, backs of
/// walls. Nodes that no ray met keep their weights.
void weighBySight(const std::vector<float>& seen, ClusterTree& tree);

/// Weighs the children of each cluster by what those caches see of them that are linked to it or to
/// one above it. Caches near what differs within a cluster link its parts instead; were they
/// counted, the mean that the others read would be too dark or too bright. `seen`: seenByCaches;
/// `linked`: of buildLinks. Clusters that no cache reads keep their weights.
void weighByLinks(const std::vector<float>& seen, const std::vector<double>& linked,
                  ClusterTree& tree);

struct CutSettings {
    CutCriterion criterion = CutCriterion::Detail;
    std::uint32_t links = 256; ///< n_L
    int bands = 3;
    LinkStorage storage = LinkStorage::Rtp;
};

/// Fills the links of `caches`, in the settings' storage: for each valid cache nodes of the tree
/// that together cover all it saw. A cache whose every point lies in a wall is invalid and gets
/// none. Traces nothing. Returns false when cancelled. `training` is read for Detail only.
///
/// SolidAngle, the paper's: each cache refines its node of the largest visible solid angle, down to
/// at most n_L links. Detail: the refinements of all caches that lower the error of irradiance most
/// per link (CutWorth::byDetail), as many links in all as SolidAngle has; so hard caches get more
/// of them, up to 16 n_L, and easy ones fewer.
///
/// Rtp keeps the cone of a node's rays: their sum of weights and mean direction. Sh keeps the
/// harmonics of the rays themselves, which are nearer to the truth (`limn bench links`).
///
/// The links of a Hemisphere cache are scaled so that the SH of `bands` bands give the exact
/// irradiance of its rays at the surface's own normal, whatever shines. `linked`, if not null:
/// per node of the tree, what a radiosity of 1 brings through all links to it, summed.
bool buildLinks(const Surfels& surfels, const ClusterTree& tree, const GatherHits& hits,
                const CachePoints& points, const TrainingLight& training,
                const CutSettings& settings, const Progress& progress, Caches& caches,
                std::vector<double>* linked = nullptr);

} // namespace limn
