// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/panels/bake_estimate.h"
#include "editor_ui/panels/measured_errors.h"
#include "editor_ui/panels/statistics.h"
#include "engine/core/result.h"
#include "engine/lighting/technique.h"
#include "engine/measure/bake_to_error.h"
#include "engine/measure/fit_to_budget.h"
#include "engine/stages/stage_store.h"

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace limn {

/// A bake and what it was made from. The members are null if there is none.
struct BakedScene {
    std::shared_ptr<const Precomputed> bake;
    std::shared_ptr<const Scene> scene;
    std::shared_ptr<const TraceScene> trace;
    bool preview = false;   ///< made with few rays; the full bake follows
    bool selection = false; ///< only BakeOrder::selection has all of its texels
    /// Result of a bake to an error or to a budget, in words; empty if the settings were given.
    std::string goal;
    bool fitted = false; ///< to a budget

    Prepared prepared() const { return {bake, scene}; }
};

/// What to bake.
struct BakeOrder {
    std::shared_ptr<const Scene> scene;
    std::shared_ptr<const TraceScene> trace; ///< of the scene; null: it is built on the thread
    /// Two results, the first with Precomputation::preview() settings, to have something to look
    /// at.
    bool preview = false;
    /// Bakes become finer until this error holds; they begin with the counts of draft instead of
    /// the scene's. The result's scene has the settings found.
    std::optional<ErrorGoal> goal = {};
    /// The settings are searched that have the least error within this budget, and baked. The
    /// result's scene has them; where none keep the budget, there is no result.
    std::optional<BudgetGoal> budget = {};
    /// Nodes that alone get all of their texels, as selectionScene() has it; empty: all do.
    std::vector<ObjectId> selection = {};
};

/// Bakes in the background, one bake at a time. No call waits for the baker except the destructor,
/// which cancels the bake.
class BakeJob {
public:
    /// `wake` is called from the bake's thread when there is progress or a result to show. Finished
    /// stages are kept in `store`.
    BakeJob(std::function<void()> wake, StageStoreOptions store, MemoryBudget memory);
    ~BakeJob();
    BakeJob(const BakeJob&) = delete;
    BakeJob& operator=(const BakeJob&) = delete;

    /// Starts a bake; returns false if one is running.
    bool start(BakeOrder order);
    void cancel() { m_cancel = true; }
    bool running() const { return m_running; }
    /// True while a bake is running or being measured, or something of it has not been taken.
    bool busy() const;

    /// Returns, once, the fastest of a few updates of one bounce of the last bake's light with all
    /// lights moved. It comes after the bake; with none if the job was cancelled meanwhile.
    std::optional<LightingReport> takeUpdate();

    /// Returns the result of the last bake once: the bake, its preview, or the error ("cancelled").
    std::optional<Result<BakedScene>> takeResult();

    /// Returns the errors that bakes to an error or to a budget have measured since the last call.
    std::vector<MeasuredError> takeErrors();

    /// Fills in stage, fractions and time left of the running bake; leaves the other fields
    /// unchanged.
    void report(BakeStatus& status) const;

private:
    void work(const BakeOrder& order);
    Result<BakedScene> bakeScene(const BakeOrder& order);
    Result<BakedScene> bakeToGoal(const BakeOrder& order);
    Result<BakedScene> bakeToBudget(const BakeOrder& order);
    Result<BakedScene> bakeSelection(const BakeOrder& order);
    Result<std::shared_ptr<const Precomputed>> bakeWith(const Precomputation& precomputation,
                                                        const BakeSettings& settings,
                                                        const TechniqueChoice& choice,
                                                        const TraceScene& trace);
    Progress progress();
    void setStep(std::string step);
    void keepError(MeasuredError error);
    void put(Result<BakedScene> result);
    void measureUpdate(const BakedScene& baked);

    std::function<void()> m_wake;
    StageStore m_store;
    MemoryBudget m_memory;
    std::thread m_thread;
    std::atomic<bool> m_cancel{false}, m_running{false}, m_measuring{false};
    std::chrono::steady_clock::time_point m_start;
    mutable std::mutex m_mutex; ///< guards the members below
    std::string m_stage, m_step;
    bool m_fitting = false;
    float m_stageFraction = 0;
    std::chrono::steady_clock::time_point m_stageStart;
    StageSeconds m_expected; ///< of the running bake
    std::optional<Result<BakedScene>> m_result;
    std::optional<LightingReport> m_update;
    std::vector<MeasuredError> m_errors;
};

} // namespace limn
