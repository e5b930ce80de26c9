// SPDX-License-Identifier: MIT
#include "engine/measure/fit_to_budget.h"

#include "engine/core/stopwatch.h"
#include "engine/measure/bounce_times.h"
#include "engine/measure/seen_truth.h"
#include "engine/stages/stage_store.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace limn {

namespace {

/// Effort of a level. Many points with few paths tell more than few points with many, at the same
/// cost: where light falls in spots, most of the error lies in few places.
struct Level {
    TruthSize truth;
    int runs;
    double until; ///< share of the time at which its trials end
};
constexpr std::array<Level, 3> kLevels = {
    {{{128, 72, 8}, 3, 0.5}, {{192, 108, 16}, 5, 0.65}, {{256, 144, 16}, 9, 1}}};
constexpr std::size_t kMostFirst = 20, kFewestFirst = 4; ///< candidates of level 0

/// Whether no count of `a` exceeds that of `b`, and one is less.
bool isSmaller(const BakeSettings& a, const BakeSettings& b) {
    return a.surfels <= b.surfels && a.links <= b.links && a.lightmapCaches <= b.lightmapCaches &&
           a.texelsPerMetre <= b.texelsPerMetre && !(a == b);
}

/// The settings of a sweep that are counts, which cost and error depend on most.
SettingsSweep countsIn(const SettingsSweep& sweep) {
    SettingsSweep counts;
    for (const char* key : {"surfels", "links", "lightmapCaches", "texelsPerMetre"})
        if (const auto values = sweep.find(key); values != sweep.end())
            counts.insert(*values);
    return counts;
}

/// Settings and what they are expected to cost.
struct Expected {
    BakeSettings settings;
    TrialFigures figures;
};

/// Of `rows`, `count` that keep the limits and than which none larger does: first the one whose
/// counts are most alike those of the presets, then others from few texels to many.
std::vector<BakeSettings> largestWithin(std::vector<Expected> rows, const SearchGoal& limits,
                                        std::size_t count) {
    std::erase_if(rows, [&](const Expected& row) { return excess(limits, row.figures) > 1; });
    std::vector<BakeSettings> largest;
    for (const Expected& row : rows)
        if (std::ranges::none_of(
                rows, [&](const Expected& r) { return isSmaller(row.settings, r.settings); }))
            largest.push_back(row.settings);
    if (largest.empty())
        return {};
    const BakePreset& medium = kBakePresets[1];
    const auto balanced = std::ranges::min_element(largest, {}, [&](const BakeSettings& s) {
        const double texels = std::max(1., double(s.lightmapCaches));
        return std::abs(std::log2(s.surfels / texels * medium.lightmapCaches / medium.surfels)) +
               std::abs(std::log2(double(s.links) / medium.links));
    });
    std::vector<BakeSettings> first = {*balanced};
    largest.erase(balanced);
    const std::size_t others = std::min(count - 1, largest.size());
    for (std::size_t k = 0; k < others; ++k)
        first.push_back(largest[(2 * k + 1) * largest.size() / (2 * others)]);
    return first;
}

class BudgetFit {
public:
    BudgetFit(const Technique& technique, const TraceScene& trace, const SettingsSweep& sweep,
              const BudgetGoal& goal, const Progress& progress, const MemoryBudget& memory,
              const std::function<void(const SettingsTrial&)>& tried)
        : m_technique(technique), m_trace(trace), m_sweep(sweep), m_goal(goal),
          m_progress(progress), m_memory(memory), m_tried(tried) {}

    Result<FittedSettings> run();

private:
    double seconds() { return m_passed += m_clock.lap() / 1000; }
    Result<const SeenTruth*> truth(int level);
    Result<SettingsTrial> measure(const BakeSettings& settings, int level);
    Result<void> measureBase();
    TrialFigures predicted(const BakeSettings& settings) const;
    double predictedSeconds(const BakeSettings& settings) const;
    std::size_t numberOf(const BakeSettings& settings);
    BakeSettings startSettings() const;
    std::vector<Expected> expectedRows() const;
    std::vector<BakeSettings> firstOf(const std::vector<Expected>& rows) const;
    Result<std::vector<std::size_t>> firstCandidates();
    std::vector<std::size_t> neighbours(std::size_t candidate);
    Result<std::optional<TrialFigures>> trial(std::size_t candidate, int level);

