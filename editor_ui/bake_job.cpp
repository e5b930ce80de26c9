// SPDX-License-Identifier: MIT
#include "editor_ui/bake_job.h"

#include "editor_ui/background_priority.h"

#include <utility>

namespace limn {

using Clock = std::chrono::steady_clock;

namespace {

/// Shares of a bake of Sponza with default settings; only the time left depends on them.
constexpr std::pair<const char*, float> kShares[] = {{"charts", 0.08f},   {"surfels", 0.03f},
                                                     {"clusters", 0.05f}, {"caches", 0.04f},
                                                     {"trace", 0.6f},     {"cut", 0.2f}};

} // namespace

float bakeFraction(const std::string& stage, float fraction) {
    float before = 0;
    for (const auto& [name, share] : kShares) {
        if (stage == name)
            return before + share * fraction;
        before += share;
    }
    return 0;
}

BakeJob::BakeJob(std::function<void()> wake) : m_wake(std::move(wake)) {}

BakeJob::~BakeJob() {
    m_cancel = true;
    if (m_thread.joinable())
        m_thread.join();
}

bool BakeJob::start(std::shared_ptr<const Scene> scene, std::shared_ptr<const TraceScene> trace) {
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
        m_result.reset();
    }
    m_thread = std::thread([this, scene = std::move(scene), trace = std::move(trace)]() mutable {
        work(std::move(scene), std::move(trace));
    });
    return true;
}

void BakeJob::work(std::shared_ptr<const Scene> scene, std::shared_ptr<const TraceScene> trace) {
    lowerThreadPriority();
    auto shown = Clock::now();
    Progress progress;
    progress.cancel = &m_cancel;
    progress.report = [&](const char* stage, float fraction) {
        {
            const std::lock_guard lock(m_mutex);
            m_stage = stage;
            m_stageFraction = fraction;
        }
        if (const auto now = Clock::now(); now - shown > std::chrono::milliseconds(100)) {
            shown = now;
            m_wake();
        }
    };
    if (!trace)
        trace = std::make_shared<const TraceScene>(*scene);
    Result<Bake> result = bake(*trace, progress);
    {
        const std::lock_guard lock(m_mutex);
        if (result)
            m_result = BakedScene{std::make_shared<const Bake>(std::move(*result)), scene, trace};
        else
            m_result = tl::make_unexpected(result.error());
    }
    m_running = false;
    m_wake();
}

std::optional<Result<BakedScene>> BakeJob::takeResult() {
    const std::lock_guard lock(m_mutex);
    return std::exchange(m_result, {});
}

void BakeJob::report(BakeStatus& status) const {
    status.running = m_running;
    if (!status.running)
        return;
    const std::lock_guard lock(m_mutex);
    status.stage = m_stage;
    status.stageFraction = m_stageFraction;
    status.fraction = bakeFraction(m_stage, m_stageFraction);
    status.elapsedSeconds = std::chrono::duration<double>(Clock::now() - m_start).count();
    // Before a twentieth is done the estimate would jump about.
    status.secondsLeft =
        status.fraction < 0.05f
            ? -1
            : status.elapsedSeconds * (1 - double(status.fraction)) / double(status.fraction);
}

} // namespace limn
