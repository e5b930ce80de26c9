// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/panels/bake_estimate.h"
#include "editor_ui/panels/statistics.h"
#include "engine/core/result.h"
#include "engine/stages/stage_store.h"
#include "engine/techniques/illuminance/bake/bake.h"

#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

namespace limn {

/// A bake with what it was made from. Null: none.
struct BakedScene {
    std::shared_ptr<const Bake> bake;
    std::shared_ptr<const Scene> scene;
    std::shared_ptr<const TraceScene> trace;
    bool preview = false; ///< of few rays; the full bake follows
};

/// Bakes beside the editor, one bake at a time. No call waits for the baker, but for the
/// destructor, which cancels it.
class BakeJob {
public:
    /// `wake` is called from the bake's thread when there is progress or a result to show. Finished
    /// stages are kept in `store`.
    BakeJob(std::function<void()> wake, StageStoreOptions store, MemoryBudget memory);
    ~BakeJob();
    BakeJob(const BakeJob&) = delete;
    BakeJob& operator=(const BakeJob&) = delete;

    /// False while one is running. `trace` is of `scene`; null: built on the thread. With `preview`
    /// there are two results: first one of previewSettings(), to have something to look at.
    bool start(std::shared_ptr<const Scene> scene, std::shared_ptr<const TraceScene> trace,
               bool preview);
    void cancel() { m_cancel = true; }
    bool running() const { return m_running; }
    /// While one is running, or what it gave has not been taken.
    bool busy() const;

    /// What the last bake gave, once: the bake, its preview, or why there is none ("cancelled").
    std::optional<Result<BakedScene>> takeResult();

    /// Stage, fractions and time left of the running bake; the other fields are left alone.
    void report(BakeStatus& status) const;

private:
    void work(std::shared_ptr<const Scene> scene, std::shared_ptr<const TraceScene> trace,
              bool preview);
    Result<Bake> bakeWith(const BakeSettings& settings, const TraceScene& trace);
    void put(Result<BakedScene> result);

    std::function<void()> m_wake;
    StageStore m_store;
    MemoryBudget m_memory;
    std::thread m_thread;
    std::atomic<bool> m_cancel{false}, m_running{false};
    std::chrono::steady_clock::time_point m_start;
    mutable std::mutex m_mutex; ///< of what follows
    std::string m_stage;
    float m_stageFraction = 0;
    std::chrono::steady_clock::time_point m_stageStart;
    StageSeconds m_expected; ///< of the running bake
    std::optional<Result<BakedScene>> m_result;
};

} // namespace limn