    const Technique& m_technique;
    const TraceScene& m_trace;
    const SettingsSweep& m_sweep;
    const BudgetGoal& m_goal;
    const Progress& m_progress;
    const MemoryBudget& m_memory;
    const std::function<void(const SettingsTrial&)>& m_tried;

    Stopwatch m_clock;
    double m_passed = 0;
    StageStore m_store; ///< in memory
    std::array<std::optional<SeenTruth>, kLevels.size()> m_truths;
    std::shared_ptr<const Precomputed> m_base; ///< which predictions start from
    PrecomputedCost m_baseCost;
    std::vector<BakeSettings> m_candidates; ///< by number
    std::array<bool, kLevels.size()> m_reached{};
    FittedSettings m_fitted;
};

Result<const SeenTruth*> BudgetFit::truth(int level) {
    std::optional<SeenTruth>& truth = m_truths[std::size_t(level)];
    if (!truth) {
        truth =
            findSeenTruth(m_trace, m_goal.camera, kLevels[std::size_t(level)].truth, m_progress);
        if (!truth)
            return fail("cancelled");
        if (truth->isDark())
            return fail("the camera sees no light, so no error is known");
    }
    return &*truth;
}

/// Bakes and measures, unless that is done. The first bake is what predictions start from.
Result<SettingsTrial> BudgetFit::measure(const BakeSettings& settings, int level) {
    for (const SettingsTrial& trial : m_fitted.trials)
        if (trial.settings == settings && trial.level == level)
            return trial;
    const Result<const SeenTruth*> reference = truth(level);
    if (!reference)
        return tl::make_unexpected(reference.error());
    const auto made = m_technique.precomputation->prepare(
        m_trace, {.settings = &settings, .store = &m_store, .memory = m_memory}, m_progress);
    if (!made)
        return tl::make_unexpected(made.error());
    const Scene& scene = m_trace.scene();
    const auto lighting = m_technique.light({*made, std::make_shared<const Scene>(scene)});
    m_progress.at("light", 0);
    const LightingReport lit = lighting->update(
        {.scene = scene, .trace = &m_trace, .bounces = scene.relight.maxBounces}, m_progress);
    if (m_progress.cancelled())
        return fail("cancelled");
    const Result<Comparison> error =
        compareWithTruth(m_trace, *lighting, (*made)->layout(), **reference);
    if (!error)
        return tl::make_unexpected(error.error());
    const BounceTimes times =
        timeBounces(*lighting, scene, m_trace, kLevels[std::size_t(level)].runs, m_progress);
    if (m_progress.cancelled())
        return fail("cancelled");
    const PrecomputedReport report = (*made)->report();
    double ms = times.least; // other work only ever adds time, whenever these settings were timed
    for (const SettingsTrial& earlier : m_fitted.trials)
        if (earlier.settings == settings)
            ms = std::min(ms, earlier.ms);
    const SettingsTrial trial{.settings = settings,
                              .level = level,
                              .seconds = totalOf(report.seconds),
                              .ms = ms,
                              .bytes = totalOf(report.bytes) + counterOf(lit, "light_bytes"),
                              .nrmse = error->nrmse,
                              .bias = error->bias,
                              .noise = error->nrmseNoise};
    if (!m_base) {
        m_base = *made;
        m_baseCost = {report.seconds, trial.bytes, times.steps, times.least};
    }
    m_fitted.trials.push_back(trial);
    if (m_tried)
        m_tried(trial);
    return trial;
}

/// Measures the bake that predictions start from.
Result<void> BudgetFit::measureBase() {
    BakeSettings draft = startSettings();
    kBakePresets.front().applyTo(draft);
    const Result<SettingsTrial> base = measure(draft, 0);
    return base ? Result<void>() : tl::make_unexpected(base.error());
}

/// What the settings are expected to cost: as the first bake predicts it, times by how much its
/// prediction was off for the most similar settings that were measured.
TrialFigures BudgetFit::predicted(const BakeSettings& settings) const {
    const Scene& scene = m_trace.scene();
    const auto expected = [&](const BakeSettings& s) {
        return m_base->expectedCost(scene, s, m_baseCost);
    };
    const PrecomputedCost cost = expected(settings);
    const SettingsTrial& nearest =
        *std::ranges::min_element(m_fitted.trials, {}, [&](const SettingsTrial& trial) {
            return settingsDistance(trial.settings, settings);
        });
    const PrecomputedCost known = expected(nearest.settings);
    return {0, cost.updateMs * nearest.ms / known.updateMs,
            cost.bytes * nearest.bytes / known.bytes};
}

/// Of a bake that finds no finished stage.
double BudgetFit::predictedSeconds(const BakeSettings& settings) const {
    return totalOf(m_base->expectedCost(m_trace.scene(), settings, m_baseCost).seconds);
}

std::size_t BudgetFit::numberOf(const BakeSettings& settings) {
    const auto known = std::ranges::find(m_candidates, settings);
    if (known != m_candidates.end())
        return std::size_t(known - m_candidates.begin());
    m_candidates.push_back(settings);
    return m_candidates.size() - 1;
}

/// The scene's settings, with a value of the sweep for each setting that has none of its values.
BakeSettings BudgetFit::startSettings() const {
    BakeSettings start = m_trace.scene().bake;
    for (const auto& [key, values] : m_sweep) {
        const std::vector<BakeSettings> line = sweepRows({{key, values}}, start);
        if (std::ranges::find(line, start) == line.end())
            start = line.front();
    }
    return start;
}

/// The combinations of counts, and what they are expected to cost.
std::vector<Expected> BudgetFit::expectedRows() const {
    std::vector<Expected> rows;
    for (const BakeSettings& settings : sweepRows(countsIn(m_sweep), startSettings()))
        rows.push_back({settings, predicted(settings)});
    return rows;
}

/// Those to begin with, the most promising one first.
std::vector<BakeSettings> BudgetFit::firstOf(const std::vector<Expected>& rows) const {
    SearchGoal limits = m_goal.limits;
    limits.maxError = {}; // nothing is known of errors
    if (!m_goal.limits.maxError)
        return largestWithin(rows, limits, kMostFirst);
    // The cheapest that has the error is alike those of one of these times.
    double least = std::numeric_limits<double>::infinity(), most = 0;
    for (const Expected& row : rows) {
        least = std::min(least, row.figures.ms);
        most = std::max(most, row.figures.ms);
    }
    std::vector<BakeSettings> first;
    const double maxMs = std::min(most, limits.maxMs);
    for (limits.maxMs = 2 * least; limits.maxMs < 2 * maxMs; limits.maxMs *= 2)
        for (const BakeSettings& settings : largestWithin(rows, limits, 3))
            if (std::ranges::find(first, settings) == first.end())
                first.push_back(settings);
    return first;
}

Result<std::vector<std::size_t>> BudgetFit::firstCandidates() {
    std::vector<Expected> rows = expectedRows();
    m_fitted.settings = rows.size();
    std::vector<BakeSettings> first = firstOf(rows);
    // Predictions are better from what is alike: those from draft may be off by a third where the
    // budget is a quarter of what draft takes.
    if (!first.empty() && !m_goal.limits.maxError) {
        const Result<SettingsTrial> alike = measure(first.front(), 0);
        if (!alike)
            return tl::make_unexpected(alike.error());
        rows = expectedRows();
        if (std::vector<BakeSettings> better = firstOf(rows); !better.empty())
            first = std::move(better);
    }
    SearchGoal limits = m_goal.limits;
    limits.maxError = {};
    m_fitted.ruledOut = std::size_t(std::ranges::count_if(
        rows, [&](const Expected& row) { return excess(limits, row.figures) > 1; }));
    if (first.empty()) // nothing is expected to keep the limits; the least of all is nearest to it
        first.push_back(std::ranges::min_element(rows, {}, [&](const Expected& row) {
                            return excess(limits, row.figures);
                        })->settings);
    // Those that their share of the time allows for, if they take as long as predicted.
    double seconds = this->seconds();
    std::vector<std::size_t> numbers;
    for (const BakeSettings& settings : first) {
        seconds += predictedSeconds(settings);
        if (numbers.size() < kFewestFirst || seconds < kLevels[0].until * m_goal.seconds)
            numbers.push_back(numberOf(settings));
    }
    return numbers;
}

std::vector<std::size_t> BudgetFit::neighbours(std::size_t candidate) {
    constexpr double kUncertain = 1.1; // of predictions from similar settings
    SearchGoal limits = m_goal.limits;
    limits.maxError = {};
    std::vector<std::size_t> numbers;
    const BakeSettings from = m_candidates[candidate];
    const TrialFigures here = predicted(from);
    std::vector<BakeSettings> around = neighboursIn(m_sweep, from);
    // More of one count for less of another.
    const SettingsSweep counts = countsIn(m_sweep);
    for (const BakeSettings& step : neighboursIn(counts, from))
        for (const BakeSettings& settings : neighboursIn(counts, step))
            if (isSmaller(from, step) && !isSmaller(from, settings) && !(settings == from))
                around.push_back(settings);
    for (const BakeSettings& settings : around) {
        const TrialFigures there = predicted(settings);
        // What costs exactly as much is the same bake, such as one of bands that nothing reads.
        const bool same = there.ms == here.ms && there.bytes == here.bytes;
        if (!same && excess(limits, there) <= kUncertain)
            numbers.push_back(numberOf(settings));
    }
    return numbers;
}

Result<std::optional<TrialFigures>> BudgetFit::trial(std::size_t candidate, int level) {
    const BakeSettings settings = m_candidates[candidate]; // a copy: the vector may grow
    const bool last = level + 1 == int(kLevels.size());
    const double until = m_reached.back() || last ? 1 : kLevels[std::size_t(level)].until;
    if (m_reached[std::size_t(level)] &&
        seconds() + predictedSeconds(settings) > until * m_goal.seconds)
        return std::optional<TrialFigures>();
    const Result<SettingsTrial> made = measure(settings, level);
    if (!made)
        return tl::make_unexpected(made.error());
    m_reached[std::size_t(level)] = true;
    return std::optional(TrialFigures{made->nrmse, made->ms, made->bytes});
}

Result<FittedSettings> BudgetFit::run() {
    if (const Result<void> base = measureBase(); !base)
        return tl::make_unexpected(base.error());
    const Result<std::vector<std::size_t>> first = firstCandidates();
    if (!first)
        return tl::make_unexpected(first.error());
    const Result<SearchResult> found = successiveHalving(
        *first, m_goal.limits,
        {.levels = int(kLevels.size()),
         .measure = [this](std::size_t candidate, int level) { return trial(candidate, level); },
         .neighbours = [this](std::size_t candidate) { return neighbours(candidate); }});
    if (!found)
        return tl::make_unexpected(found.error());
    const Trial& best = *found->best; // one is measured whatever the time
    m_fitted.best = *std::ranges::find_if(m_fitted.trials, [&](const SettingsTrial& trial) {
        return trial.settings == m_candidates[best.candidate] && trial.level == best.level;
    });
    m_fitted.kept = excess(m_goal.limits, best.figures) <= 1;
    return std::move(m_fitted);
}

} // namespace

