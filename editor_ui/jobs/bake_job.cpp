// SPDX-License-Identifier: MIT
#include "editor_ui/jobs/bake_job.h"

#include "editor_ui/jobs/background_priority.h"
#include "engine/techniques/technique_table.h"

#include <algorithm>
#include <utility>

namespace limn {

using Clock = std::chrono::steady_clock;

BakeJob::BakeJob(std::function<void()> wake, StageStoreOptions store, MemoryBudget memory)
    : m_wake(std::move(wake)), m_store(std::move(store)), m_memory(memory) {}

BakeJob::~BakeJob() {
    m_cancel = true;
    if (m_thread.joinable())
        m_thread.join();
}

bool BakeJob::start(std::shared_ptr<const Scene> scene, std::shared_ptr<const TraceScene> trace,
                    bool preview) {
    if (m_running)
        return false;
    if (m_thread.joinable())
        m_thread.join(); // has finished
    m_cancel = false;
    m_running = true;
    m_start = Clock::now();
    {
        const std::lock_guard lock(m_mutex);
        m_stage.clear();
        m_stageFraction = 0;
        m_stageStart = m_start;
        m_result.reset();
    }
    m_thread =
        std::thread([this, preview, scene = std::move(scene), trace = std::move(trace)]() mutable {
            work(std::move(scene), std::move(trace), preview);
        });
    return true;
}

Result<std::shared_ptr<const Precomputed>> BakeJob::bakeWith(const Precomputation& precomputation,
                                                             const BakeSettings& settings,
                                                             const TraceScene& trace) {
    auto shown = Clock::now();
    Progress progress;
    progress.cancel = &m_cancel;
    progress.report = [&](const char* stage, float fraction) {
        const auto now = Clock::now();
        {
            const std::lock_guard lock(m_mutex);
            if (m_stage != stage)
                m_stageStart = now;
            m_stage = stage;
            m_stageFraction = fraction;
        }
        if (now - shown > std::chrono::milliseconds(100)) {
            shown = now;
            m_wake();
        }
    };
    return precomputation.prepare(
        trace, {.settings = &settings, .store = &m_store, .memory = m_memory}, progress);
}

void BakeJob::put(Result<BakedScene> result) {
    const std::lock_guard lock(m_mutex);
    m_result = std::move(result);
}

void BakeJob::work(std::shared_ptr<const Scene> scene, std::shared_ptr<const TraceScene> trace,
                   bool preview) {
    lowerThreadPriority();
    if (!trace)
        trace = std::make_shared<const TraceScene>(*scene);
    const Precomputation& precomputation = *precomputingTechnique(scene->technique).precomputation;
    const BakeSettings first = precomputation.preview(scene->bake);
    if (preview && first != scene->bake)
        if (const auto rough = bakeWith(precomputation, first, *trace)) {
            {
                const std::lock_guard lock(m_mutex);
                m_expected = (*rough)->expectedSeconds(scene->bake);
            }
            put(BakedScene{*rough, scene, trace, true});
            m_wake();
        }
    const auto result = bakeWith(precomputation, scene->bake, *trace);
    if (result) {
        const std::lock_guard lock(m_mutex);
        m_expected = (*result)->expectedSeconds(scene->bake);
    }
    if (result)
        put(BakedScene{*result, scene, trace});
    else
        put(tl::make_unexpected(result.error()));
    m_running = false;
    m_wake();
}

bool BakeJob::busy() const {
    const std::lock_guard lock(m_mutex);
    return m_running || m_result;
}

std::optional<Result<BakedScene>> BakeJob::takeResult() {
    const std::lock_guard lock(m_mutex);
    return std::exchange(m_result, {});
}

void BakeJob::report(BakeStatus& status) const {
    const bool ranBefore = std::exchange(status.running, m_running);
    if (!status.running)
        return;
    const std::lock_guard lock(m_mutex);
    status.stage = m_stage;
    status.stageFraction = m_stageFraction;
    const auto now = Clock::now();
    status.elapsedSeconds = std::chrono::duration<double>(now - m_start).count();
    status.secondsLeft = secondsLeft(m_expected, m_stage, double(m_stageFraction),
                                     std::chrono::duration<double>(now - m_stageStart).count());
    const double total = status.elapsedSeconds + status.secondsLeft;
    const float fraction = status.secondsLeft < 0 || total <= 0
                               ? 0
                               : std::min(float(status.elapsedSeconds / total), 0.99f); // it runs
    // Estimates get longer, too; what was done stays done.
    status.fraction = ranBefore ? std::max(status.fraction, fraction) : fraction;
}

} // namespace limn
