// SPDX-License-Identifier: MIT
#pragma once

#include "engine/core/result.h"

#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace limn {

/// What was measured of a candidate.
struct TrialFigures {
    double error = 0, ms = 0, bytes = 0;
};

/// What a search is for: the least error within the limits or, with `maxError`, the least ms with
/// at most that error within the limits.
struct SearchGoal {
    double maxMs = std::numeric_limits<double>::infinity();
    double maxBytes = std::numeric_limits<double>::infinity();
    std::optional<double> maxError;
};

/// By which factor the figures exceed the limit that they exceed most; at most 1 where they keep
/// all. NaN counts as infinite.
double excess(const SearchGoal& goal, const TrialFigures& figures);

/// Whether `a` serves the goal better than `b`. What keeps the limits, times `slack`, comes before
/// what does not, of which that with the least excess() is better.
bool isBetter(const SearchGoal& goal, const TrialFigures& a, const TrialFigures& b,
              double slack = 1);

/// A measurement of a candidate. A higher level takes more effort and is more precise.
struct Trial {
    std::size_t candidate = 0;
    int level = 0;
    TrialFigures figures;
};

struct SearchSteps {
    int levels = 3;
    /// Measures a candidate; std::nullopt: there is no time for it, or no use. A failure ends the
    /// search.
    std::function<Result<std::optional<TrialFigures>>(std::size_t candidate, int level)> measure;
    /// Candidates like this one, which are tried when the halving is done; null: none.
    std::function<std::vector<std::size_t>(std::size_t candidate)> neighbours;
};

struct SearchResult {
    std::vector<Trial> trials; ///< in the order in which they were made
    /// The best of those at the highest level at which some keep the goal's limits; where none do,
    /// of the highest level that was reached. None: nothing was measured.
    std::optional<Trial> best;
};

/// Measures all candidates at level 0, the better half of them at level 1, and so on to the last
/// level; at the lower levels, where figures are less certain, limits count as a tenth wider. From
/// the best of the last level on, moves to neighbours as long as one is better: those are measured
/// at level 0 first and, where they are no worse than the best was there, at the last level. No
/// candidate is measured twice at the same level. Jamieson, Talwalkar. Non-stochastic Best Arm
/// Identification and Hyperparameter Optimization. 2016, has the halving. `candidates` has no
/// duplicates.
Result<SearchResult> successiveHalving(const std::vector<std::size_t>& candidates,
                                       const SearchGoal& goal, const SearchSteps& steps);

} // namespace limn