const SettingsSweep& usualFitSweep() {
    static const SettingsSweep sweep = {
        {"surfels", {"1024", "2048", "4096", "8192", "16384", "32768", "65536", "131072"}},
        {"links", {"8", "12", "16", "24", "32", "48", "64", "96", "128", "192", "256"}},
        {"lightmapCaches",
         {"1250", "1800", "2500", "3500", "5000", "7000", "10000", "14000", "20000", "28000",
          "36000", "50000", "70000", "100000", "140000", "200000"}},
        {"rays", {"128", "256", "512", "1024"}},
        {"bands", {"2", "3", "4"}},
        {"storage", {"rtp", "sh"}}};
    return sweep;
}

std::string shortfall(const FittedSettings& fitted, const SearchGoal& limits) {
    if (fitted.kept)
        return {};
    std::string text;
    const auto add = [&](bool over, const std::string& what) {
        if (over)
            text += (text.empty() ? "" : ", ") + what;
    };
    constexpr double kMiB = 1 << 20;
    add(fitted.best.ms > limits.maxMs,
        fmt::format("{:.2f} ms, not {:g}", fitted.best.ms, limits.maxMs));
    add(fitted.best.bytes > limits.maxBytes,
        fmt::format("{:.2f} MiB, not {:g}", fitted.best.bytes / kMiB, limits.maxBytes / kMiB));
    if (limits.maxError)
        add(fitted.best.nrmse > *limits.maxError,
            fmt::format("an error of {:.3f}, not {:g}", fitted.best.nrmse, *limits.maxError));
    return "no settings that were tried keep the limits; the nearest take " + text;
}

Result<FittedSettings> fitToBudget(const Technique& technique, const TraceScene& trace,
                                   const SettingsSweep& sweep, const BudgetGoal& goal,
                                   const Progress& progress, const MemoryBudget& memory,
                                   const std::function<void(const SettingsTrial&)>& tried) {
    return BudgetFit(technique, trace, sweep, goal, progress, memory, tried).run();
}

} // namespace limn
