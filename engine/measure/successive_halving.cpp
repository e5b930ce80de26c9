// SPDX-License-Identifier: MIT
#include "engine/measure/successive_halving.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace limn {

namespace {

constexpr double kSlack = 1.1; ///< of limits at the levels before the last

/// The trials of a search, and what they say.
class Search {
public:
    Search(const SearchGoal& goal, const SearchSteps& steps) : m_goal(goal), m_steps(steps) {}

    /// The trial of a candidate, which is made unless there is one; null: there is no time.
    Result<const Trial*> trial(std::size_t candidate, int level) {
        const auto key = std::pair(candidate, level);
        if (const auto known = m_known.find(key); known != m_known.end())
            return &known->second;
        const Result<std::optional<TrialFigures>> figures = m_steps.measure(candidate, level);
        if (!figures)
            return tl::make_unexpected(figures.error());
        if (!*figures)
            return nullptr;
        const Trial& made = m_known[key] = {candidate, level, **figures};
        m_result.trials.push_back(made);
        return &made;
    }

    int last() const { return m_steps.levels - 1; }
    bool better(const Trial& a, const Trial& b) const {
        return isBetter(m_goal, a.figures, b.figures, a.level < last() ? kSlack : 1);
    }

    Result<void> halve(std::vector<std::size_t> candidates) {
        for (int level = 0; level <= last() && !candidates.empty(); ++level) {
            std::vector<const Trial*> trials;
            for (const std::size_t candidate : candidates) {
                const Result<const Trial*> made = trial(candidate, level);
                if (!made)
                    return tl::make_unexpected(made.error());
                if (*made)
                    trials.push_back(*made);
            }
            std::ranges::stable_sort(
                trials, [&](const Trial* a, const Trial* b) { return better(*a, *b); });
            if (!trials.empty())
                m_result.best = *trials.front();
            trials.resize((trials.size() + 1) / 2);
            candidates.clear();
            for (const Trial* kept : trials)
                candidates.push_back(kept->candidate);
        }
        return {};
    }

    /// Moves to a better neighbour; false: there is none.
    Result<bool> move() {
        const std::size_t from = m_result.best->candidate;
        const Result<const Trial*> before = trial(from, 0);
        if (!before)
            return tl::make_unexpected(before.error());
        bool moved = false;
        for (const std::size_t candidate : m_steps.neighbours(from)) {
            if (m_known.contains({candidate, last()}))
                continue;
            const Result<const Trial*> first = trial(candidate, 0);
            if (!first)
                return tl::make_unexpected(first.error());
            if (!*first || (*before && better(**before, **first)))
                continue;
            const Result<const Trial*> final = trial(candidate, last());
            if (!final)
                return tl::make_unexpected(final.error());
            if (*final && better(**final, *m_result.best)) {
                m_result.best = **final;
                moved = true;
            }
        }
        return moved;
    }

    Result<void> descend() {
        while (m_steps.neighbours && m_result.best && m_result.best->level == last()) {
            const Result<bool> moved = move();
            if (!moved)
                return tl::make_unexpected(moved.error());
            if (!*moved)
                return {};
        }
        return {};
    }

    SearchResult result() {
        if (m_result.best && !keeps(*m_result.best))
            for (const Trial& trial : m_result.trials)
                if (keeps(trial) && (!keeps(*m_result.best) || isMoreCertain(trial)))
                    m_result.best = trial;
        return std::move(m_result);
    }

private:
    bool keeps(const Trial& trial) const { return excess(m_goal, trial.figures) <= 1; }
    /// Than the best so far, which keeps the limits as well.
    bool isMoreCertain(const Trial& trial) const {
        const Trial& best = *m_result.best;
        return trial.level > best.level ||
               (trial.level == best.level && isBetter(m_goal, trial.figures, best.figures));
    }

    const SearchGoal& m_goal;
    const SearchSteps& m_steps;
    std::map<std::pair<std::size_t, int>, Trial> m_known; ///< by candidate and level
    SearchResult m_result;
};

} // namespace

double excess(const SearchGoal& goal, const TrialFigures& figures) {
    double maximum = std::max(figures.ms / goal.maxMs, figures.bytes / goal.maxBytes);
    if (goal.maxError)
        maximum = std::max(maximum, figures.error / *goal.maxError);
    const bool known =
        std::isfinite(figures.error) && std::isfinite(figures.ms) && std::isfinite(figures.bytes);
    return known ? maximum : std::numeric_limits<double>::infinity();
}

bool isBetter(const SearchGoal& goal, const TrialFigures& a, const TrialFigures& b, double slack) {
    const double excessA = excess(goal, a), excessB = excess(goal, b);
    const bool keepsA = excessA <= slack, keepsB = excessB <= slack;
    if (keepsA != keepsB)
        return keepsA;
    if (!keepsA)
        return excessA < excessB;
    return goal.maxError ? a.ms < b.ms : a.error < b.error;
}

Result<SearchResult> successiveHalving(const std::vector<std::size_t>& candidates,
                                       const SearchGoal& goal, const SearchSteps& steps) {
    Search search(goal, steps);
    if (const Result<void> halved = search.halve(candidates); !halved)
        return tl::make_unexpected(halved.error());
    if (const Result<void> ended = search.descend(); !ended)
        return tl::make_unexpected(ended.error());
    return search.result();
}

} // namespace limn
