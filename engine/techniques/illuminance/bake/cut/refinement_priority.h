// SPDX-License-Identifier: MIT
#pragma once

#include "engine/techniques/illuminance/bake/cut/lighting_rows.h"
#include "engine/techniques/illuminance/bake/cut/training_light.h"
#include "engine/techniques/illuminance/bake/cut/visible_tree.h"

#include <array>
#include <cstdint>
#include <vector>

namespace limn {

/// Node whose radiosity the link to an inner node of a VisibleTree reads: its cluster, or the
/// node that the link to its left or right child would read.
enum class Representative : std::uint8_t { Cluster, Left, Right };

/// Result of RefinementPriority: one element for each inner node of a VisibleTree, in its order.
struct CutChoices {
    std::vector<float> priority; ///< of refining the node; >= 0
    std::vector<Representative> representative;
};

/// Computes the priority of each refinement of a cache's cut; a refinement replaces a node's link
/// by links to its two children. A priority never exceeds the parent's, so the refinements above
/// any bound form a cut. The object reuses its working space from cache to cache.
class RefinementPriority {
public:
    /// The paper's criterion: the visible solid angle / pi of the node. Each node reads its own
    /// cluster. Jendersie, Kuri, Grosch.
    /// Real-Time Global Illumination Using Precomputed Illuminance Composition with Chrominance
    /// Compression. 2016
    void bySolidAngle(const VisibleTree& seen);

    /// The priority is the decrease of the squared error of irradiance per link spent, relative to
    /// the irradiance of the cache in each training lighting: the mean over those lightings, plus a
    /// prior for what they do not show. The error of a link is the difference between what its
    /// senders truly contribute and what their mean radiosity would; errors of different links
    /// count as independent. A node whose own refinement gains little but enables better ones has
    /// the mean gain of the best group of refinements that it heads. Every bound on the priority
    /// therefore gives the cut of least error for its number of links, and the same bound for all
    /// caches gives the least error for all their links. Chou, Lookabaugh, Gray. Optimal Pruning
    /// with Applications to Tree-Structured Source Coding and Modeling. 1989
    ///
    /// A cluster holds senders that the cache does not see, such as the sunlit front of a column
    /// seen from behind. A link therefore reads a node below its cluster where that comes nearer to
    /// what was seen: a representative, as in Walter, Fernandez, Arbree, Bala, Donikian, Greenberg.
    /// Lightcuts: A Scalable Approach to Illumination. 2005. There it is drawn by intensity; here
    /// it has the least expected error of irradiance, over the training lightings and the prior.
    void byDetail(const VisibleTree& seen, const TrainingLight& training);

    const CutChoices& choices() const { return m_choices; }

private:
    static constexpr std::uint32_t kNone = ~0U;
    /// A group of refinements, named by its uppermost node; a leftist heap of the groups below it.
    struct Group {
        float gain = 0;
        std::uint32_t count = 1;
        std::uint32_t joined = kNone;                        ///< the group that took it in
        std::uint32_t below = kNone;                         ///< heap of the groups that it enables
        std::uint32_t left = kNone, right = kNone, rank = 1; ///< as an element of a heap

        float priority() const { return gain / float(count); }
    };

    void weighLightings(const VisibleTree& seen, const TrainingLight& training);
    void measureGains(const VisibleTree& seen, const TrainingLight& training);
    void chooseRepresentative(const VisibleTree& seen, const TrainingLight& training,
                              std::uint32_t node, const std::array<float, kLinkCandidates>& errors);
    void joinGroups(const VisibleTree& seen);
    std::uint32_t rankOf(std::uint32_t heap) const;
    std::uint32_t merge(std::uint32_t a, std::uint32_t b);

    /// The node that a link reads, and what the cache sees of it.
    struct Read {
        std::uint32_t node; ///< of the ClusterTree
        float seen;         ///< irradiance at a radiosity of 1
    };

    CutChoices m_choices;
    std::vector<float> m_weight; ///< of squared errors, per lighting and, last, of the prior
    std::vector<float>
        m_contribution; ///< what senders of nodes truly contribute in each lighting; a stack
    std::vector<float> m_error; ///< squared, of one link to the node
    std::vector<Read> m_read;   ///< per node
    std::vector<Group> m_groups;
};

} // namespace limn
