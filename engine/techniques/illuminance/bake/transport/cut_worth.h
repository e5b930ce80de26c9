// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/bake/transport/training_light.h"
#include "engine/techniques/illuminance/bake/transport/visible_tree.h"

#include <cstdint>
#include <vector>

namespace limn {

/// Computes the worth of each refinement of a cache's cut; a refinement replaces a node's link by
/// links to its two children. A worth never exceeds the parent's, so the refinements above any
/// bound form a cut. The object reuses its working space from cache to cache.
class CutWorth {
public:
    /// The paper's criterion: the visible solid angle / pi of the node. Jendersie, Kuri, Grosch.
    /// Real-Time Global Illumination Using Precomputed Illuminance Composition with Chrominance
    /// Compression. 2016
    void bySolidAngle(const VisibleTree& seen);

    /// The worth is the decrease of the squared error of irradiance per link spent, relative to the
    /// irradiance of the cache in each training lighting: the mean over those lightings, plus a
    /// prior for what they do not show. The error of a link is the difference between what its
    /// senders truly bring and what their mean radiosity would; errors of different links count as
    /// independent. A node whose own refinement gains little but enables better ones is worth the
    /// mean gain of the best group of refinements that it heads. Every bound on the worth therefore
    /// gives the cut of least error for its number of links, and the same bound for all caches
    /// gives the least error for all their links. Chou, Lookabaugh, Gray. Optimal Pruning with
    /// Applications to Tree-Structured Source Coding and Modeling. 1989
    void byDetail(const VisibleTree& seen, const TrainingLight& training);

    /// Per inner node of the VisibleTree, in its order; >= 0.
    const std::vector<float>& worth() const { return m_worth; }

private:
    static constexpr std::uint32_t kNone = ~0U;
    /// A group of refinements, named by its uppermost node; a leftist heap of the groups below it.
    struct Group {
        float gain = 0;
        std::uint32_t count = 1;
        std::uint32_t joined = kNone;                        ///< the group that took it in
        std::uint32_t below = kNone;                         ///< heap of the groups that it enables
        std::uint32_t left = kNone, right = kNone, rank = 1; ///< as an element of a heap

        float worth() const { return gain / float(count); }
    };

    void weighLightings(const VisibleTree& seen, const TrainingLight& training);
    void measureGains(const VisibleTree& seen, const TrainingLight& training);
    void joinGroups(const VisibleTree& seen);
    std::uint32_t rankOf(std::uint32_t heap) const;
    std::uint32_t merge(std::uint32_t a, std::uint32_t b);

    std::vector<float> m_worth;
    std::vector<float> m_weight;  ///< of squared errors, per lighting and, last, of the prior
    std::vector<float> m_brought; ///< what senders of nodes truly bring in each lighting; a stack
    std::vector<float> m_error;   ///< squared, of one link to the node
    std::vector<Group> m_groups;
};

} // namespace limn
