// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/bake/cut/training_light.h"
#include "engine/techniques/illuminance/bake/rays/gather.h"

namespace limn {

/// Importance of each leaf of the tree: the irradiance that a radiosity of 1 at the leaf
/// contributes to all caches, as a sum weighted by CachePoints::weight.
std::vector<float> leafImportance(const Surfels& surfels, const GatherHits& hits,
                                  const CachePoints& points, const Caches& caches,
                                  const ClusterTree& tree);

/// Replaces the tree's area weights by the importance of the senders: a cluster's radiosity becomes
/// the mean over what the caches see of it. The errors of all links to a cluster then sum to zero,
/// whereas a mean by area is darkened by what no cache sees, such as the floor under furniture and
/// the backs of walls. Nodes of no importance keep their weights.
void weighByImportance(const std::vector<float>& importance, ClusterTree& tree);

/// Weighs the children of each cluster by their importance to the caches that are linked to the
/// cluster or to a node above it. Caches close to variation within a cluster link its parts
/// instead; counting them would make the mean that the others read too dark or too bright.
/// `importance`: from leafImportance(); `linked`: from buildLinks(). Clusters that no cache reads
/// keep their weights.
void weighByLinks(const std::vector<float>& importance, const std::vector<double>& linked,
                  ClusterTree& tree);

struct CutSettings {
    CutCriterion criterion = CutCriterion::Detail;
    std::uint32_t links = 256; ///< n_L
    int bands = 3;
    LinkStorage storage = LinkStorage::Rtp;
};

/// Fills the links of `caches`, in the settings' storage: for each valid cache, nodes of the tree
/// that together stand for all it saw, none below another. A cache whose points all lie in walls is
/// invalid and gets none. Traces no ray. Returns false when cancelled. `training` is read for
/// Detail only.
///
/// SolidAngle, the paper's criterion: each cache refines its node of the largest visible solid
/// angle, up to n_L links. Detail: of the refinements of all caches, those that lower the error of
/// irradiance most per link are made (RefinementPriority::byDetail), with as many links in total as
/// SolidAngle has. Hard caches get more of them, up to 16 n_L, and easy ones fewer. A link reads
/// the cluster of what it stands for, or a representative below it (RefinementPriority::byDetail).
///
/// Rtp stores the cone of a node's rays: their sum of weights and mean direction. Sh stores the
/// harmonics of the rays themselves, which are more accurate (`limn bench links`).
///
/// The links of a Hemisphere cache are scaled so that the SH of `bands` bands give the exact
/// irradiance of its rays at the surface's own normals, as a mean over the cache's points, under
/// any light. `linked`, if not null, receives per node of the tree what a radiosity of 1
/// contributes through all links to it, summed; links to representatives count as links to the
/// senders that they stand for.
bool buildLinks(const Surfels& surfels, const ClusterTree& tree, const GatherHits& hits,
                const CachePoints& points, const TrainingLight& training,
                const CutSettings& settings, const Progress& progress, Caches& caches,
                std::vector<double>* linked = nullptr);

} // namespace limn
