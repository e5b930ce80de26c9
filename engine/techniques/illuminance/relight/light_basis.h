// SPDX-License-Identifier: MIT
#pragma once

#include "engine/lighting/light_sources.h"

#include <cstdint>
#include <list>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace limn {

/// The converged light of a scene, and that of some of its sources alone: the basis of all light
/// that the scene has with other colours and strengths. A change of these is a weighted sum,
/// without a link or a bounce. Nimeroff, Simoncelli, Dorsey. Efficient Re-rendering of Naturally
/// Illuminated Environments. 1994, where the basis is of pictures.
///
/// Light is harmonics of caches: `coefficients` values for each. Bounced light that surfels read is
/// never negative, which is the one step that is not linear; sums may thus differ a little from
/// light that has bounced. The sources' harmonics have 16 bits each, and a factor for each cache.
class LightBasis {
public:
    static constexpr std::uint64_t kBudget = std::uint64_t(128) << 20;

    /// Keeps at most `budget` bytes of sources' light. Where it is full, the source whose weight
    /// changed longest ago is forgotten.
    explicit LightBasis(std::uint64_t budget = kBudget) : m_budget(budget) {}

    /// Forgets everything if `scene`'s transport is another. Returns whether it holds anything.
    bool holdFor(const Scene& scene);

    /// Sets the light of the scene with all of its sources, and its transport.
    void setSum(const Scene& scene, std::vector<WeightedSource> sources,
                std::span<const glm::vec3> light, std::size_t coefficients);
    bool hasSum(std::span<const WeightedSource> sources) const;

    /// Keeps the light of a source at unit weight, with as many coefficients as the sum has.
    void keep(const LightSource& source, std::span<const glm::vec3> light);

    /// The source of the sum whose light is to be found next: the one that was lacking last, then
    /// those that fit in the budget, in their order.
    std::optional<LightSource> wanted() const;

    /// Writes the light of the sum's sources with other weights; sources that `now` leaves out have
    /// none. Returns false, and writes nothing, if `now` has other sources or the light of one
    /// whose weight differs is not kept.
    bool sum(std::span<const WeightedSource> now, std::vector<glm::vec3>& light);

    std::size_t kept() const { return m_kept.size(); }
    std::uint64_t bytes() const;
    /// Counts the times that it forgot everything.
    std::uint64_t generation() const { return m_generation; }

private:
    struct SourceLight {
        LightSource source;
        std::vector<float> scale;         ///< per cache, of its values
        std::vector<std::int16_t> values; ///< three per coefficient

        std::uint64_t bytes() const {
            return scale.size() * sizeof(float) + values.size() * sizeof(std::int16_t);
        }
    };
    /// A source to add to the sum, and what its light is multiplied by.
    struct Term {
        const SourceLight* light;
        glm::vec3 factor;
    };
    using Kept = std::list<SourceLight>; ///< the one used last is the first

    Kept::const_iterator find(const LightSource& source) const;
    std::optional<std::vector<glm::vec3>> changes(std::span<const WeightedSource> now) const;
    void addTerms(std::span<const Term> terms, std::vector<glm::vec3>& light) const;

    std::uint64_t m_budget;
    SourceTransport m_transport;
    std::vector<WeightedSource> m_sources; ///< of the sum
    std::vector<glm::vec3> m_sum;
    std::size_t m_coefficients = 0;
    Kept m_kept;
    std::optional<LightSource> m_lacking; ///< last
    std::uint64_t m_generation = 0;
};

} // namespace limn
