// SPDX-License-Identifier: MIT
#include "editor_ui/jobs/lint_job.h"

#include "editor_ui/jobs/background_priority.h"
#include "engine/lint/lint.h"

#include <utility>

namespace limn {

LintJob::LintJob(std::function<void()> wake) : m_wake(std::move(wake)) {}

LintJob::~LintJob() {
    m_cancel = true;
    if (m_thread.joinable())
        m_thread.join();
}

bool LintJob::start(LintOrder order) {
    if (busy())
        return false;
    if (m_thread.joinable())
        m_thread.join(); // has finished
    m_document = order.document;
    m_cancel = false;
    m_running = true;
    m_thread = std::thread([this, order = std::move(order)] {
        lowerThreadPriority();
        Checked checked = check(order);
        {
            const std::lock_guard lock(m_mutex);
            m_result = std::move(checked);
            m_stage.clear();
            m_fraction = 0;
        }
        m_running = false;
        m_wake();
    });
    return true;
}

void LintJob::cancel() {
    m_cancel = true;
}

LintJob::Checked LintJob::check(const LintOrder& order) {
    Progress progress;
    progress.cancel = &m_cancel;
    progress.report = [this](const char* stage, float fraction) {
        {
            const std::lock_guard lock(m_mutex);
            m_stage = stage;
            m_fraction = fraction;
        }
        m_wake();
    };
    const Scene scene = flatten(*order.document, order.assets);
    const TraceScene trace(scene);
    auto findings =
        lintScene({*order.document, scene, trace, order.repairs, order.memory}, progress);
    if (!findings)
        return fail("cancelled");
    return std::make_shared<const std::vector<Finding>>(std::move(*findings));
}

bool LintJob::busy() const {
    const std::lock_guard lock(m_mutex);
    return m_running || m_result;
}

void LintJob::report(std::string& stage, float& fraction) const {
    const std::lock_guard lock(m_mutex);
    stage = m_stage;
    fraction = m_fraction;
}

std::optional<LintJob::Checked> LintJob::takeResult() {
    const std::lock_guard lock(m_mutex);
    return std::exchange(m_result, {});
}

} // namespace limn
