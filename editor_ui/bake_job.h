// SPDX-License-Identifier: MIT
#pragma once

#include "editor_ui/statistics.h"
#include "engine/bake/bake.h"
#include "engine/core/result.h"

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
};

/// Bakes beside the editor, one bake at a time. No call waits for the baker, but for the
/// destructor, which cancels it.
class BakeJob {
public:
    /// `wake` is called from the bake's thread when there is progress or a result to show.
    explicit BakeJob(std::function<void()> wake);
    ~BakeJob();
    BakeJob(const BakeJob&) = delete;
    BakeJob& operator=(const BakeJob&) = delete;

    /// False while one is running. `trace` is of `scene`; null: built on the thread.
    bool start(std::shared_ptr<const Scene> scene, std::shared_ptr<const TraceScene> trace);
    void cancel() { m_cancel = true; }
    bool running() const { return m_running; }

    /// What the last bake gave, once: the bake, or why there is none ("cancelled").
    std::optional<Result<BakedScene>> takeResult();

    /// Stage, fractions and time left of the running bake; the other fields are left alone.
    void report(BakeStatus& status) const;

private:
    void work(std::shared_ptr<const Scene> scene, std::shared_ptr<const TraceScene> trace);

    std::function<void()> m_wake;
    std::thread m_thread;
    std::atomic<bool> m_cancel{false}, m_running{false};
    std::chrono::steady_clock::time_point m_start;
    mutable std::mutex m_mutex; ///< of what follows
    std::string m_stage;
    float m_stageFraction = 0;
    std::optional<Result<BakedScene>> m_result;
};

/// Fraction of the whole bake that is done at `fraction` of `stage`, from what the stages usually
/// take. 0 for a stage it does not know.
float bakeFraction(const std::string& stage, float fraction);

} // namespace limn
