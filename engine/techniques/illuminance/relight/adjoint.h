// SPDX-License-Identifier: MIT
#pragma once

#include "engine/math/sh.h"
#include "engine/techniques/illuminance/relight/relight.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

// Relighting is linear in what surfels send of their own accord, so a value V that is linear in the
// light of some caches is a sum over senders. These functions go through relighting backwards: from
// dV / d(a cache's SH) to dV / d(radiosity) of the senders and, bounce after bounce, of what had
// lit them. "Weight" always means such a derivative, one for each colour.

/// Weights of the SH of one cache.
struct CacheWeight {
    std::uint32_t cache = 0;
    std::array<glm::vec3, kMaxCoefficients> coefficient{};
};

/// Replaces invalid caches by those that stand in for them. The result names each cache once.
std::vector<CacheWeight> validCaches(const Caches& caches, std::span<const CacheWeight> weights);

/// Weights as they are before the bands from `chroma` on are made grey: their luma alone counts
/// there, for all colours together.
void weighGrey(int bands, int chroma, std::span<glm::vec3> coefficients);

/// Weights of the radiosity of the tree's nodes, each as a link's sender only, not as a part of the
/// clusters above it.
std::vector<glm::vec3> linkedNodes(const RelightState& state, std::span<const CacheWeight> weights);

/// Adds the weights of clusters to those of the nodes below them, so that those of the leaves are
/// complete.
void pushWeights(const ClusterTree& tree, std::vector<glm::vec3>& nodes);

/// Follows surfels' bounced light backwards. `state` must outlive it and be that of its making.
class BounceAdjoint {
public:
    explicit BounceAdjoint(const RelightState& state);

    /// Returns the weights of the radiosity of the tree's leaves, given those of the bounced
    /// irradiance that surfels read.
    std::vector<glm::vec3> operator()(std::span<const glm::vec3> irradiance) const;

private:
    static constexpr std::size_t kCoefficients = std::size_t(kIrradianceBands) * kIrradianceBands;
    struct Reader {
        std::uint32_t surfel;
        float weight; ///< of the cache in what the surfel reads
    };
    using Factors = std::array<float, kCoefficients>; ///< of coefficients in irradiance

    const RelightState& m_state;
    std::vector<std::uint32_t> m_begin; ///< readers of cache c: m_readers[m_begin[c] … c + 1)
    std::vector<Reader> m_readers;
    std::vector<Factors> m_factors; ///< per surfel
};

} // namespace limn
